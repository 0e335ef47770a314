# SPDX-License-Identifier: MIT
# limn_bake(): bakes meshes at build time, as part of a target.
#
#   limn_bake(TARGET <target> SOURCES <mesh.obj|.off|.ply|.gltf|.glb|.fbx|.dae>... [OUTPUT <file.limn>]
#             [C_ARRAY <name>] [OPTIONS <option>...])
#
# TARGET   an existing target; the file is there before anything of it is built
# SOURCES  the meshes, in the order they get in the file; relative paths start at CMAKE_CURRENT_SOURCE_DIR
# OUTPUT   the file; relative paths start at CMAKE_CURRENT_BINARY_DIR; default: <target>.limn
# C_ARRAY  bakes into C source, which becomes a part of the target: `extern const unsigned char <name>[]` and
#          `extern const size_t <name>_size`, aligned for limn_pack_open(); OUTPUT is by default: <target>_<name>.c
# OPTIONS  passed on to `limn bake`, such as --weights warren
#
# The file is baked again when a source, the options or the baker change. Its full path is appended to the target's
# property LIMN_ASSETS. A target may have any number of files, each with an OUTPUT of its own.
#
# The baker is the executable named by LIMN_EXECUTABLE, or else the target limn::limn, of the installed package or of
# this build. A cross build needs LIMN_EXECUTABLE: a limn that runs on the machine that builds.

set(LIMN_EXECUTABLE "" CACHE FILEPATH "The limn that bakes assets; empty: limn::limn. Needed when cross compiling")
mark_as_advanced(LIMN_EXECUTABLE)

# What to run, and what to depend on.
function(limni_find_baker command dependency)
    if(LIMN_EXECUTABLE)
        if(NOT EXISTS "${LIMN_EXECUTABLE}" OR IS_DIRECTORY "${LIMN_EXECUTABLE}")
            message(FATAL_ERROR "limn_bake: LIMN_EXECUTABLE: there is no file ${LIMN_EXECUTABLE}")
        endif()
        set(${command} "${LIMN_EXECUTABLE}" PARENT_SCOPE)
        set(${dependency} "${LIMN_EXECUTABLE}" PARENT_SCOPE)
        return()
    endif()
    if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
        message(FATAL_ERROR
            "limn_bake: when cross compiling, set LIMN_EXECUTABLE to a limn that runs on this machine")
    endif()
    if(NOT TARGET limn::limn)
        message(FATAL_ERROR
            "limn_bake: Limn was built without its baker (LIMN_BUILD_BAKER); set LIMN_EXECUTABLE to a limn")
    endif()
    set(${command} limn::limn PARENT_SCOPE)
    set(${dependency} "$<TARGET_FILE:limn::limn>" PARENT_SCOPE)
endfunction()

# The sources with full paths. A source that is not there yet may be made by the build.
function(limni_bake_sources paths)
    set(${paths})
    foreach(source IN LISTS ARGN)
        cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY "${CMAKE_CURRENT_SOURCE_DIR}" NORMALIZE)
        get_source_file_property(generated "${source}" GENERATED)
        if(NOT EXISTS "${source}" AND NOT generated)
            message(FATAL_ERROR "limn_bake: there is no mesh ${source}")
        endif()
        list(APPEND ${paths} "${source}")
    endforeach()
    set(${paths} ${${paths}} PARENT_SCOPE)
endfunction()

function(limn_bake)
    cmake_parse_arguments(PARSE_ARGV 0 bake "" "TARGET;OUTPUT;C_ARRAY" "SOURCES;OPTIONS")
    if(bake_UNPARSED_ARGUMENTS)
        message(FATAL_ERROR "limn_bake: unknown arguments: ${bake_UNPARSED_ARGUMENTS}")
    endif()
    if(bake_KEYWORDS_MISSING_VALUES)
        message(FATAL_ERROR "limn_bake: nothing follows ${bake_KEYWORDS_MISSING_VALUES}")
    endif()
    if(NOT bake_TARGET)
        message(FATAL_ERROR "limn_bake: TARGET is missing")
    endif()
    if(NOT TARGET ${bake_TARGET})
        message(FATAL_ERROR "limn_bake: there is no target ${bake_TARGET}")
    endif()
    if(NOT bake_SOURCES)
        message(FATAL_ERROR "limn_bake: SOURCES is missing")
    endif()
    foreach(option IN LISTS bake_OPTIONS)
        if(option MATCHES "^(-o.*|--o[^=]*(=.*)?)$")
            message(FATAL_ERROR "limn_bake: OPTIONS ${option}: use OUTPUT")
        endif()
        if(option MATCHES "^--c")
            message(FATAL_ERROR "limn_bake: OPTIONS ${option}: use C_ARRAY")
        endif()
    endforeach()

    set(output "${bake_OUTPUT}")
    if(NOT output AND bake_C_ARRAY)
        set(output ${bake_TARGET}_${bake_C_ARRAY}.c)
    elseif(NOT output)
        set(output ${bake_TARGET}.limn)
    endif()
    cmake_path(ABSOLUTE_PATH output BASE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}" NORMALIZE)
    get_property(outputs GLOBAL PROPERTY LIMNI_BAKE_OUTPUTS)
    if(output IN_LIST outputs)
        message(FATAL_ERROR "limn_bake: ${output} is baked already; give this call an OUTPUT of its own")
    endif()
    set_property(GLOBAL APPEND PROPERTY LIMNI_BAKE_OUTPUTS "${output}")

    limni_find_baker(command dependency)
    limni_bake_sources(sources ${bake_SOURCES})
    cmake_path(GET output PARENT_PATH folder)
    cmake_path(GET output FILENAME file_name)

    # One build step per file. Its options and sources are kept in a file, because not every build tool notices that a
    # command has changed.
    if(bake_C_ARRAY)
        list(APPEND bake_OPTIONS --c-array ${bake_C_ARRAY})
    endif()
    list(LENGTH outputs number)
    set(step ${bake_TARGET}_limn_${number})
    set(arguments_file "${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${step}.txt")
    file(GENERATE OUTPUT "${arguments_file}" CONTENT "${sources}\n${bake_OPTIONS}\n")
    add_custom_command(OUTPUT "${output}"
        COMMAND "${CMAKE_COMMAND}" -E make_directory "${folder}"
        COMMAND ${command} bake ${bake_OPTIONS} -o "${output}" -- ${sources}
        DEPENDS ${sources} "${dependency}" "${arguments_file}"
        COMMENT "Baking ${file_name}" VERBATIM)
    add_custom_target(${step} DEPENDS "${output}")
    add_dependencies(${bake_TARGET} ${step})
    if(bake_C_ARRAY)
        target_sources(${bake_TARGET} PRIVATE "${output}")
    else()
        set_property(TARGET ${bake_TARGET} APPEND PROPERTY LIMN_ASSETS "${output}")
    endif()
endfunction()
