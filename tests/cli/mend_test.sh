#!/bin/sh
# SPDX-License-Identifier: MIT
# limn bake: repair, isolation, texture coordinates, and what is not a manifold.
#
# usage: see cli.sh
. "$(dirname "$0")/cli.sh"
write_broken_meshes
works bake -q "$torus" -o torus.limn

# ---- Welding goes by place: surfaces that only touch stay apart

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n' >pillow.obj
works bake pillow.obj -o pillow.limn
works export pillow.limn --level 4 --weld -o pillow_dense.obj
expect "welded vertices of a pillow" "$(grep -c '^v ' pillow_dense.obj)" $((3 + 15 * 3 + 105 * 2))

# ---- What no face uses does not matter

printf 'v 5 5 5\nv 6 5 5\nv 5 6 5\nv 5 5 6\nv 1e30 0 0\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' >far.obj
works bake -q far.obj -o far.limn
works export far.limn --level 1 --weld -o far_dense.obj
expect "welded vertices beside an unused one" "$(grep -c '^v ' far_dense.obj)" 10

# ---- Repair

notes 'repaired: 1 degenerate and 0 repeated' bake degenerate.obj -o repaired.limn --repair=drop
notes 'repaired: 0 degenerate and 1 repeated' bake repeated.obj -o repaired.limn --repair=weld,drop
notes 'loose.obj: repaired: 3 control points welded' bake loose.obj -o loose.limn --repair=weld
works info loose.limn --json
expect "welded control points" "$(json control_points)" 4
works bake -q loose.obj -o loose.limn --repair=all
refuses 1 'edge.obj: non-manifold edge' bake edge.obj -o new.limn --repair
refuses 2 'cannot repair' bake edge.obj -o new.limn --repair=split
refuses 1 'range.obj:5: ' bake range.obj -o new.limn --repair
printf "${four}f 1 2 2\n" >hopeless.obj
refuses 1 'hopeless.obj: the mesh has no faces' bake -q hopeless.obj -o new.limn --repair

# ---- No scheme

refuses 2 "no scheme 'cubic'" bake "$sail" -o new.limn --scheme cubic
works bake "$sail" -o flat.limn --scheme none --normals exact
says stdout '88 faces, 1 classes'

# ---- Isolation

# What a face takes at a level, with the points of level 1, by the last `info --json`.
json_ns() {
    awk -v level="$1" '/"ns_per_face"/ { at = NR + 1 + level } NR == at { ns = $1 } /"points_ns_per_face"/ { print ns + $2 }' stdout.txt
}

refuses 2 "there is no face-varying mode 'corner'" bake "$torus" -o new.limn --face-varying corner
refuses 2 'with --scheme none, --face-varying is all' bake "$torus" -o new.limn --scheme none --face-varying none
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nf 1/1 2/2 3/3\n' >uv.obj
refuses 1 'uv.obj:6: face refers to texture coordinate 3, but the file has 2' bake uv.obj -o new.limn
printf 'vt 0 1\n' >>uv.obj
works bake -q uv.obj -o uv.limn --face-varying corners-plus2
works info uv.limn
says stdout '^uv .* uv .* uv .* corners-plus2 .* 3 '
works verify uv.limn --against uv.obj
says stdout '^uv, channel 0: [0-9]* values; '
works convert -q uv.obj uv_again.obj
grep -q '^f 1/1 2/2 3/3$' uv_again.obj || fail 'texture coordinates are not in uv_again.obj'
notes "lost, as the format has none: the texture coordinates 'uv'" convert uv.obj uv.ply
refuses 2 "cannot isolate '2'" bake "$torus" -o new.limn --isolate 2
works bake -q "$sail" -o isolated.limn --isolate 1
works info isolated.limn
says stdout '^baked with .* isolate=1$'
says stdout 'which are made of [0-9]* pieces'
way='[0-9]* bytes, of which [0-9]* are tables, and [0-9.]* ns per face at level 3'
notes "sail: isolated: 0\.[0-9]* times the bytes in 1\.[0-9]* times the time: $way; isolated $way" \
    bake "$sail" "$torus" -o chosen.limn --isolate auto
says stderr "torus32: not isolated: its tables take at most 256 KB: $way; isolated $way"
works info chosen.limn
says stdout 'isolate=mixed bytes=[0-9]* isolated-bytes=[0-9]* ns=[0-9]* isolated-ns=[0-9]*$'
notes "sail: not isolated: 0\.[0-9]* times the bytes in 1\.[0-9]* times the time: $way; isolated $way" \
    bake "$sail" -o alone.limn --isolate auto --scheme catmark
notes 'sail: isolated: ' bake "$sail" -o alone.limn --isolate auto
works info alone.limn --json
bytes=0
for key in table_size columns_size patch_size points_size; do bytes=$((bytes + $(json $key))); done
says stdout " isolated-bytes=$bytes "
expect "time of an isolated mesh" "$(sed -n 's/.* isolated-ns=\([0-9]*\).*/\1/p' stdout.txt)" "$(json_ns 3 | awk '{ print int($1 * 88) }')"
notes 'torus32: not isolated: ' bake "$torus" -o alone.limn --isolate auto
works info --json alone.limn
expect "points of a mesh that is not isolated" "$(json points)" 16
notes 'torus32.obj: not isolated: with the butterfly' bake "$torus" -o alone.limn --isolate auto --scheme butterfly
works info alone.limn
says stdout ' normals=none isolate=0$'
# Counted by hand: a torus of one class, 12 control points of which 11 are in mirrored sums, 32 patches. A patch, its
# rows, its blocks of 8 rows (at level 4, 64 rows and 48 pairs), and a 32nd of a change of class; isolated, four pieces,
# of which level 0 takes three: 18 points are looked at for each and 12 summed; and 2 points of 9.5 terms.
counted() {
    works bake -q "$torus" -o counted.limn --isolate "$1"
    works info --json counted.limn
    expect "ns at level $2" "$(json_ns "$2" | awk '{ printf "%.2f", $1 }')" "$(awk "BEGIN { printf \"%.2f\", $3 }")"
}
counted 0 0 '18 + 3 * 0.35 + 12 * 0.5 + 80 / 32'
counted 0 4 '18 + 153 * 0.35 + (12 * 8 + 11 * 6) * 0.5 + 80 / 32'
counted 1 0 '18 + 3 * 0.35 + 3 * (18 * 1.25 + 12 * 0.5) + 80 / 32 + 2 * 0.75 + 9.5 * 0.5'
counted 1 4 '18 + 153 * 0.35 + 4 * 18 * 1.25 + (3 * 5 + 6) * 12 * 0.5 + 80 / 32 + 2 * 0.75 + 9.5 * 0.5'
# Tables of tens of kilobytes for any mesh without creases, and few more for several.
tables_below() {
    limit=$1
    shift
    works bake -q "$@" -o small.limn --isolate 1
    works info --json small.limn
    [ "$(json table_size)" -le "$limit" ] || fail "$*: tables of $(json table_size) bytes, more than $limit"
}
tables_below 65536 "$assets/imp.obj"
tables_below 65536 "$assets/imp_quads.obj" --scheme catmark
tables_below 131072 "$assets"/*.obj

# ---- What is not a manifold

notes 'edge.obj: split: 1 edges, sharp now, and 2 vertices, of which 2 are corners now; 4 control points added' \
    bake edge.obj -o split.limn --non-manifold split
works info split.limn --json
expect "split control points" "$(json control_points)" 9
notes 'split: 0 edges, sharp now, and 1 vertices, of which 1 are corners now; 1 control points' \
    bake vertex.obj -o vertex.limn --non-manifold=split
notes 'split: 1 edges' bake winding.obj -o winding.limn --non-manifold split
refuses 1 'degenerate.obj:6: degenerate' bake degenerate.obj -o new.limn --non-manifold split
refuses 1 'edge.obj: non-manifold edge' bake edge.obj -o new.limn --non-manifold refuse
refuses 1 'edge.obj: not a manifold, and sheets of the butterfly would not meet' bake edge.obj -o new.limn --non-manifold split \
    --scheme butterfly -q
truncate -s 4294967295 huge.obj # of which nothing is on the disk
refuses 1 'huge.obj: the file has 4 GiB or more' bake huge.obj -o new.limn
rm huge.obj
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >one.obj
refuses 1 'one.obj: all faces are holes' bake one.obj -o new.limn --boundary none
refuses 2 "cannot 'weld' what is not a manifold" bake edge.obj -o new.limn --non-manifold weld
works bake -q "$torus" -o clean.limn --non-manifold split
cmp -s clean.limn torus.limn || fail "splitting a manifold makes a difference"

finish
