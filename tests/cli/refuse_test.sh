#!/bin/sh
# SPDX-License-Identifier: MIT
# Meshes that cannot be baked, outputs that cannot be written, and wrong command lines of limn bake.
#
# usage: see cli.sh
. "$(dirname "$0")/cli.sh"

works bake "$torus" -o torus.limn
mkdir far

# ---- Meshes that cannot be baked

# bad NAME PATTERN: the mesh cannot be baked, and an older output stays as it was.
bad() {
    refuses 1 "^limn: $1:.*$2" bake "$1" -o new.limn
    cp torus.limn kept/old.limn
    refuses 1 "$2" bake "$torus" "$1" -o kept/old.limn
    cmp -s kept/old.limn torus.limn || fail "$1: the older file was damaged"
}
write_broken_meshes
bad edge.obj \
    'non-manifold edge from vertex 1 (line 1) to vertex 2 (line 2): 3 faces share it, among them face 1 (line 6) and face 3 (line 8)'
bad vertex.obj \
    'non-manifold vertex 1 (line 1): face 1 (line 6) and face 2 (line 7)'
bad winding.obj \
    'inconsistent winding: face 1 (line 5) and face 2 (line 6) both run from vertex 1 (line 1) to vertex 2 (line 2)'
bad degenerate.obj '6: degenerate face'
bad repeated.obj '6: repeated face'
bad range.obj '5: .*5'
printf "${four}f 1 2 0\n" >zero.obj
bad zero.obj '5: '
printf "${four}f 1 2 3\nt crease 2/1/0 0 1 -1\n" >negative.obj
bad negative.obj "6: sharpness is negative: '-1'"
printf "${four}f 1 2 3\nt hole 1/0/0 0\n" >hole.obj
bad hole.obj ' every face is a hole'
bad nan.obj '1: '
printf "v 0 0 1e99\nf 1 1 1\n" >huge.obj
bad huge.obj '1: '
printf "" >empty.obj
bad empty.obj ' '
printf "$four" >faceless.obj
bad faceless.obj ' '
printf "OFF\n3 1 0\n0 0 0\n1 0 0\n" >truncated.off
bad truncated.off '2: the file ends too early'
printf "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n" >range.off
bad range.off '6: '
printf "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n" >winding.off
bad winding.off \
    'face 0 (line 7) and face 1 (line 8) both run from vertex 0 (line 3) to vertex 1 (line 4)'

# bipyramid COUNT: its tips have that many neighbours, which are next to each other and to both tips.
bipyramid() {
    awk -v n="$1" 'BEGIN {
        print "v 0 0 1\nv 0 0 -1"
        for (k = 0; k < n; k++) print "v", cos(6.2831853 * k / n), sin(6.2831853 * k / n), 0
        for (k = 0; k < n; k++) print "f 1", k + 3, (k + 1) % n + 3 "\nf 2", (k + 1) % n + 3, k + 3
    }'
}
bipyramid 200 >points.obj
works bake points.obj -q -o points.limn --scheme butterfly # 202 points, whose edges are counted 2200 times
bipyramid 2047 >points.obj
refuses 1 'points.obj: vertex 1 (line 1) has valence 2047: around face 1 (line 2050) there are more than 2048 control points' \
    bake points.obj -o new.limn --scheme butterfly
refuses 1 'has valence 2047: the corners of face 1 (line 2050) have more than 2048 edges in all' bake points.obj -o new.limn
# Of a mesh that is divided first, what the file has is named, and what it has not is not.
refuses 1 'points.obj: vertex 1 (line 1) has valence 2047: around a part of face 1 (line 2050) there are more than 2048' \
    bake points.obj -o new.limn --scheme butterfly --isolate 1
{
    awk 'BEGIN { for (k = 0; k < 1030; k++) print "v", cos(6.2831853 * k / 1030), sin(6.2831853 * k / 1030), 0 }'
    seq -s ' ' 1 1030 | sed 's/^/f /'
} >polygon.obj
refuses 1 'polygon.obj: a vertex of the divided mesh has valence 1030: the corners of a part of face 1 (line 1031) have more' \
    bake polygon.obj -o new.limn --scheme catmark

# Coordinates whose sums would overflow.
printf 'v 0 0 0\nv 1e37 0 0\nv 0 -1.1e37 0\nvt 0 0\nvt 0 2e37\nvt 1 0\nf 1/1 2/2 3/3\n' >large.obj
refuses 1 'large.obj: a coordinate of vertex 3 (line 3) is too large: 1.1e+37; 1e37 is the most' bake large.obj -o new.limn
sed 's/1\.1e37/1e37/' large.obj >uv.obj
refuses 1 'uv.obj: value 2 of uv is too large: 2e+37; 1e37 is the most' bake uv.obj -o new.limn
works bake uv.obj -q -o large.limn --no-channels --isolate 1

refuses 1 'missing.obj: cannot be read: No such file' bake missing.obj -o new.limn
refuses 1 'folder' bake far -o new.limn
refuses 1 'torus.limn: unknown kind' bake torus.limn -o new.limn
refuses 1 'no_folder/new.limn: cannot .*: No such file' bake "$torus" -o no_folder/new.limn
refuses 1 'far: cannot write: Is a directory' bake "$torus" -o far
refuses 1 'far/: cannot write: Is a directory' bake "$torus" -o far/
refuses 2 'there is no output' bake "$torus" -o ''
refuses 1 'torus.limn/new.limn: cannot .*: Not a directory' bake "$torus" -o torus.limn/new.limn
if [ -c /dev/full ]; then refuses 1 '/dev/full: cannot write: No space' bake -q "$torus" -o /dev/full; fi

refuses 2 'no input' bake
refuses 2 'no input' bake -o new.limn
refuses 2 'no output' bake "$torus"
refuses 2 'see limn bake --help' bake "$torus" -o
refuses 2 'see limn bake --help' bake "$torus" -o new.limn --frob
refuses 2 'see limn bake --help' bake "$torus" -o new.limn --quiet=3
refuses 2 "no weights 'Loop'" bake "$torus" -o new.limn --weights Loop
refuses 2 "no scheme 'sqrt3'" bake "$torus" -o new.limn --scheme sqrt3
for scheme in catmark butterfly none; do
    refuses 2 '--weights are those of --scheme loop' bake "$torus" -o new.limn --scheme $scheme --weights warren
    refuses 2 '--creases lomont goes with --scheme loop' bake "$torus" -o new.limn --scheme $scheme --creases lomont
done
for scheme in butterfly none; do
    for creasing in uniform chaikin; do
        refuses 2 '--creasing goes with' bake "$torus" -o new.limn --creasing $creasing --scheme $scheme
    done
    refuses 2 'edge-and-corner goes with' bake "$torus" -o new.limn --boundary edge-and-corner --scheme $scheme
done
for scheme in loop catmark none; do
    refuses 2 '--tension is that of --scheme butterfly' bake "$torus" -o new.limn --tension 0.1 --scheme $scheme
done
for tension in 0.26 -0.2500001 nan 1/16 '' ' '; do
    refuses 2 "'$tension' is not a tension between" bake "$torus" -o new.limn --scheme butterfly --tension "$tension"
done
refuses 2 "no boundary rule ''" bake "$torus" -o new.limn --boundary ''
for steps in '' , weld, ,weld welt 'weld drop' weld,,drop WELD; do
    refuses 2 'cannot repair' bake "$torus" -o new.limn "--repair=$steps"
done
cp "$torus" both.obj
refuses 2 'the output is a .limn file' bake both.obj -o both.obj
refuses 2 'the output is a .limn file' bake "$torus" -o both.OFF
ln both.obj other_name.limn
refuses 2 'both.obj is input and output' bake both.obj -o ./other_name.limn
cmp both.obj "$torus" || fail "the input was overwritten"

finish
