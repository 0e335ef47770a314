#!/bin/sh
# SPDX-License-Identifier: MIT
# The pictures of docs/frames.md. The target docs-frames runs it.
#   sh draw_frames.sh LIMN_BENCH LIMN_VIEW SOURCE_FOLDER CHROMIUM OUT_FOLDER
# CHROMIUM takes the picture of the report, and Xvfb shows the window.
set -eu
bench=$1 view=$2 source=$3 chromium=$4 out=$5
work=$(mktemp -d)
server=
trap 'rm -rf "$work"; [ -z "$server" ] || kill "$server"' EXIT

# scene NAME FRAME SIZE OPTION...
scene() {
    png=$out/$(basename "$1" .scene)_$2.png
    frame=$2 size=$3 scene=$1
    shift 3
    "$bench" frame --scene "$scene" --png "$png" --frame "$frame" --size "$size" "$@"
}
mkdir -p "$out"
scene hero 45 400x225
scene hero 84 800x450
scene crowd 20 640x360
scene crowd 60 640x360
scene terrain 60 400x225
scene terrain 90 400x225
sed '$a fov 12' "$source/bench/scenes/worst.scene" >"$work/worst.scene" # closer, as all is of one level
scene "$work/worst.scene" 60 640x360 --mesh "$source/assets/imp.obj"

"$bench" frame --scene crowd --frames 60 --clock thread --peers floats,dense,discrete --html "$work/report.html" >/dev/null
"$chromium" --headless --no-sandbox --hide-scrollbars --window-size=900,1310 --screenshot="$out/report.png" \
    "file://$work/report.html" >/dev/null 2>&1

Xvfb -displayfd 3 -screen 0 1024x768x24 3>"$work/display" >/dev/null 2>&1 &
server=$!
until [ -s "$work/display" ]; do sleep 0.1; done
(cd "$work" && DISPLAY=:$(cat display) "$view" "$source/assets/imp.gltf" --size 800x500 --lod error --keys c,t,30,f12 >/dev/null)
mv "$work/limn-view-001.png" "$out/window.png"
