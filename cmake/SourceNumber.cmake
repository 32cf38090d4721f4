# A number made of the text of source files, so that two programs can tell whether they were compiled from the same.
#
# As a module: zlg_source_number(target name namespace sources...) adds to the target the constant namespace::name, to be
# declared where it is used as `extern const std::uint64_t name`; made anew whenever a source changes.
# As a script: cmake -DSOURCES=a;b -DMADE=file.cpp -DNAME=name -DNAMESPACE=a::b -P SourceNumber.cmake

if(CMAKE_SCRIPT_MODE_FILE)
    set(all "")
    foreach(source ${SOURCES})
        file(SHA256 ${source} sum)
        string(APPEND all ${sum})
    endforeach()
    string(SHA256 sum "${all}")
    string(SUBSTRING ${sum} 0 16 digits)
    file(WRITE ${MADE}
        "// Made by cmake/SourceNumber.cmake.\n#include <cstdint>\n\nnamespace ${NAMESPACE} {\n\n"
        "extern const std::uint64_t ${NAME};\nconst std::uint64_t ${NAME} = 0x${digits}u;\n\n}  // namespace ${NAMESPACE}\n")
    return()
endif()

set(zlg_source_number_script ${CMAKE_CURRENT_LIST_FILE})

function(zlg_source_number target name namespace)
    set(made ${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp)
    add_custom_command(OUTPUT ${made}
        COMMAND ${CMAKE_COMMAND} "-DSOURCES=${ARGN}" -DMADE=${made} -DNAME=${name} -DNAMESPACE=${namespace}
            -P ${zlg_source_number_script}
        DEPENDS ${ARGN} ${zlg_source_number_script} VERBATIM)
    target_sources(${target} PRIVATE ${made})
endfunction()
