#!/bin/sh
# SPDX-License-Identifier: MIT
# Draws small pictures and makes mistakes on purpose.
#
# usage: view_test.sh LIMN_VIEW FILE.limn OUTPUT_FOLDER
set -u

if [ $# -ne 3 ]; then
    echo "usage: $0 LIMN_VIEW FILE.limn OUTPUT_FOLDER" >&2
    exit 2
fi
view=$1
file=$2
folder=$3
failures=0

# Never touch what somebody else keeps in the folder: everything happens in one of our own.
mkdir -p "$folder" || exit 1
folder=$(mktemp -d "$folder/view_test.XXXXXX") || exit 1

export LSAN_OPTIONS="suppressions=$(cd "$(dirname "$0")" && pwd)/leaks.txt:print_suppressions=0"

fail() {
    echo "FAILED: $*" >&2
    failures=$((failures + 1))
}

# Bytes [$2, $2 + $3) of file $1 in decimal, separated by single spaces.
bytes() {
    od -An -v -tu1 -j "$2" -N "$3" "$1" | tr -s ' \n' ' ' | sed 's/^ //; s/ $//'
}

# expect_picture NAME WIDTH HEIGHT OPTION...: a PNG of that size that is the same when made again.
expect_picture() {
    name=$1
    width=$2
    height=$3
    shift 3
    picture=$folder/$name.png
    again=$folder/$name.again.png
    "$view" "$file" --png "$picture" --size "${width}x$height" "$@" || {
        fail "$name: exit status $?"
        return
    }
    "$view" "$file" --png "$again" --size "${width}x$height" "$@" || fail "$name: second picture"
    cmp -s "$picture" "$again" || fail "$name: two runs differ"

    # The signature, then the first chunk: width and height are its first two big-endian numbers.
    header="137 80 78 71 13 10 26 10 0 0 0 13 73 72 68 82"
    size="$((width >> 24)) $((width >> 16 & 255)) $((width >> 8 & 255)) $((width & 255))"
    size="$size $((height >> 24)) $((height >> 16 & 255)) $((height >> 8 & 255)) $((height & 255))"
    [ "$(bytes "$picture" 0 24)" = "$header $size" ] || fail "$name: not a PNG of ${width}x$height"
    # A uniform picture compresses to almost nothing, the background alone to a few bytes a row.
    [ "$(wc -c <"$picture")" -gt $((height * 10)) ] || fail "$name: nothing to be seen in it"
}

# draw NAME OPTION...
draw() {
    name=$1
    shift
    "$view" "$file" --png "$folder/$name.png" "$@" || fail "$name: exit status $?"
}

# expect_different NAME NAME: the options between them do something.
expect_different() {
    if cmp -s "$folder/$1.png" "$folder/$2.png"; then fail "$1 and $2 are the same picture"; fi
}

# expect_error STATUS ARGUMENT...: that status, words on stderr, nothing on stdout, and no file;
# OUT among the arguments is where the picture would go.
expect_error() {
    status=$1
    shift
    rm -rf "$folder/error"
    mkdir "$folder/error"
    # Nothing is allocated yet where the command line is wrong.
    ASAN_OPTIONS=detect_leaks=$((status != 2)) "$view" "$@" >"$folder/stdout" 2>"$folder/stderr"
    actual=$?
    [ $actual -eq "$status" ] || fail "'$*': exit status $actual instead of $status"
    [ -s "$folder/stderr" ] || fail "'$*': no message"
    [ ! -s "$folder/stdout" ] || fail "'$*': words on stdout"
    [ -z "$(ls -A "$folder/error")" ] || fail "'$*': left a file behind"
}

expect_picture shaded 160 120
expect_picture level_0 160 120 --level 0
expect_picture wireframe 160 120 --wireframe --level 2
expect_picture control_mesh 160 120 --control-mesh
expect_picture everything 161 97 --wireframe --control-mesh --level 1 --mesh 0
expect_picture tall 60 240
expect_picture flat 160 120 --shade flat --level 1
expect_picture smooth 160 120 --shade smooth --level 1
expect_different flat smooth
for how in base interpolated exact; do
    expect_picture light_$how 160 120 --light $how --spot 0.5,2.5,2
done
expect_different light_base light_interpolated
expect_different light_interpolated light_exact
expect_different light_base shaded
draw spot_cone --light exact --spot 0.5,2.5,2 --spot-target 0,1,0 --spot-cone 8 --size 160x120
expect_different spot_cone light_exact
eye="--eye 0.5,1.8,2 --target 0,1.6,0 --tolerance 60"
draw levels $eye --size 160x120 --colour levels --wireframe
draw frame_lines $eye --size 160x120 --wireframe
draw whole $eye --viewport 160x90 --colour levels
draw culled $eye --viewport 160x90 --colour levels --cull
draw overview $eye --viewport 160x90 --colour levels --cull --overview
draw nothing --size 32x32 --eye 0,0,9 --target 0,0,20 --cull
expect_different wireframe frame_lines
expect_different frame_lines levels
expect_different culled overview
cmp -s "$folder/whole.png" "$folder/culled.png" || fail "what --cull leaves out can be seen"
[ "$(bytes "$folder/whole.png" 16 8)" = "0 0 0 160 0 0 0 90" ] || fail "a frame is not as large as its viewport"

expect_different shaded level_0
expect_different shaded wireframe
expect_different shaded control_mesh

out=$folder/error/out.png
head -c 1000 "$file" >"$folder/truncated.limn"
size=$(wc -c <"$file")
head -c $((size - 1)) "$file" >"$folder/one_byte_short.limn"
: >"$folder/empty.limn"
expect_error 1 "$folder/missing.limn" --png "$out"
expect_error 1 "$folder/truncated.limn" --png "$out"
expect_error 1 "$folder/one_byte_short.limn" --png "$out"
expect_error 1 "$folder/empty.limn" --png "$out"
expect_error 1 "$folder" --png "$out"
expect_error 1 "$0" --png "$out"
expect_error 1 "$file" --png "$out" --mesh 1000000
expect_error 1 "$file" --png "$folder/error/no_folder/out.png"
expect_error 1 "$file" --png "$folder"
"$view" "$file" --png /dev/null --size 32x32 || fail "a picture for /dev/null"
[ -c /dev/null ] || fail "/dev/null was replaced"

expect_error 2
# There is no window without a display.
unset DISPLAY WAYLAND_DISPLAY
expect_error 1 "$file"
expect_error 2 "$file" --overview --eye 1,2,3
expect_error 2 "$file" --light base
expect_error 2 "$file" --keys nonsense
expect_error 2 "$file" --png "$out" --keys t
expect_error 2 --png "$out"
expect_error 2 "$file" --png
expect_error 2 "$file" --png ""
expect_error 2 "$file" "$file" --png "$out"
expect_error 2 "$file" --png "$out" --unknown
for level in 5 -1 1x x "" nan 4294967296 18446744073709551617; do
    expect_error 2 "$file" --png "$out" --level "$level"
done
for pixels in 0x10 10x0 10 10x 10x10x10 x10 8193x10 10x8193 -1x10 "10 x10" 4294967297x10 ""; do
    expect_error 2 "$file" --png "$out" --size "$pixels"
done
for mesh in -1 x 0x "" 4294967296; do
    expect_error 2 "$file" --png "$out" --mesh "$mesh"
done

draw normals --size 160x120 --colour normals
expect_different shaded normals

# A character, baked as it is opened: its material, its texture coordinates, and a moment of its clip.
imp=$file
file=$(cd "$(dirname "$0")/.." && pwd)/assets/imp.gltf
for colour in materials clay uv classes; do
    draw character_$colour --size 160x120 --level 1 --colour $colour
done
draw character_waves --size 160x120 --level 1 --clip wave --time 0.25
expect_different character_materials character_clay
expect_different character_uv character_clay
expect_different character_classes character_clay
expect_different character_waves character_materials
file=$imp

expect_error 1 "$file" --png "$out" --colour uv # it has none
expect_error 2 "$file" --png "$out" --colour red
expect_error 2 "$file" --png "$out" --shade round
expect_error 2 "$file" --png "$out" --light dim
expect_error 2 "$file" --png "$out" --spot 1,2,3
expect_error 2 "$file" --png "$out" --light exact --spot 1,2
expect_error 2 "$file" --png "$out" --light exact --spot-target 1,2,3
expect_error 2 "$file" --png "$out" --light exact --spot 1,2,3 --spot-cone 90
expect_error 1 "$file" --png "$out" --light exact --spot 1,2,3 --spot-target 1,2,3
expect_error 2 "$file" --png "$out" --overview
expect_error 2 "$file" --png "$out" --lod length
expect_error 2 "$file" --png "$out" --eye 1,2
expect_error 2 "$file" --png "$out" --eye 1,2,3 --fov 180
expect_error 2 "$file" --png "$out" --eye 1,2,3 --level 2 --tolerance 3
expect_error 2 "$file" --png "$out" --eye 1,2,3 --viewport 9000x9000
expect_error 1 "$file" --png "$out" --eye 1,2,3 --target 1,2,3
expect_error 1 "$file" --png "$out" --eye 1,2,3 --up 0,0,0

# A failure leaves an older picture as it was.
cp "$folder/shaded.png" "$folder/kept.png"
"$view" "$folder/truncated.limn" --png "$folder/kept.png" 2>/dev/null
cmp -s "$folder/shaded.png" "$folder/kept.png" || fail "a failure damaged an older picture"

"$view" --help | grep -q -e --control-mesh || fail "--help"
"$view" --help | grep -q -e "f12 .*picture" || fail "--help says nothing about keys"
"$view" --help | grep -q -e --tolerance || fail "--help says nothing about frames"
"$view" --version | grep -q '^limn-view [0-9]*\.[0-9]*\.[0-9]*$' || fail "--version"

if [ $failures -gt 0 ]; then
    echo "$failures failures; see $folder" >&2
    exit 1
fi
rm -rf "$folder"
