#!/bin/sh
# SPDX-License-Identifier: MIT
# limn convert: what it says of formats, and what it refuses.
#
# usage: see cli.sh
. "$(dirname "$0")/cli.sh"
write_broken_meshes

write_house
notes 'triangulated' convert house.obj lomont.obj -f lomont
says stdout '^lomont.obj: 8 vertices, 10 faces$'
expect "Lomont's first line" "$(head -n 1 lomont.obj)" '#SubdivisionSurfL 0.1'
expect "Lomont's sizes" "$(sed -n 2p lomont.obj)" 'si 8 10 17 0'
expect "Lomont's entries" "$(cut -d' ' -f1 lomont.obj | uniq -c | tr -s ' \n' ' ')" \
    " 1 #SubdivisionSurfL 1 si 8 v 10 f 30 hd 8 vs 5 t "
expect "boundaries" "$(grep '^hd -1' lomont.obj | sort | uniq -c | tr -s ' ')" ' 4 hd -1 inf'
expect "one sharpness, twice" "$(grep -c '^hd .* 0.333333343$' lomont.obj)" 2
notes "lomont.obj: a mesh of Lomont's with OpenSubdiv's creases" bake lomont.obj -o lomont.limn
works bake -q lomont.obj -o lomont.limn --creases lomont
notes "house.obj: Chaikin's creasing is ignored" bake house.obj -o lomont.limn --creases lomont
notes 'house.off: lost, as the format has no tags: 5 creases, 2 corners, 1 holes, and rules' convert house.obj house.off
works convert house.off house.ply
says stdout '^house.ply: 8 vertices, 5 faces$'
works convert house.ply house.off.obj -q
expect "convert -q" "$(cat stdout.txt)" ""
works convert house.off house.data --format off
cmp house.off house.data || fail "convert --format: not the same"
works convert house.off /dev/null -f ply
awk '/^hd/ && !done { $3 = 7; done = 1 } { print }' lomont.obj >bad_weight.obj
refuses 1 'bad_weight.obj:21: half-edges 1 and .* are a pair, but differ in sharpness' convert bad_weight.obj new.obj
printf 'f 1 2 3\nt corner 1/1/0 9 1\n' | cat house.obj - >extra.obj
notes 'extra.obj: ignored: 1 corners that name no vertex (the first is in line 23)' convert extra.obj kept_tags.obj
grep -q 'corner 1/1/0 9' kept_tags.obj && fail "convert keeps the tag of a vertex that is not there"
refuses 1 'edge.obj: non-manifold edge' convert edge.obj new.obj --format lomont
works convert edge.obj edge.ply
refuses 2 "cannot 'weld' what is not" convert edge.obj new.obj --non-manifold weld
notes 'edge.obj: split: 1 edges' convert edge.obj split_lomont.obj --format lomont --non-manifold split
says stdout '^split_lomont.obj: 9 vertices, 3 faces$'
works bake split_lomont.obj -o split_lomont.limn -q
refuses 1 'missing.obj: cannot be read' convert missing.obj new.ply
refuses 1 'nan.obj:1: ' convert nan.obj new.ply
refuses 1 'no_folder/new.ply: cannot ' convert house.obj no_folder/new.ply -q
if [ -c /dev/full ]; then refuses 1 '/dev/full: cannot write: No space' convert house.off /dev/full -f ply; fi
echo old >kept/old.obj
refuses 1 'nan.obj:1: ' convert nan.obj kept/old.obj
expect "the older file" "$(cat kept/old.obj)" old
refuses 2 'one input and one output' convert
refuses 2 'one input and one output' convert house.obj
refuses 2 'one input and one output' convert house.obj a.obj b.obj
refuses 2 'new.stl: the output must end in .obj, .off or .ply' convert house.obj new.stl
refuses 2 "no format 'OBJ'" convert house.obj new.obj --format OBJ
refuses 2 'house.obj is input and output' convert house.obj ./house.obj
refuses 2 'see limn convert --help' convert house.obj new.obj --frob

finish
