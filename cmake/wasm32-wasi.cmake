# WebAssembly with the system interface WASI, by clang and Debian's wasi-libc and libc++ for wasm32.
#
# Debian's C++ run time for it is made without exceptions; lab/module/wasm_exceptions.cpp gives what a throw and a catch need.

set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER clang++)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_EXECUTABLE_SUFFIX .wasm)
set(CMAKE_EXECUTABLE_SUFFIX_CXX .wasm)
set(CMAKE_AR llvm-ar)
set(CMAKE_RANLIB llvm-ranlib)

# The standard headers are named, so that those of the host are none of them.
string(JOIN " " CMAKE_CXX_FLAGS_INIT
    -nostdinc++ -nostdlibinc -isystem /usr/include/wasm32-wasi/c++/v1 -isystem /usr/include/wasm32-wasi
    -fwasm-exceptions -ffunction-sections -fdata-sections -flto)
# The linker sees through all sources, which makes the module faster and smaller; it needs the options for exceptions once more.
# -O0 is for the link alone: with another level clang calls wasm-opt where one is installed, and Debian's refuses exceptions by default.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-O0 -Qunused-arguments -Wl,--gc-sections -Wl,--strip-all -Wl,--compress-relocations -Wl,--stack-first -Wl,-z,stack-size=1048576 -Wl,-mllvm,-wasm-enable-eh -Wl,-mllvm,-exception-model=wasm")

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
