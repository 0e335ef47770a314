# SPDX-License-Identifier: MIT
# What is installed: the libraries with their headers, the programs, the CMake package `limn` and limn.pc. Everything
# in it refers to its own place only, so that the installed tree can be moved.
include(CMakePackageConfigHelpers)

set(limn_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/limn)
set(limn_pc_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

install(TARGETS limn_runtime EXPORT limnTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(FILES include/limn/limn.h include/limn/character.h include/limn/format.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/limn)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(TARGET limn_bake)
    install(TARGETS limn_bake EXPORT limnTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
    install(FILES include/limn/bake.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/limn)
    install(TARGETS limn EXPORT limnTargets RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
if(TARGET limn-view)
    install(TARGETS limn-view RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

# find_package(limn)
install(EXPORT limnTargets NAMESPACE limn:: DESTINATION ${limn_package_dir})
configure_package_config_file(cmake/limnConfig.cmake.in ${PROJECT_BINARY_DIR}/limnConfig.cmake
    INSTALL_DESTINATION ${limn_package_dir} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/limnConfigVersion.cmake
    VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES
    ${PROJECT_BINARY_DIR}/limnConfig.cmake ${PROJECT_BINARY_DIR}/limnConfigVersion.cmake cmake/LimnBake.cmake
    DESTINATION ${limn_package_dir})

# pkg-config. The prefix is found from the place of limn.pc, unless the folders were given as absolute paths.
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}" OR IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
    set(limn_pc_prefix "${CMAKE_INSTALL_PREFIX}")
    set(limn_pc_libdir "${CMAKE_INSTALL_FULL_LIBDIR}")
    set(limn_pc_includedir "${CMAKE_INSTALL_FULL_INCLUDEDIR}")
else()
    file(RELATIVE_PATH limn_pc_up "/${limn_pc_dir}" "/")
    string(REGEX REPLACE "/$" "" limn_pc_up "${limn_pc_up}")
    set(limn_pc_prefix "\${pcfiledir}/${limn_pc_up}")
    set(limn_pc_libdir "\${prefix}/${CMAKE_INSTALL_LIBDIR}")
    set(limn_pc_includedir "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
endif()
configure_file(cmake/limn.pc.in ${PROJECT_BINARY_DIR}/limn.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/limn.pc DESTINATION ${limn_pc_dir})
