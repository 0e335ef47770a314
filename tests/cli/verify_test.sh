#!/bin/sh
# SPDX-License-Identifier: MIT
# limn verify.
#
# usage: see cli.sh
. "$(dirname "$0")/cli.sh"
write_broken_meshes
bake_samples

skip_without_opensubdiv

# Far from the origin, where floats are 1/16 apart and the mesh is 3 wide.
awk '/^v / { $2 += 1e6 } { print }' "$torus" >away.obj
works bake -q away.obj -o away.limn
notes 'away: so far from the origin, floats cannot hold the mesh to better than 0.0[0-9]* of its diagonal' \
    verify away.limn --against away.obj
says stdout '; tolerance 0.0[0-9]*$'
works bake -q "$sail" -o flat.limn --scheme none
refuses 1 'baked with --scheme none' verify flat.limn --against "$sail"
verified torus.limn --against "$torus"
verified --against "$sail" sail.limn
works bake -q "$sail" -o corner.limn --boundary edge-and-corner
verified --against "$sail" corner.limn
works bake -q "$cube" -o cube.limn
verified cube.limn --against "$cube"
verified several.limn --against "$cube" --mesh 2
verified several.limn --against "$torus" --mesh=3 --tolerance 1e-3
works bake -q loose.obj -o loose.limn --repair=weld
verified loose.limn --against loose.obj --repair=weld
refuses 1 'loose.obj: non-manifold vertex' verify loose.limn --against loose.obj
for name in edge vertex winding; do
    works bake -q $name.obj -o $name.limn --non-manifold split
    verified $name.limn --against $name.obj --non-manifold split
done
refuses 1 'edge.obj: non-manifold edge' verify edge.limn --against edge.obj
refuses 2 'cannot .weld. what is not' verify edge.limn --against edge.obj --non-manifold weld
refuses 1 'baked from something else' verify torus.limn --against "$sail"
refuses 1 'baked from something else' verify several.limn --against "$cube" --mesh 1
awk '/^v / && !done { $2 += 0.001; done = 1 } { print }' "$torus" >moved.obj
refuses 1 'baked from something else' verify torus.limn --against moved.obj
sed 's/^f \([0-9]*\) \([0-9]*\) \([0-9]*\)$/f \1 \3 \2/' "$torus" >turned.obj
last="verify turned"
run 1 verify torus.limn --against turned.obj
says stderr ' '
last="verify --tolerance 0"
run 1 verify torus.limn --against "$torus" --tolerance 0
says stdout 'largest '
says stderr 'largest difference is above 0'
works bake -q "$sail" -o warren.limn --weights warren
refuses 1 'warren weights' verify warren.limn --against "$sail"
run 0 bake -q "$sail" -o lomont.limn --creases lomont
refuses 1 "Lomont's rules" verify lomont.limn --against "$sail"
run 0 bake -q "$torus" -o lomont.limn --creases lomont
run 0 verify lomont.limn --against "$torus"
refuses 1 'there is no mesh 4; the file has 4' verify several.limn --against "$torus" --mesh 4
refuses 1 'missing.obj: cannot be read' verify torus.limn --against missing.obj
refuses 1 'edge.obj: non-manifold edge' verify torus.limn --against edge.obj
refuses 1 'short.limn: the blob is shorter' verify short.limn --against "$torus"
refuses 2 'no mesh' verify torus.limn
refuses 2 'one .limn file' verify --against "$torus"
refuses 2 'see limn verify --help' verify torus.limn --against "$torus" --frob
for number in -1 x '' 4294967296; do
    refuses 2 'not the number of a mesh' verify torus.limn --against "$torus" "--mesh=$number"
done
for number in -1 x '' nan inf 1e-7x; do
    refuses 2 'not a tolerance' verify torus.limn --against "$torus" "--tolerance=$number"
done
refuses 2 'cannot repair' verify torus.limn --against "$torus" --repair=frob

finish
