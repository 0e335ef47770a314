#!/bin/sh
# SPDX-License-Identifier: MIT
# Every mesh, baked by two programs: the same files and the same words. For programs of different compilers; minutes.
#
#   sh all_meshes.sh LIMN OTHER_LIMN SOURCE_FOLDER WORK_FOLDER
#
# LIMN_TEST_ASSETS may name a folder of further meshes.
set -eu

[ $# -eq 4 ] || {
    echo "usage: $0 LIMN OTHER_LIMN SOURCE_FOLDER WORK_FOLDER" >&2
    exit 2
}
programs="$(realpath "$1") $(realpath "$2")"
source_folder=$(realpath "$3")
mkdir -p "$4"
cd "$4"

# bake NAME ARGUMENT...: leaves NAME.limn, if there is one, and NAME.txt with the status and all words.
bake() {
    name=$1
    shift
    status=0
    "$program" bake "$@" -o "$name.limn" >"$name.txt" 2>&1 || status=$?
    echo "status $status" >>"$name.txt"
    [ $status -le 1 ] || exit 1
}

# In turn as they are; mended with other options, isolated; as polygons, by Catmull-Clark. File names are relative, so
# that both programs say the same.
bake_all() {
    turn=0
    while read -r mesh; do
        name=$(basename "$(dirname "$mesh")")-$(basename "$mesh")
        case $turn in
        0) bake "plain-$name" "$mesh" ;;
        1) bake "mended-$name" --repair --non-manifold split --weights warren --boundary edge-and-corner --isolate 1 "$mesh" ;;
        2) bake "polygons-$name" --repair --non-manifold split --scheme catmark --isolate 1 "$mesh" ;;
        esac
        turn=$(((turn + 1) % 3))
    done <../meshes.txt
}

find "$source_folder/assets" ${LIMN_TEST_ASSETS:+"$LIMN_TEST_ASSETS"} -name '*.obj' -o -name '*.off' |
    LC_ALL=C sort >meshes.txt
[ -s meshes.txt ]
number=0
for program in $programs; do
    rm -rf $number
    mkdir $number
    (cd $number && bake_all)
    number=$((number + 1))
done
diff -r 0 1
echo "$(grep -c '' meshes.txt) meshes, $(find 0 -name '*.limn' | wc -l) files: the same from both"
