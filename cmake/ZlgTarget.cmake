# One way to declare a library of the product: its sources, its own include root, what it may see.

set(CMAKE_CXX_EXTENSIONS OFF)

option(ZLG_WERROR "a warning is an error; on in the preset dev and in continuous integration, for another compiler may warn of more" OFF)
option(ZLG_COVERAGE "instrument for line coverage" OFF)

# -Wno-missing-field-initializers: a designated initialiser names what differs from the members' own defaults.
# -ffp-contract=off: a fused multiply-add rounds once where two operations round twice, and only some machines have it.
function(zlg_flags target)
    target_compile_features(${target} PUBLIC cxx_std_20)
    target_compile_options(${target} PRIVATE
        -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -Wnon-virtual-dtor -Wno-missing-field-initializers
        -ffp-contract=off)
    # What a sanitizer adds to the code makes the compiler warn of what is not there: warnings are judged without it.
    if(ZLG_WERROR AND NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")
        target_compile_options(${target} PRIVATE -Werror)
    endif()
    if(ZLG_COVERAGE)
        target_compile_options(${target} PRIVATE --coverage -O0)
        target_link_options(${target} PUBLIC --coverage)
    endif()
endfunction()

# zlg_precompile(target HEADER...): read what most files of the target include once instead of once a file.
#
# -fpch-preprocess: what ccache needs to know such a file again.
function(zlg_precompile target)
    if(ARGN)
        target_precompile_headers(${target} PRIVATE ${ARGN})
    endif()
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(${target} PRIVATE -fpch-preprocess)
    endif()
endfunction()

option(ZLG_BATCHES "compile the sources of large targets in batches; off for tools that want one command a source" ON)

# zlg_in_batches(target size): the compiler reads so many sources of the target as one, since the headers and templates that they share
# cost more than the sources themselves. Names without linkage are then shared as well: two sources may not give the same one.
function(zlg_in_batches target size)
    if(ZLG_BATCHES)
        set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${size})
        # A local name is not hidden by what another source of the batch calls the same. What a source has for itself, GCC takes for a part
        # of a header, since a batch includes it.
        target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-shadow -Wshadow=local -Wno-subobject-linkage>
            $<$<CXX_COMPILER_ID:Clang>:-Wno-shadow>)
    endif()
endfunction()

# zlg_texts(source header namespace FILE...): files as raw strings, without indentation and lines of comment, in a source to be compiled.
# The header, found in the folder of the caller, declares them: "page.css" is page_css.
function(zlg_texts source header namespace)
    set(texts "#include <${header}>\n")
    foreach(name ${ARGN})
        file(READ ${name} text)
        string(REGEX REPLACE "\n +" "\n" text "\n${text}")
        string(REGEX REPLACE "\n//[^\n]*" "" text "${text}")
        string(REGEX REPLACE "^\n" "" text "${text}")
        string(REGEX REPLACE "[.-]" _ variable ${name})
        string(APPEND texts "const char* const ${namespace}::${variable} = R\"=====(${text})=====\";\n")
        set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${name})
    endforeach()
    file(CONFIGURE OUTPUT ${source} CONTENT "@texts@" @ONLY)
endfunction()

# zlg_quick_to_compile(target): what spends its time in other libraries is compiled with -O1, in two thirds of the time.
function(zlg_quick_to_compile target)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
endfunction()

# zlg_seen_through(target): half of what a step costs is the way from one small source file to the next, so the linker may see through
# them. The objects hold ordinary code as well, for programs that are linked without it: those whose property ZLG_PLAIN_LINK is on.
function(zlg_seen_through target)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_BUILD_TYPE STREQUAL "Release")
        target_compile_options(${target} PRIVATE -flto -ffat-lto-objects)
        target_link_options(${target} INTERFACE $<BUILD_INTERFACE:$<IF:$<BOOL:$<TARGET_PROPERTY:ZLG_PLAIN_LINK>>,-fno-lto,-flto=auto>>)
    endif()
endfunction()

# zlg_hardened(target): for what reads the bytes of others or serves. A write beyond an array whose size is known, a smashed stack and an
# index or iterator that the library knows to be wrong end the program, and what the loader has resolved is read-only. A sanitizer, and the
# other machines' closed loop, know nothing of that.
function(zlg_hardened target)
    if(ZLG_LOOP_ONLY OR NOT CMAKE_SYSTEM_NAME STREQUAL "Linux" OR NOT CMAKE_BUILD_TYPE STREQUAL "Release")
        return()
    endif()
    target_compile_options(${target} PRIVATE -fstack-protector-strong -U_FORTIFY_SOURCE -D_FORTIFY_SOURCE=3 -D_GLIBCXX_ASSERTIONS)
    target_link_options(${target} INTERFACE $<BUILD_INTERFACE:LINKER:-z,relro> $<BUILD_INTERFACE:LINKER:-z,now>)
endfunction()

# zlg_small_records(target): records of a few hundred bytes are cleared and copied by a loop over vectors. GCC's own choice for x86-64 is
# one instruction (rep stos, rep movs) that takes as long to begin as such a loop to end.
function(zlg_small_records target)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
        set(strategy vector_loop:1024:noalign,libcall:-1:noalign)
        target_compile_options(${target} PRIVATE -mmemset-strategy=${strategy} -mmemcpy-strategy=${strategy})
    endif()
endfunction()

# zlg_library(name SOURCES ... USES ...): library zlg_<name>, zlg::<name> to others, of the folder src/<name>/, seeing only the include roots it USES. Its own
# private headers in other rooms than the source's are named from that folder: "common/bounds.hpp".
function(zlg_library name)
    cmake_parse_arguments(arg "" "" "SOURCES;USES" ${ARGN})
    add_library(zlg_${name} STATIC ${arg_SOURCES})
    add_library(zlg::${name} ALIAS zlg_${name})
    target_include_directories(zlg_${name} PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>)
    target_include_directories(zlg_${name} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR})
    target_link_libraries(zlg_${name} PUBLIC ${arg_USES})
    # The Python module is made of the same archives. Without the right of others to replace our functions it costs next to nothing.
    if(NOT ZLG_CORE_ONLY AND NOT ZLG_LOOP_ONLY)
        set_target_properties(zlg_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
        target_compile_options(zlg_${name} PRIVATE -fno-semantic-interposition)
    endif()
    zlg_flags(zlg_${name})
endfunction()
