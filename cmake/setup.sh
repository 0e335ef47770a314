#!/bin/sh
# SPDX-License-Identifier: MIT
# Sets everything up on Debian 12: installs the packages of packages.txt that are missing, and builds.
#
#   sh cmake/setup.sh sample   bakes the sample mesh and leaves a dense OBJ and pictures in build/sample
#   sh cmake/setup.sh test     builds and runs all tests; LIMN_TEST_ASSETS may name a folder of further meshes
#
# Run it as root or as a user who may use sudo. Nothing is installed when nothing is missing.
set -eu
cd "$(dirname "$0")/.."

say() {
    printf '\n== %s\n' "$*"
}

die() {
    printf 'setup.sh: %s\n' "$*" >&2
    exit 1
}

as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@"
    elif command -v sudo >/dev/null; then
        sudo "$@"
    else
        die "run this as root, or install sudo"
    fi
}

missing_packages() {
    while read -r name _; do
        case $name in '' | '#'*) continue ;; esac
        status=$(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null) || status=
        [ "$status" = installed ] || echo "$name"
    done <cmake/packages.txt
}

install_packages() {
    if ! command -v apt-get >/dev/null; then
        say "No apt-get here: what is needed is listed in cmake/packages.txt"
        return
    fi
    missing=$(missing_packages)
    [ -n "$missing" ] || return 0
    # shellcheck disable=SC2086 # one word per package
    set -- $missing
    say "Installing $*"
    as_root apt-get update -q
    as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -q --no-install-recommends "$@"
}

sample() {
    say "Building"
    cmake --preset release
    cmake --build --preset release --target limn limn-view
    limn=build/release/baker/limn
    view=build/release/viewer/limn-view
    folder=build/sample
    mkdir -p $folder

    say "Baking assets/imp.obj"
    $limn bake assets/imp.obj -o $folder/imp.limn
    $limn info $folder/imp.limn >$folder/imp.txt
    $limn export $folder/imp.limn --level 4 --weld -o $folder/imp_level4.obj
    $view $folder/imp.limn --png $folder/imp.png
    $view $folder/imp.limn --png $folder/imp_wireframe.png --level 2 --wireframe
    $view $folder/imp.limn --png $folder/imp_control_mesh.png --control-mesh
    $view $folder/imp.limn --png $folder/imp_levels.png --eye 0.8,1.9,3.1 --tolerance 30 --colour levels --wireframe

    say "Baking assets/mug.obj, by Catmull-Clark"
    $limn bake assets/mug.obj -o $folder/mug.limn --scheme catmark --normals exact
    $view $folder/mug.limn --png $folder/mug.png

    say "Baking assets/imp.gltf, which moves"
    $limn bake assets/imp.gltf -o $folder/waving.limn --normals exact --isolate 1
    $view $folder/waving.limn --png $folder/waving.png --clip wave --time 0.25
    $view $folder/waving.limn --png $folder/waving_uv.png --colour uv

    say "Look at these, in $(pwd)/$folder:"
    cat <<END
imp.png                the surface, at level 4
imp_wireframe.png      its triangles at level 2
imp_control_mesh.png   the surface in its control mesh
imp_levels.png         a frame with levels of detail, from blue (0) to orange (4), and its seams
imp_level4.obj         the dense mesh, closed, as an OBJ
imp.limn               the baked file
imp.txt                what is in it
mug.png                quads, two octagons and creases, by Catmull-Clark
waving.png             a moment of the clip "wave" of a skinned imp
waving_uv.png          its texture coordinates, with their seam
mug.limn, waving.limn  the baked files
END
}

# The full run comes last. Sanitizers, which come with assertions, leave out what takes long.
run_tests() {
    for preset in asan arm64 release; do
        say "Building: $preset"
        cmake --preset $preset
        cmake --build --preset $preset
    done
    say "Testing: asan"
    ctest --preset asan -LE slow
    say "Testing: arm64"
    ctest --preset arm64
    say "Testing: release"
    ctest --preset release
}

case ${1:-} in
sample | test) ;;
*) die "usage: sh cmake/setup.sh sample | test" ;;
esac
install_packages
if [ "$1" = sample ]; then sample; else run_tests; fi
