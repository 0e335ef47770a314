#!/bin/sh
# SPDX-License-Identifier: MIT
# Same input, same bytes: builds the baker with gcc, without optimisation, and with clang, and compares what they and the
# build under test make of every mesh, and what they say about it.
#
# usage: determinism_test.sh LIMN SOURCE_FOLDER WORK_FOLDER
#
# LIMN_TEST_ASSETS may name a folder of further meshes. Exit status 77: a compiler is missing, nothing was tested.
set -eu

[ $# -eq 3 ] || {
    echo "usage: $0 LIMN SOURCE_FOLDER WORK_FOLDER" >&2
    exit 2
}
limn=$1
source_folder=$(cd "$2" && pwd)
mkdir -p "$3"
work_folder=$(cd "$3" && pwd)

for compiler in gcc clang; do
    command -v $compiler >/dev/null || {
        echo "$compiler is missing" >&2
        exit 77
    }
done

build() {
    cmake -S "$source_folder" -B "$work_folder/$1" -G Ninja --log-level=WARNING \
        -DCMAKE_C_COMPILER="${1%-*}" -DCMAKE_BUILD_TYPE="${1#*-}" -DCMAKE_DISABLE_FIND_PACKAGE_OpenSubdivCPU=ON \
        -DLIMN_BUILD_TESTS=OFF -DLIMN_BUILD_BENCH=OFF -DLIMN_BUILD_EXAMPLES=OFF -DLIMN_BUILD_VIEWER=OFF -DLIMN_INSTALL=OFF
    cmake --build "$work_folder/$1" --target limn
}

program() {
    [ "$1" = tested ] && echo "$limn" || echo "$work_folder/$1/baker/limn"
}

# bake BUILD NAME ARGUMENT...: leaves NAME.limn, if there is one, and NAME.txt with the status and all words.
bake() {
    program=$(program "$1")
    name=$2
    shift 2
    status=0
    "$program" bake "$@" -o "$name.limn" >"$name.txt" 2>&1 || status=$?
    [ $status -le 1 ] || echo "$program bake $*: status $status" >>"$work_folder/failures"
    echo "status $status" >>"$name.txt"
}

# Bakes the meshes in turn: as they are; mended with the other options, isolated; as polygons, by Catmull-Clark; and those of
# the repository together, in these ways, isolated or not as the baker chooses, with Lomont's creases, and by the butterfly.
# File names are relative, so that the builds say the same words.
bake_all() {
    build=$1
    shift
    rm -rf "$work_folder/$build.out"
    mkdir "$work_folder/$build.out"
    cd "$work_folder/$build.out"
    turn=0
    for mesh in "$@"; do
        name=$(basename "$(dirname "$mesh")")-$(basename "$mesh")
        case $turn in
        0) bake "$build" "plain-$name" "$mesh" ;;
        1) bake "$build" "mended-$name" --repair --non-manifold split --weights warren --boundary edge-and-corner --isolate 1 "$mesh" ;;
        2) bake "$build" "polygons-$name" --repair --non-manifold split --scheme catmark --isolate 1 "$mesh" ;;
        esac
        turn=$(((turn + 1) % 3))
    done
    set -- "$source_folder"/assets/*.obj "$source_folder"/assets/*.off
    bake "$build" dense-all --normals exact "$@"
    bake "$build" isolated-all --normals exact --weights warren --isolate 1 "$@"
    bake "$build" chosen-all --normals exact --scheme catmark --isolate auto "$@"
    bake "$build" butterfly-all --normals exact --scheme butterfly --tension 0.02 --isolate 1 "$@"
    bake "$build" lomont --creases lomont --normals exact "$source_folder"/assets/*.obj "$source_folder"/docs/box.obj
    bake "$build" character --images "$source_folder/tests/fuzz/corpus/gltf/character.glb"
    cd "$source_folder"
}

rm -f "$work_folder/failures"
for build in gcc-Debug clang-Release; do
    build "$build" >"$work_folder/$build.log" 2>&1 || {
        cat "$work_folder/$build.log" >&2
        exit 1
    }
done

list=$work_folder/meshes.txt
find "$source_folder/assets" ${LIMN_TEST_ASSETS:+"$LIMN_TEST_ASSETS"} -name '*.obj' -o -name '*.off' |
    LC_ALL=C sort >"$list"
set --
while read -r mesh; do
    set -- "$@" "$mesh"
done <"$list"
for build in gcc-Debug clang-Release tested; do
    bake_all "$build" "$@"
done

cd "$work_folder"
for build in clang-Release tested; do
    diff -rq gcc-Debug.out "$build.out" >>failures || true
done
ls gcc-Debug.out/*.limn >/dev/null
if [ -s failures ]; then
    cat failures >&2
    exit 1
fi
echo "$# meshes, $(find gcc-Debug.out -name '*.limn' | wc -l) files: the same from each build"
