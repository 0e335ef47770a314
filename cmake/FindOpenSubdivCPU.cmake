# SPDX-License-Identifier: MIT
# Finds the CPU part of OpenSubdiv and defines OpenSubdiv::osdCPU.
#
# Not find_package(OpenSubdiv): Debian 12 ships a package config whose targets name a static library that is not there,
# which is a hard error. Distributions that ship a good one need nothing more than what is looked for here.
find_path(OpenSubdivCPU_INCLUDE_DIR opensubdiv/far/primvarRefiner.h)
find_library(OpenSubdivCPU_LIBRARY osdCPU)
mark_as_advanced(OpenSubdivCPU_INCLUDE_DIR OpenSubdivCPU_LIBRARY)

if(OpenSubdivCPU_INCLUDE_DIR AND EXISTS "${OpenSubdivCPU_INCLUDE_DIR}/opensubdiv/version.h")
    file(STRINGS "${OpenSubdivCPU_INCLUDE_DIR}/opensubdiv/version.h" version_lines
        REGEX "^#define OPENSUBDIV_VERSION_(MAJOR|MINOR|PATCH) +[0-9]+")
    string(REGEX MATCHALL "[0-9]+" version_parts "${version_lines}")
    list(JOIN version_parts "." OpenSubdivCPU_VERSION)
    unset(version_lines)
    unset(version_parts)
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenSubdivCPU
    REQUIRED_VARS OpenSubdivCPU_LIBRARY OpenSubdivCPU_INCLUDE_DIR
    VERSION_VAR OpenSubdivCPU_VERSION)

if(OpenSubdivCPU_FOUND AND NOT TARGET OpenSubdiv::osdCPU)
    add_library(OpenSubdiv::osdCPU UNKNOWN IMPORTED)
    # Include directories of imported targets are SYSTEM: no warnings from OpenSubdiv's headers.
    set_target_properties(OpenSubdiv::osdCPU PROPERTIES
        IMPORTED_LOCATION "${OpenSubdivCPU_LIBRARY}"
        INTERFACE_INCLUDE_DIRECTORIES "${OpenSubdivCPU_INCLUDE_DIR}")
endif()
