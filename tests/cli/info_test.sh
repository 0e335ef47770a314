#!/bin/sh
# SPDX-License-Identifier: MIT
# limn info, and files that are not whole.
#
# usage: see cli.sh
. "$(dirname "$0")/cli.sh"
bake_samples
mkdir far

# ---- info

works info several.limn
for name in torus32 sail cube; do says stdout "^$name "; done
says stdout 'scheme=loop weights=loop boundary=edge-only'
says stdout '^torus32  *0\.[0-9]*  *0\.[0-9]*  *0\.[0-9]*  *0\.[0-9]*$'
says stdout '^torus32  *[0-9.]*  *[0-9.]*  *[0-9.]*  *[0-9.]*  *[0-9.]*  *0\.0$'
works info --json several.limn
for key in file version size table_size columns_size class_count piece_count meshes name faces control_points patches points points_size patch_size \
    bytes_per_face ns_per_face points_ns_per_face edge_errors classes use_count; do
    says stdout "^ *\"$key\": "
done
expect "version" "$(json version)" 6
expect "size" "$(json size)" "$(size_of several.limn)"
expect "meshes" "$(grep -c '"bytes_per_face"' stdout.txt)" 4
expect "names" "$(sed -n 's/^ *"name": "\(.*\)",*$/\1/p' stdout.txt | tr '\n' ' ')" "torus32 sail cube torus32 "
expect "classes" "$(grep -c '"use_count"' stdout.txt)" "$(json class_count)"
expect "uses" "$(sed -n 's/^ *"use_count": \([0-9]*\),*$/\1/p' stdout.txt | awk '{ sum += $1 } END { print sum }')" \
    $((32 + 88 + 16 + 32))
expect "brackets" "$(tr -cd '{[' <stdout.txt | wc -c)" "$(tr -cd '}]' <stdout.txt | wc -c)"
several=$(json class_count)
works bake -q "$torus" "$sail" "$cube" -o three.limn
works info three.limn --json
expect "shared classes" "$(json class_count)" "$several"
works info torus.limn --json
expect "faces" "$(json faces)" 32
expect "patches" "$(json patches)" 32
expect "control points" "$(json control_points)" 16
expect "class count" "$(json class_count)" 1
for version in 5 7; do
    { printf "LIMN\\00$version" && tail -c +6 torus.limn; } >other.limn
    refuses 1 "other.limn: it has format version $version, and this limn reads 6 to 6; bake it again" info other.limn
done

# A name that is not UTF-8 is a name nevertheless.
latin=$(printf 'caf\351')
cp "$torus" "$latin.obj"
works bake -q "$latin.obj" -o latin.limn
works info latin.limn --json
says stdout '^ *"name": "caf'

# damaged COMMAND...: each is tried with files that are not whole; FILE stands for them.
damaged() {
    size=$(size_of sail.limn)
    : >empty.limn
    head -c 63 sail.limn >header.limn
    head -c 1000 sail.limn >beginning.limn
    head -c $((size - 1)) sail.limn >short.limn
    { cat sail.limn && printf x; } >long.limn
    { head -c $((size - 5)) sail.limn && printf 'x' && tail -c 4 sail.limn; } >changed.limn
    refuses 1 'missing.limn: No such file' "$1" missing.limn "$2" "$3" "$4" "$5"
    refuses 1 'empty.limn: .*empty' "$1" empty.limn "$2" "$3" "$4" "$5"
    for name in header beginning short; do
        refuses 1 "$name.limn: the blob is shorter" "$1" $name.limn "$2" "$3" "$4" "$5"
    done
    refuses 1 'long.limn: the blob is longer' "$1" long.limn "$2" "$3" "$4" "$5"
    refuses 1 'changed.limn: the file is damaged' "$1" changed.limn "$2" "$3" "$4" "$5"
    refuses 1 'torus32.obj: the blob is not a .limn file' "$1" "$torus" "$2" "$3" "$4" "$5"
    refuses 1 'far: ' "$1" far "$2" "$3" "$4" "$5"
}
refuses 1 'gone.limn: No such file' info gone.limn
damaged export --level 1 -o new.obj
damaged export --level=1 --weld -o new.ply
for name in header beginning short long changed; do
    refuses 1 "$name.limn: the " info $name.limn
    refuses 1 "$name.limn: the " info $name.limn --json
done
refuses 2 'one .limn file' info
refuses 2 'one .limn file' info torus.limn sail.limn
refuses 2 'see limn info --help' info torus.limn --frob
if [ -c /dev/full ]; then
    "$limn" info torus.limn --json >/dev/full 2>stderr.txt
    expect "info --json to a full disk" $? 1
    "$limn" info torus.limn >/dev/full 2>stderr.txt
    expect "info to a full disk" $? 1
fi

finish
