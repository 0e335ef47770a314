#!/bin/sh
# SPDX-License-Identifier: MIT
# Bakes corpus/limn again, which a new format version needs.
#
#   sh bake_corpus.sh LIMN
set -eu
limn=$(realpath "$1")
cd "$(dirname "$0")/corpus"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# bake NAME MESH OPTION...
bake() {
    name=$1
    mesh=$2
    shift 2
    "$limn" bake -q "$mesh" -o "limn/$name.limn" "$@"
}

square="v 0 0 0\nv 1 0 0\nv 1 1 0.25\nv 0 1 0\n"
printf "${square}f 1 2 3 4\n" >"$work/quads.obj"
printf "${square}f 1 2 3\nf 1 3 4\n" >"$work/two.obj"
printf "${square}v 2 0 0\nf 1 2 3 4\nf 2 5 3\n" >"$work/divided.obj"
bake tetrahedron obj/tetrahedron.obj
bake normals obj/tetrahedron.obj --normals exact
bake pieces obj/tetrahedron.obj --isolate 1
bake pieces_normals obj/tetrahedron.obj --isolate 1 --normals exact
bake quads "$work/quads.obj" --scheme catmark
bake quads_pieces "$work/quads.obj" --scheme catmark --isolate 1 --normals exact
bake butterfly "$work/two.obj" --scheme butterfly --normals exact
bake divided "$work/divided.obj" --scheme none
bake channels obj/uv.obj --isolate 1
bake character gltf/character.glb --isolate 1 --images
