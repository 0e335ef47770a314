#!/bin/sh
# SPDX-License-Identifier: MIT
# Opens the window of limn-view under Xvfb, presses keys, and compares what it shows with pictures made without one.
#
# usage: window_test.sh LIMN_VIEW COMPARE_PICTURES FILE.limn MESH.obj OUTPUT_FOLDER
# Exit status 77: there is no Xvfb. LIMN_TEST_ASSETS may name a folder with an animated mesh.
set -u

if [ $# -ne 5 ]; then
    echo "usage: $0 LIMN_VIEW COMPARE_PICTURES FILE.limn MESH.obj OUTPUT_FOLDER" >&2
    exit 2
fi
view=$1
compare=$2
file=$3
mesh=$4
failures=0
command -v Xvfb >/dev/null || exit 77

mkdir -p "$5" || exit 1
folder=$(mktemp -d "$5/window_test.XXXXXX") || exit 1
cd "$folder" || exit 1

fail() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}

Xvfb -displayfd 3 -screen 0 640x480x24 3>display >xvfb.log 2>&1 &
server=$!
trap 'kill $server 2>/dev/null' EXIT
tries=0
while [ ! -s display ] && [ $tries -lt 100 ]; do
    sleep 0.05
    tries=$((tries + 1))
done
[ -s display ] || exit 77
DISPLAY=:$(cat display)
export DISPLAY

# window NAME FILE KEYS OPTION...: the window's pictures become NAME.1.png, NAME.2.png, …
window() {
    name=$1
    shown=$2
    keys=$3
    shift 3
    timeout 60 "$view" "$shown" --size 240x180 --keys "$keys" "$@" >/dev/null || fail "$name: exit status $?"
    number=1
    for shot in limn-view-*.png; do
        mv "$shot" "$name.$number.png"
        number=$((number + 1))
    done
}

# expect NAME TOLERANCE FILE OPTION...: a picture without a window shows the same. Windows have a quarter of the
# samples, so outlines differ by shades, and lines and borders of colours all along: in the mean by less than 0.5 and 2 of 255.
expect() {
    name=$1
    tolerance=$2
    shown=$3
    shift 3
    "$view" "$shown" --size 240x180 --png expected.png "$@" || fail "$name: no picture"
    "$compare" "$name.png" expected.png "$tolerance" >difference ||
        fail "$name differs from its picture by $(cat difference)"
}

expect_different() {
    "$compare" "$1.png" "$2.png" 0.5 >/dev/null && fail "$1 and $2 show the same"
}

expect_same() {
    cmp -s "$1.png" "$2.png" || fail "$1 and $2 differ"
}

# Without the text, switch after switch.
shots="h,f12,t,f12,t,c,f12,c,f12,c,f12,c,c,c,p,f12,p,f,f12,f,w,w,f12,home,f12,h,f12"
window plain "$file" "$shots" --level 2
expect plain.1 0.5 "$file" --level 2
expect plain.2 2 "$file" --level 2 --wireframe
expect plain.3 0.5 "$file" --level 2 --colour levels
expect_different plain.1 plain.2
expect plain.4 2 "$file" --level 2 --colour classes
expect_different plain.4 plain.3
expect plain.5 0.5 "$file" --level 2 --colour normals
expect_different plain.1 plain.6
expect_different plain.1 plain.8
expect_same plain.1 plain.9
expect_different plain.1 plain.10
expect plain.7 0.5 "$file" --level 2 --shade flat

# A driver that has no more than OpenGL 3.3 draws the same.
MESA_GL_VERSION_OVERRIDE=3.3
MESA_EXTENSION_OVERRIDE="-GL_ARB_buffer_storage -GL_ARB_multi_draw_indirect"
export MESA_GL_VERSION_OVERRIDE MESA_EXTENSION_OVERRIDE
window older "$file" "$shots" --level 2
unset MESA_GL_VERSION_OVERRIDE MESA_EXTENSION_OVERRIDE
for number in 1 2 3 4 5 6 7 8 9; do
    expect_same older.$number plain.$number
done
expect_different older.10 older.9

# Levels of detail from an eye, sewn and not, coarser, and with the runtime's light.
eye="--eye 0.5,1.8,2 --target 0,1.6,0 --viewport 240x180 --colour levels --wireframe"
window frame "$file" "h,f12,j,f12,j,-,-,-,-,f12,m,f12,l,f12" $eye
expect frame.1 2 "$file" $eye
for number in 2 3 4 5; do
    cmp -s frame.$number.png frame.$((number - 1)).png && fail "frame.$number: nothing changed"
done
light="--light exact --spot 0.5,2.5,2 --level 2"
window light "$file" "h,f12,o,10,f12" $light
expect light.1 0.5 "$file" $light
expect_different light.1 light.2

# A mesh file that is dropped, after one that cannot be read.
window dropped "$file" "h,f12,+missing.obj,f12,+$mesh,f12" --level 2 2>errors
grep -q missing.obj errors || fail "a missing file was dropped, and nothing said"
expect_same dropped.1 dropped.2
expect dropped.3 0.5 "$mesh" --level 2

# An animated mesh, baked as it is opened.
fox=${LIMN_TEST_ASSETS:-}/animated/Fox.glb
if [ -f "$fox" ]; then
    window fox "$fox" "h,f12,space,10,f12,tab,f12" --clip Run --time 0.4 --level 2
    expect fox.1 0.5 "$fox" --clip Run --time 0.4 --level 2
    expect_different fox.1 fox.2
    expect_different fox.2 fox.3
fi

# What is wrong.
"$view" missing.limn --keys h 2>errors && fail "a missing file"
[ "$(wc -l <errors)" -eq 1 ] || fail "a missing file: not one line of errors"
"$view" "$file" --keys nonsense 2>/dev/null
[ $? -eq 2 ] || fail "--keys nonsense"

if [ $failures -gt 0 ]; then
    echo "$failures failures; see $folder" >&2
    exit 1
fi
rm -rf "$folder"
