# Linux on 64-bit Arm, by Debian's cross compiler; qemu-aarch64 runs what it makes on another machine.

set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)

# The libraries of C and C++ are linked in, so that a program runs where there are none for this processor.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)

set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
