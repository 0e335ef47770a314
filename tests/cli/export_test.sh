#!/bin/sh
# SPDX-License-Identifier: MIT
# limn export: whole meshes.
#
# usage: see cli.sh
. "$(dirname "$0")/cli.sh"
bake_samples

# ---- export: V + E, then each level has four times the faces of the one before

for level in 0 1 2 3 4; do
    steps=$((1 << level))
    works export torus.limn --level $level --weld -o welded.obj
    inner=$(((steps - 1) * (steps - 2) / 2))
    expect "welded, level $level" "$(obj_counts welded.obj)" \
        "$((16 + 48 * (steps - 1) + 32 * inner)) $((32 * steps * steps)) 0"
    works export torus.limn -l $level -o patches.obj
    rows=$(((steps + 1) * (steps + 2) / 2))
    expect "patches, level $level" "$(obj_counts patches.obj | cut -d' ' -f1,2)" \
        "$((32 * rows)) $((32 * steps * steps))"
    works export torus.limn --level $level --weld -o welded.ply
    vertices=$((16 + 48 * (steps - 1) + 32 * inner))
    header=$(sed '/^end_header/q' welded.ply | wc -c | tr -d ' ')
    expect "ply, level $level" "$(size_of welded.ply)" $((header + 12 * vertices + 13 * 32 * steps * steps))
done
sed '/^end_header/q' welded.ply >stdout.txt
last="export welded.ply"
says stdout '^ply$'
says stdout '^format binary_little_endian 1.0$'
says stdout "^element vertex $((16 + 15 * 48 + 105 * 32))\$"
says stdout "^element face $((256 * 32))\$"
works export several.limn --level 2 --weld -o several.obj
expect "objects" "$(grep '^o ' several.obj | tr '\n' ' ')" "o torus32 o sail o cube o torus32 "
expect "faces of several" "$(obj_counts several.obj | cut -d' ' -f2)" $(((32 + 88 + 16 + 32) * 16))

# What was exported can be baked again: it is a manifold.
works bake -q welded.obj -o again.limn
works export sail.limn --level 2 --weld -o sail.obj
works bake -q sail.obj -o again.limn
works export torus.limn --level 0 -o kept/out.ply

refuses 1 "clip 'walk': the file has no clips" export torus.limn --level 1 -o new.obj --clip walk
refuses 2 'time: there is no --clip' export torus.limn --level 1 -o new.obj --time 1
refuses 2 "time '-1': not a time" export torus.limn --level 1 -o new.obj --time -1
refuses 2 'no level and no eye' export torus.limn -o new.obj
refuses 2 'no output' export torus.limn --level 2
refuses 2 'one .limn file' export --level 2 -o new.obj
refuses 2 'one .limn file' export torus.limn sail.limn --level 2 -o new.obj
for level in 5 -1 1x x '' 4.1 nan inf ' 1' 1,5 4294967296 18446744073709551617; do
    refuses 2 "--level '$level': not a level" export torus.limn "--level=$level" -o new.obj
done
for name in new new.stl .obj new.obj.gz new.OBJ ''; do
    refuses 2 'must end in .obj or .ply' export torus.limn --level 1 -o "$name"
done
refuses 2 'see limn export --help' export torus.limn --level 1 -o new.obj --frob
refuses 1 'no_folder/new.obj: cannot ' export torus.limn --level 1 -o no_folder/new.obj
mkdir folder.obj
refuses 1 'folder.obj: cannot write: Is a directory' export torus.limn --level 1 -o folder.obj
if [ -c /dev/full ]; then
    ln -s /dev/full full.ply
    refuses 1 'full.ply: cannot write: No space' export torus.limn --level 4 -o full.ply
fi
echo old >kept/old.obj
refuses 1 'short.limn: ' export short.limn --level 1 -o kept/old.obj
expect "the older file" "$(cat kept/old.obj)" old

finish
