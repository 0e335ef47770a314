# SPDX-License-Identifier: MIT
# Finds tinygltf as a library, as Debian has it, and defines TinyGLTF::tinygltf.
find_path(TinyGLTF_INCLUDE_DIR tiny_gltf.h)
find_library(TinyGLTF_LIBRARY tinygltf)
mark_as_advanced(TinyGLTF_INCLUDE_DIR TinyGLTF_LIBRARY)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(TinyGLTF REQUIRED_VARS TinyGLTF_LIBRARY TinyGLTF_INCLUDE_DIR)
