# The libraries of headers that the closed loop needs, for a build for another machine: those of the host's packages.
#
# They lie among the headers of the host's C library, which must not be seen: a folder of links shows these alone.

set(zlg_host_headers ${CMAKE_BINARY_DIR}/host_headers)
file(MAKE_DIRECTORY ${zlg_host_headers})
foreach(header boost/version.hpp fmt/format.h toml++/toml.h)
    find_path(folder ${header} PATHS /usr/local/include /usr/include REQUIRED NO_CACHE NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
    cmake_path(GET header PARENT_PATH library)
    file(CREATE_LINK ${folder}/${library} ${zlg_host_headers}/${library} SYMBOLIC)
    unset(folder)
endforeach()
find_path(folder xxhash.h PATHS /usr/local/include /usr/include REQUIRED NO_CACHE NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
file(CREATE_LINK ${folder}/xxhash.h ${zlg_host_headers}/xxhash.h SYMBOLIC)
unset(folder)
include_directories(SYSTEM ${zlg_host_headers})

# find_package() then finds these targets, and not the host's, which bring the host's archives.
add_library(fmt::fmt INTERFACE IMPORTED)
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
add_library(tomlplusplus::tomlplusplus INTERFACE IMPORTED)
foreach(package fmt tomlplusplus)
    file(WRITE ${CMAKE_FIND_PACKAGE_REDIRECTS_DIR}/${package}-config.cmake "")
endforeach()

# Without streams and locales, which would be a seventh of a module of WebAssembly: toml++ reads numbers by <charconv>, of which
# libc++ 14 lacks the half that fast_float has.
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "wasm32")
    find_path(folder fast_float/fast_float.h PATHS /usr/local/include /usr/include REQUIRED NO_CACHE NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
    file(CREATE_LINK ${folder}/fast_float ${zlg_host_headers}/fast_float SYMBOLIC)
    unset(folder)
    target_compile_definitions(fmt::fmt INTERFACE FMT_STATIC_THOUSANDS_SEPARATOR=44 FMT_USE_LONG_DOUBLE=0 FMT_USE_FLOAT=0 FMT_USE_INT128=0)
    target_compile_definitions(tomlplusplus::tomlplusplus INTERFACE TOML_FLOAT_CHARCONV=1)
    target_compile_options(tomlplusplus::tomlplusplus INTERFACE -include ${CMAKE_CURRENT_SOURCE_DIR}/lab/module/wasm_charconv.hpp)
endif()
