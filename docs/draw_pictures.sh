#!/bin/sh
# SPDX-License-Identifier: MIT
# Draws the pictures of the pages in this folder. The target docs-pictures runs it.
#   sh draw_pictures.sh LIMN LIMN_VIEW FIRST_FRAME [MODELS]
# MODELS is a folder with the animated models of characters.md; without it these pictures stay as they are.
set -eu
limn=$1 view=$2 first_frame=$3 models=${4:-}
docs=$(cd "$(dirname "$0")" && pwd)
assets=$docs/../assets
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
baked=$work/baked.limn

# bake MESH [OPTION...]
bake() {
    "$limn" bake -q "$@" -o "$baked"
}

# draw PICTURE OPTION...
draw() {
    picture=$docs/$1
    shift
    "$view" "$baked" --png "$picture" "$@"
}

# getting-started.md
bake "$assets/imp.gltf" --normals exact
"$first_frame" "$baked" "$docs/first_frame.png" 0.25

# weights.md
for weights in loop warren; do
    bake "$assets/torus32_alternating.obj" --weights $weights
    for level in 0 1 2 3 4; do
        draw weights_${weights}_$level.png --level $level --shade flat --eye 1.3,1.7,2.1 --fov 38 --viewport 240x200
    done
done

# mathematics.md
bake "$docs/box.obj" --creases lomont
draw box.png --size 480x400 --eye 2.2,2.2,1.6 --target 0.5,0.5,0.5 --level 4 --control-mesh
bake "$assets/torus32.obj" --normals exact
for how in base interpolated exact; do
    draw light_$how.png --light $how --level 4 --wireframe --spot 0.3,2,2.2 --spot-target 0.35,0.2,0.8 \
        --spot-cone 6 --eye 1.3,1.7,2.1 --fov 32 --viewport 280x230
done

# artists.md
grep -v '^t ' "$assets/mug.obj" >"$work/mug.obj"
for mug in "$work" "$assets"; do
    bake "$mug/mug.obj" --scheme catmark --normals exact
    name=creases
    [ "$mug" = "$assets" ] || name=smooth
    draw artists_mug_$name.png --eye -2.2,2,3 --fov 20 --viewport 300x300
done
bake "$assets/imp_quads.obj" --scheme catmark --normals exact
draw artists_quads.png --size 300x300 --level 1 --wireframe --colour classes
bake "$assets/imp_quads.obj" --normals exact
draw artists_cut.png --size 300x300 --level 1 --wireframe --colour classes
for mode in corners-only all; do
    bake "$assets/imp.gltf" --normals exact --face-varying $mode
    draw artists_uv_$mode.png --colour uv --eye 2.2,1.9,2.2 --target 0,1.6,0 --fov 30 --viewport 300x240
done

# characters.md
# draw_clip FILE CLIP TIME...
draw_clip() {
    name=$(basename "${1%.*}")
    clip=$2
    bake "$models/$1" --images --normals exact --isolate 1
    shift 2
    moment=1
    for time in "$@"; do
        for level in 0 4; do
            draw characters/${name}_${moment}_level$level.png --size 180x180 --level $level --clip "$clip" --time "$time"
        done
        moment=$((moment + 1))
    done
}
if [ -n "$models" ]; then
    mkdir -p "$docs/characters"
    draw_clip Fox.glb Run 0.1 0.4 0.7
    draw_clip CesiumMan.glb 'animation 0' 0.1 0.6 1.2
    draw_clip RiggedFigure.glb 'animation 0' 0 0.5 0.9
    draw_clip rigged_simple.gltf 'animation 0' 0 0.7 1.4
    draw_clip MorphStressTest.gltf Pulse 0.5 1.5 3
fi
