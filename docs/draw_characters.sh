#!/bin/sh
# SPDX-License-Identifier: MIT
# The pictures of docs/characters.md. The target docs-characters runs it.
#   sh draw_characters.sh LIMN LIMN_VIEW FOLDER OUT_FOLDER
# FOLDER has the animated models.
set -eu
limn=$1 view=$2 folder=$3 out=$4
mkdir -p "$out"
baked=$(mktemp)
trap 'rm -f "$baked"' EXIT

# draw FILE CLIP TIME...
draw() {
    name=$(basename "${1%.*}")
    clip=$2
    "$limn" bake -q "$folder/$1" --images --normals exact --isolate 1 -o "$baked"
    shift 2
    moment=1
    for time in "$@"; do
        for level in 0 4; do
            "$view" "$baked" --png "$out/${name}_${moment}_level$level.png" --size 180x180 --level $level \
                --clip "$clip" --time "$time"
        done
        moment=$((moment + 1))
    done
}
draw Fox.glb Run 0.1 0.4 0.7
draw CesiumMan.glb 'animation 0' 0.1 0.6 1.2
draw RiggedFigure.glb 'animation 0' 0 0.5 0.9
draw rigged_simple.gltf 'animation 0' 0 0.7 1.4
draw MorphStressTest.gltf Pulse 0.5 1.5 3
