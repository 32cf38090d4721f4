# The Debian packages that scripts/package makes: zlg, libzlg-dev and python3-zlg, one for each component but the documents, which
# are with the program.

# An address below .invalid is none (RFC 2606): whoever hands packages out gives one that is read.
set(ZLG_MAINTAINER "zlg maintainers <maintainers@zlg.invalid>" CACHE STRING "who answers for the packages")

# What Debian wants beside the files of each package.
string(TIMESTAMP zlg_now "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(made ${CMAKE_BINARY_DIR}/package)
configure_file(packaging/changelog.in ${made}/changelog @ONLY)
set(CPACK_COMPONENTS_ALL doc)
set(CPACK_COMPONENT_PROGRAM_GROUP main)
set(CPACK_COMPONENT_DOC_GROUP main)
foreach(pair program:zlg development:libzlg-dev python:python3-zlg)
    string(REPLACE ":" ";" pair ${pair})
    list(GET pair 0 component)
    list(GET pair 1 package)
    string(TOUPPER ${component} upper)
    list(APPEND CPACK_COMPONENTS_ALL ${component})
    if(component STREQUAL "program")
        set(upper MAIN)
    endif()
    set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${package})
    # In another prefix than Debian's own these are not wanted.
    install(CODE "
        if(CMAKE_INSTALL_PREFIX STREQUAL \"/usr\")
            set(folder \"/usr/share/doc/${package}\")
            file(INSTALL \"${PROJECT_SOURCE_DIR}/packaging/copyright\" DESTINATION \"\${folder}\")
            execute_process(COMMAND gzip -9nc \"${made}/changelog\" OUTPUT_FILE \"\$ENV{DESTDIR}\${folder}/changelog.gz\" COMMAND_ERROR_IS_FATAL ANY)
        endif()" COMPONENT ${component})
endforeach()
install(FILES README.md ARCHITECTURE.md CHANGELOG.md CONTRIBUTING.md SECURITY.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc)
install(FILES tests/regressions.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/tests COMPONENT doc)
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT doc)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc
    FILES_MATCHING PATTERN *.py PATTERN *.m PATTERN *.toml PATTERN main.cpp PATTERN CMakeLists.txt)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME zlg)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${ZLG_MAINTAINER})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

set(about "Switching of the helicity turns the magnetic drift of a Zeeman laser gyro
round at regular intervals. zlg runs such a gyro, fills the gaps of the
measurement at the switches, subtracts the false rotation after them, and
says how good each increment of angle is.
")
foreach(each "MAIN|software|the program, its manual, documents and examples" "DEVELOPMENT|libraries|the static libraries and headers for C++20"
        "PYTHON|Python package|the module zlg for Python 3")
    string(REPLACE "|" ";" each ${each})
    list(GET each 0 component)
    list(GET each 1 kind)
    list(GET each 2 content)
    set(CPACK_DEBIAN_${component}_DESCRIPTION "${kind} of a Zeeman laser gyro that switches its mode\n${about}\nThis package holds ${content}.")
endforeach()
set(CPACK_DEBIAN_MAIN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_MAIN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_MAIN_PACKAGE_SUGGESTS python3-zlg)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libboost-dev, libeigen3-dev, libfmt-dev, libhdf5-dev, liblz4-dev, libtomlplusplus-dev, libzstd-dev, zlib1g-dev")
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "${ZLG_PYTHON_DEPENDS}, python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, python3-pandas")
include(CPack)
