#!/bin/sh
# SPDX-License-Identifier: MIT
# limn convert: through every format and back, to the same bits and the same baked bytes.
#
# usage: see cli.sh
. "$(dirname "$0")/cli.sh"

# same_bake A B OPTION...: two meshes give the same file, byte for byte; they have one name.
same_bake() {
    first=$1
    second=$2
    shift 2
    works bake -q "$first" -o one.limn "$@"
    works bake -q "$second" -o two.limn "$@"
    cmp one.limn two.limn || fail "$first and $second do not give the same file"
    run 0 bake -q "$first" -o one.limn --creases lomont "$@"
    works bake -q "$second" -o two.limn --creases lomont "$@"
    cmp one.limn two.limn || fail "$first and $second do not give the same file with Lomont's rules"
}

# tags_of FILE: its creases and corners that are not smooth, in an order of their own.
tags_of() {
    awk '$2 == "crease" && $6 != 0 { print $2, ($4 < $5 ? $4 " " $5 : $5 " " $4), $6 }
         $2 == "corner" && $5 != 0' "$1" | sort
}

# round_trip MESH FOLDER: through every format and back. What has tags keeps them where formats have.
round_trip() {
    name=$(basename "$1")
    name=${name%.*}
    for format in obj off ply lomont; do mkdir -p "$2/$format" "$2/back_$format"; done
    run 0 convert -q "$1" "$2/obj/$name.obj"
    run 0 convert -q "$1" "$2/lomont/$name.obj" --format lomont
    same_bake "$1" "$2/obj/$name.obj"
    same_bake "$1" "$2/lomont/$name.obj" --no-channels
    works convert -q "$2/obj/$name.obj" "$2/back_obj/$name.obj"
    cmp "$2/obj/$name.obj" "$2/back_obj/$name.obj" || fail "$1: OBJ changes on the way"
    works convert -q "$2/lomont/$name.obj" "$2/back_obj/$name.obj"
    same_bake "$1" "$2/back_obj/$name.obj" --no-channels
    works convert -q "$2/back_obj/$name.obj" "$2/back_lomont/$name.obj" --format=lomont
    cmp "$2/lomont/$name.obj" "$2/back_lomont/$name.obj" || fail "$1: Lomont's OBJ changes on the way"
    tags_of "$2/obj/$name.obj" >one.txt
    tags_of "$2/back_obj/$name.obj" >two.txt
    cmp one.txt two.txt || fail "$1: tags change on the way through Lomont's OBJ"
    for format in off ply; do
        run 0 convert -q "$1" "$2/$format/$name.$format"
        works convert -q "$2/$format/$name.$format" "$2/back_$format/$name.obj"
        sed '/^v*t /d; s,/[0-9]*,,g' "$2/obj/$name.obj" | cmp - "$2/back_$format/$name.obj" ||
            fail "$1: not the same bits after $format"
    done
}

write_house
mkdir trip
round_trip house.obj trip
round_trip "$cube" trip
round_trip "$sail" trip
if [ -n "${LIMN_TEST_ASSETS:-}" ]; then
    for name in loop_cubes_semisharp loop_icos_infsharp catmark_hole_test2 catmark_dart_edgecorner; do
        round_trip "$LIMN_TEST_ASSETS/opensubdiv_shapes/$name.obj" trip
    done
fi

finish
