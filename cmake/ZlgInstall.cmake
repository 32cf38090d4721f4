# What `cmake --install` puts where: components program, development, python and doc.
#
# The doors are the libraries whose headers another program may include: after find_package(zlg) they are zlg::core, zlg::twin, ...

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(zlg_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/zlg)

# zlg_install_libraries(DOOR...): archives, headers and the package's configuration.
function(zlg_install_libraries)
    foreach(door ${ARGN})
        get_target_property(folder zlg_${door} SOURCE_DIR)
        set_target_properties(zlg_${door} PROPERTIES EXPORT_NAME ${door})
        install(TARGETS zlg_${door} EXPORT zlg COMPONENT development INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
        install(DIRECTORY ${folder}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
    endforeach()
    # What the linker of this one compiler optimises with, no other can use: the ordinary code beside it is for all.
    foreach(door ${ARGN})
        install(CODE "execute_process(COMMAND \"${CMAKE_STRIP}\" --strip-debug --enable-deterministic-archives --remove-section=.comment
            --remove-section=.gnu.lto_* --strip-symbol=__gnu_lto_v1
            \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_LIBDIR}/$<TARGET_FILE_NAME:zlg_${door}>\" COMMAND_ERROR_IS_FATAL ANY)"
            COMPONENT development)
    endforeach()
    install(EXPORT zlg NAMESPACE zlg:: FILE zlgTargets.cmake DESTINATION ${zlg_package_dir} COMPONENT development)
    set(zlg_doors ${ARGN})
    set(made ${CMAKE_CURRENT_BINARY_DIR}/package)
    configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/zlgConfig.cmake.in ${made}/zlgConfig.cmake INSTALL_DESTINATION ${zlg_package_dir})
    write_basic_package_version_file(${made}/zlgConfigVersion.cmake COMPATIBILITY SameMinorVersion)
    install(FILES ${made}/zlgConfig.cmake ${made}/zlgConfigVersion.cmake DESTINATION ${zlg_package_dir} COMPONENT development)
    configure_file(${PROJECT_SOURCE_DIR}/cmake/zlg-core.pc.in ${made}/zlg-core.pc @ONLY)
    install(FILES ${made}/zlg-core.pc DESTINATION ${CMAKE_INSTALL_DATADIR}/pkgconfig COMPONENT development)
endfunction()
