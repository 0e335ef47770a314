#!/bin/sh
# SPDX-License-Identifier: MIT
# Bakes what the table of hashes is about: the meshes of the repository in every way that makes other bytes.
#
#   sh bake.sh LIMN SOURCE_FOLDER OUTPUT_FOLDER
set -eu
limn=$1
assets=$2/assets
output=$3

# bake NAME ARGUMENT...
bake() {
    name=$1
    shift
    "$limn" bake -q "$@" -o "$output/$name.limn"
}

rm -rf "$output"
mkdir -p "$output"
bake torus "$assets/torus32.obj"
bake torus-pieces "$assets/torus32_alternating.obj" --normals exact --isolate 1
bake sail "$assets/sail.obj" --normals exact
bake sail-warren "$assets/sail.obj" --normals exact --weights warren --boundary edge-and-corner --isolate 1
bake sail-butterfly "$assets/sail.obj" --normals exact --scheme butterfly --tension 0.02
bake cube "$assets/cube.off" --normals exact --creases lomont
bake cube-quads "$assets/cube.off" --normals exact --scheme catmark --isolate 1
bake cube-butterfly "$assets/cube.off" --scheme butterfly --isolate 1
bake box "$2/docs/box.obj" --normals exact --creasing chaikin
bake imp "$assets/imp.obj" --normals exact
bake imp-pieces "$assets/imp.obj" --normals exact --isolate 1
bake imp-quads "$assets/imp_quads.obj" --normals exact --scheme catmark
bake imp-flat "$assets/imp_quads.obj" --normals exact --scheme none
bake mug "$assets/mug.obj" --normals exact --scheme catmark
bake together --normals exact --isolate auto "$assets"/*.obj "$assets"/*.off
bake waving "$assets/imp.gltf" --normals exact --isolate 1 --images
bake character "$2/tests/fuzz/corpus/gltf/character.glb" --normals exact --images
