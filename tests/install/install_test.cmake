# SPDX-License-Identifier: MIT
# Installs a build, moves the installed tree, and uses it from a foreign project: find_package, limn_bake and pkg-config.
#
#   cmake -DBUILD_DIR=<a build> -DSOURCE_DIR=<the repository> -DWORK_DIR=<a folder of its own> -P install_test.cmake
#
# WORK_DIR is emptied first. Compilers and flags are those of the build.
cmake_minimum_required(VERSION 3.25)

foreach(argument BUILD_DIR SOURCE_DIR WORK_DIR)
    if(NOT ${argument})
        message(FATAL_ERROR "-D${argument}=... is missing")
    endif()
    cmake_path(ABSOLUTE_PATH ${argument} BASE_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}" NORMALIZE)
endforeach()

# ---- Helpers

function(cached variable)
    file(STRINGS "${BUILD_DIR}/CMakeCache.txt" lines REGEX "^${variable}:[A-Z]+=")
    string(REGEX MATCH "=(.*)" _ "${lines}")
    set(${variable} "${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()

# run(<what> <command>...): fails with all output unless the command succeeds. The output is left in `output`.
function(run what)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
    if(NOT status EQUAL 0)
        list(JOIN ARGN " " command)
        message("${text}") # a fatal error would reflow it
        message(FATAL_ERROR "${what}: ${status}: ${command}")
    endif()
    message(STATUS "${what}: done")
    set(output "${text}" PARENT_SCOPE)
endfunction()

# expect_failure(<what> <regular expression> <command>...)
function(expect_failure what expected)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
    string(REGEX REPLACE "[ \n]+" " " text "${text}") # CMake breaks lines
    if(status EQUAL 0 OR NOT text MATCHES "${expected}")
        message("${text}")
        message(FATAL_ERROR "${what}: ${status}, expected '${expected}'")
    endif()
    message(STATUS "${what}: refused")
endfunction()

function(expect_output what expected)
    if(NOT output MATCHES "${expected}")
        message(FATAL_ERROR "${what}: expected '${expected}'\n${output}")
    endif()
endfunction()

# What a build wrote: time and content.
function(stamp path result)
    if(NOT EXISTS "${path}")
        message(FATAL_ERROR "${path} was not baked")
    endif()
    file(TIMESTAMP "${path}" time "%s.%f" UTC)
    file(SHA256 "${path}" hash)
    set(${result} "${time} ${hash}" PARENT_SCOPE)
endfunction()

function(expect_same what before after)
    if(NOT before STREQUAL after)
        message(FATAL_ERROR "${what} was baked again: ${before}, then ${after}")
    endif()
endfunction()

# ---- Install, and move what was installed

foreach(variable CMAKE_BUILD_TYPE CMAKE_C_COMPILER CMAKE_C_FLAGS CMAKE_CXX_COMPILER CMAKE_CXX_FLAGS CMAKE_GENERATOR
        CMAKE_INSTALL_LIBDIR LIMN_BUILD_BAKER)
    cached(${variable})
endforeach()
if(NOT LIMN_BUILD_BAKER)
    message(FATAL_ERROR "${BUILD_DIR} was built without the baker")
endif()
if(NOT CMAKE_CXX_COMPILER) # only found when OpenSubdiv is there
    find_program(CMAKE_CXX_COMPILER NAMES c++ g++ clang++ REQUIRED)
endif()

unset(ENV{DESTDIR})
file(REMOVE_RECURSE "${WORK_DIR}")
file(MAKE_DIRECTORY "${WORK_DIR}")
run("install" "${CMAKE_COMMAND}" --install "${BUILD_DIR}" --prefix "${WORK_DIR}/first")
file(RENAME "${WORK_DIR}/first" "${WORK_DIR}/moved here") # a space, too
set(prefix "${WORK_DIR}/moved here")
file(GLOB manuals RELATIVE "${BUILD_DIR}/docs" "${BUILD_DIR}/docs/*.1") # where there is help2man
list(FILTER manuals EXCLUDE REGEX "^limn-bench")
list(TRANSFORM manuals PREPEND share/man/man1/)
foreach(path ${manuals} bin/limn include/limn/limn.h include/limn/format.h include/limn/bake.h
        ${CMAKE_INSTALL_LIBDIR}/cmake/limn/LimnBake.cmake ${CMAKE_INSTALL_LIBDIR}/pkgconfig/limn.pc)
    if(NOT EXISTS "${prefix}/${path}")
        message(FATAL_ERROR "${path} was not installed")
    endif()
endforeach()

# Nothing in the package names the machine, or a target that it does not have.
file(GLOB_RECURSE package_files "${prefix}/*.cmake" "${prefix}/*.pc")
foreach(path IN LISTS package_files)
    file(READ "${path}" text)
    foreach(word "${BUILD_DIR}" "${SOURCE_DIR}" "${WORK_DIR}" limn_warnings limn_opensubdiv limn_file limn_options jansson osdCPU)
        string(FIND "${text}" "${word}" place)
        if(NOT place EQUAL -1)
            message(FATAL_ERROR "${path} contains ${word}")
        endif()
    endforeach()
endforeach()

# ---- A foreign project

# Its own copy: the test changes its meshes.
set(project "${WORK_DIR}/project")
file(COPY "${CMAKE_CURRENT_LIST_DIR}/" DESTINATION "${project}")
set(common -S "${project}" "-DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}"
    "-DCMAKE_C_COMPILER=${CMAKE_C_COMPILER}" "-DCMAKE_C_FLAGS=${CMAKE_C_FLAGS}"
    "-DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER}" "-DCMAKE_CXX_FLAGS=${CMAKE_CXX_FLAGS}")
set(package "-DCMAKE_PREFIX_PATH=${prefix}")

function(write_octahedron width)
    file(READ "${CMAKE_CURRENT_LIST_DIR}/octahedron.obj" text)
    string(REPLACE "v 1 0 0" "v ${width} 0 0" text "${text}")
    file(WRITE "${project}/octahedron.obj" "${text}")
endfunction()

# Builds the project in `folder`, which has been configured, and looks at when it bakes.
function(check_builds folder)
    write_octahedron(1)
    run("build" "${CMAKE_COMMAND}" --build "${folder}")
    file(READ "${folder}/assets.txt" assets)
    if(NOT assets STREQUAL "${folder}/app.limn;${folder}/packs/pair.limn")
        message(FATAL_ERROR "LIMN_ASSETS is ${assets}")
    endif()
    run("app" "${folder}/app" "${folder}/app.limn")
    expect_output("app" "octahedron: meshes 1, patches 8, vertices 120, width 2.000")
    run("app with two meshes" "${folder}/app" "${folder}/packs/pair.limn")
    expect_output("app with two meshes" "tetrahedron: meshes 2, patches 4, vertices 60")
    run("app with a generated mesh" "${folder}/app" "${folder}/data.limn")
    run("a mesh inside the program" "${folder}/embedded")
    run("headers" "${folder}/headers")

    stamp("${folder}/app.limn" app_before)
    stamp("${folder}/packs/pair.limn" pair_before)
    run("build without a change" "${CMAKE_COMMAND}" --build "${folder}")
    if(output MATCHES "Baking")
        message(FATAL_ERROR "a build without a change bakes:\n${output}")
    endif()
    stamp("${folder}/app.limn" app_after)
    expect_same(app.limn "${app_before}" "${app_after}")

    execute_process(COMMAND "${CMAKE_COMMAND}" -E sleep 1.1) # some file systems count in seconds
    write_octahedron(3)
    run("build with a changed mesh" "${CMAKE_COMMAND}" --build "${folder}")
    run("app with the changed mesh" "${folder}/app" "${folder}/app.limn")
    expect_output("app with the changed mesh" "width 4.000")
    stamp("${folder}/packs/pair.limn" pair_after)
    expect_same(pair.limn "${pair_before}" "${pair_after}")
endfunction()

set(build "${WORK_DIR}/build")
run("configure" "${CMAKE_COMMAND}" ${common} -B "${build}" -G "${CMAKE_GENERATOR}" ${package})
check_builds("${build}")

find_program(MAKE make)
if(MAKE AND NOT CMAKE_GENERATOR STREQUAL "Unix Makefiles")
    run("configure for make" "${CMAKE_COMMAND}" ${common} -B "${build}-make" -G "Unix Makefiles" ${package})
    check_builds("${build}-make")
endif()

# Changed options bake again, too.
stamp("${build}/packs/pair.limn" before)
file(READ "${project}/CMakeLists.txt" text)
string(REPLACE "--weights warren" "--weights loop" text "${text}")
file(WRITE "${project}/CMakeLists.txt" "${text}")
run("build with changed options" "${CMAKE_COMMAND}" --build "${build}")
stamp("${build}/packs/pair.limn" after)
if(before STREQUAL after)
    message(FATAL_ERROR "pair.limn was not baked again when its options changed")
endif()

# ---- The program of docs/getting-started.md

cached(PNG_PNG_INCLUDE_DIR)
if(PNG_PNG_INCLUDE_DIR)
    set(first_frame "${WORK_DIR}/first_frame")
    run("configure first_frame" "${CMAKE_COMMAND}" -S "${SOURCE_DIR}/examples/first_frame" -B "${first_frame}"
        -G "${CMAKE_GENERATOR}" "-DCMAKE_BUILD_TYPE=${CMAKE_BUILD_TYPE}" "-DCMAKE_C_COMPILER=${CMAKE_C_COMPILER}"
        "-DCMAKE_C_FLAGS=${CMAKE_C_FLAGS}" ${package} "-DMESH=${SOURCE_DIR}/assets/imp.obj")
    run("build first_frame" "${CMAKE_COMMAND}" --build "${first_frame}")
    run("first_frame" "${first_frame}/first_frame" "${first_frame}/mesh.limn" "${first_frame}/picture.png")
    expect_output("first_frame" "imp: 680 of 680 patches")
endif()

# ---- A cross build, as far as a project can tell

set(cross ${common} -G "${CMAKE_GENERATOR}" ${package} -DCMAKE_SYSTEM_NAME=Linux)
expect_failure("a cross build without LIMN_EXECUTABLE" "set LIMN_EXECUTABLE"
    "${CMAKE_COMMAND}" ${cross} -B "${build}-cross-bad")
run("configure a cross build" "${CMAKE_COMMAND}" ${cross} -B "${build}-cross" "-DLIMN_EXECUTABLE=${prefix}/bin/limn")
run("cross build" "${CMAKE_COMMAND}" --build "${build}-cross")
run("app of the cross build" "${build}-cross/app" "${build}-cross/app.limn")

# ---- Mistakes

function(expect_mistake expected code)
    expect_failure("${code}" "${expected}" "${CMAKE_COMMAND}" "${build}" "-DMISTAKE=${code}")
endfunction()
expect_mistake("TARGET is missing" "limn_bake(SOURCES square.off)")
expect_mistake("there is no target nobody" "limn_bake(TARGET nobody SOURCES square.off)")
expect_mistake("SOURCES is missing" "limn_bake(TARGET app OUTPUT other.limn)")
expect_mistake("nothing follows SOURCES" "limn_bake(TARGET app OUTPUT other.limn SOURCES)")
expect_mistake("there is no mesh .*absent.obj" "limn_bake(TARGET app SOURCES absent.obj OUTPUT other.limn)")
expect_mistake("app.limn is baked already" "limn_bake(TARGET app SOURCES square.off)")
expect_mistake("unknown arguments: square.off" "limn_bake(square.off TARGET app SOURCES square.off)")
expect_mistake("use OUTPUT" "limn_bake(TARGET app SOURCES square.off OUTPUT other.limn OPTIONS -o x.limn)")
expect_mistake("use C_ARRAY" "limn_bake(TARGET app SOURCES square.off OUTPUT other.c OPTIONS --c-array x)")

# ---- Limn as a part of the project

# What follows builds Limn again: without optimisation and symbols, which is quicker.
list(APPEND common -DCMAKE_BUILD_TYPE=None)
run("configure with Limn's source" "${CMAKE_COMMAND}" ${common} -B "${build}-source" -G "${CMAKE_GENERATOR}"
    "-DLIMN_SOURCE_DIR=${SOURCE_DIR}")
check_builds("${build}-source")

# ---- A package without the baker

run("configure without the baker" "${CMAKE_COMMAND}" -S "${SOURCE_DIR}" -B "${build}-runtime" -G "${CMAKE_GENERATOR}"
    -DCMAKE_BUILD_TYPE=None "-DCMAKE_C_COMPILER=${CMAKE_C_COMPILER}" "-DCMAKE_C_FLAGS=${CMAKE_C_FLAGS}"
    -DLIMN_BUILD_BAKER=OFF -DLIMN_BUILD_VIEWER=OFF -DLIMN_BUILD_BENCH=OFF -DLIMN_BUILD_EXAMPLES=OFF
    -DLIMN_BUILD_TESTS=OFF)
run("build without the baker" "${CMAKE_COMMAND}" --build "${build}-runtime")
run("install without the baker" "${CMAKE_COMMAND}" --install "${build}-runtime" --prefix "${WORK_DIR}/runtime")
set(runtime_user ${common} -B "${build}-runtime-user" -G "${CMAKE_GENERATOR}"
    "-DCMAKE_PREFIX_PATH=${WORK_DIR}/runtime")
expect_failure("a package without the baker" "built without its baker" "${CMAKE_COMMAND}" ${runtime_user})
run("configure with a baker elsewhere" "${CMAKE_COMMAND}" ${runtime_user} "-DLIMN_EXECUTABLE=${prefix}/bin/limn")
run("build with a baker elsewhere" "${CMAKE_COMMAND}" --build "${build}-runtime-user")
run("app with a baker elsewhere" "${build}-runtime-user/app" "${build}-runtime-user/app.limn")

# ---- pkg-config

find_program(PKG_CONFIG pkg-config REQUIRED)
set(ENV{PKG_CONFIG_PATH} "${prefix}/${CMAKE_INSTALL_LIBDIR}/pkgconfig")
run("pkg-config" "${PKG_CONFIG}" --static --cflags --libs limn)
separate_arguments(pc_flags UNIX_COMMAND "${output}")
separate_arguments(c_flags UNIX_COMMAND "${CMAKE_C_FLAGS}")
run("compile with pkg-config" "${CMAKE_C_COMPILER}" -std=c11 ${c_flags} "${project}/app.c" -o "${WORK_DIR}/pc_app"
    ${pc_flags})
run("app with pkg-config" "${WORK_DIR}/pc_app" "${build}/app.limn")
message(STATUS "${output}")
