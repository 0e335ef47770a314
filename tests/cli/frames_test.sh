#!/bin/sh
# SPDX-License-Identifier: MIT
# limn export: frames with levels of detail.
#
# usage: see cli.sh
. "$(dirname "$0")/cli.sh"
works bake -q "$torus" -o torus.limn

# ---- export of frames

# closed EULER OPTION...: a frame of frame.limn is a closed surface with that Euler characteristic,
# V - F / 2, and uses all its vertices.
closed() {
    euler=$1
    shift
    works export frame.limn --weld -o frame.obj "$@"
    read -r vertices faces open <<END
$(obj_counts frame.obj)
END
    expect "open edges of a frame $*" "$open" 0
    expect "Euler characteristic of a frame $*" $((vertices - faces / 2)) "$euler"
    used=$(awk '$1 == "f" { used[$2] = used[$3] = used[$4] = 1 } END { for (v in used) n++; print n }' frame.obj)
    expect "used vertices of a frame $*" "$used" "$vertices"
}

# faces_of OPTION...: how many triangles a frame of frame.limn has.
faces_of() {
    works export frame.limn -o frame.obj "$@"
    grep -c '^f ' frame.obj
}

works bake -q "$assets/imp.obj" -o frame.limn
near="--eye 0.5,1.8,2 --target 0,1.6,0"
closed 2 $near --tolerance 60
closed 2 $near --lod error --tolerance 4
closed 2 $near --tolerance 8 --no-morph --up 1,1,0 --fov 120 --viewport 320x240
closed 2 $near --budget 6000 --bias 0.4 --min-level 0.5 --max-level 2.5
works export frame.limn --level 2 --no-morph --weld -o whole.obj
works export frame.limn --level 1.25 --no-morph --weld -o frame.obj
cmp whole.obj frame.obj || fail "--no-morph does not round up"
works export frame.limn --level 1.25 --weld -o frame.obj
cmp -s whole.obj frame.obj && fail "a level between whole numbers does not morph"
works export frame.limn --level 2 --weld -o frame.obj
cmp whole.obj frame.obj || fail "a whole level morphs"
works export frame.limn $near --lod uniform --level=2 --weld -o frame.obj
cmp whole.obj frame.obj || fail "an eye changes a uniform frame"
works export frame.limn $near --max-level 0 --weld -o frame.obj
expect "--max-level 0" "$(obj_counts frame.obj)" "342 680 0"

near="$near --tolerance 50"
all=$(faces_of $near)
[ "$(faces_of $near --cull)" -lt "$all" ] || fail "--cull leaves nothing out"
[ "$(faces_of $near --tolerance 40)" -gt "$all" ] || fail "--tolerance does nothing"
[ "$(faces_of $near --viewport 320x180)" -lt "$all" ] || fail "--viewport does nothing"
[ "$(faces_of $near --fov 120)" -lt "$all" ] || fail "--fov does nothing"
[ "$(faces_of $near --bias -1)" -lt "$all" ] || fail "--bias does nothing"
expect "straight down" "$(faces_of --eye 0,9,0 --target 0,0,0 --level 0 --cull)" 680
notes 'imp: nothing of it is in view' export frame.limn --eye 0,0,5 --target 0,0,9 --cull -o frame.obj
expect "an empty frame" "$(obj_counts frame.obj)" "0 0 0"
notes '2040 vertices, more than --budget 2' export frame.limn $near --budget 2 -o frame.ply

if [ -n "${LIMN_TEST_ASSETS:-}" ] && [ -f "$LIMN_TEST_ASSETS/meshes/bigguyT.obj" ]; then
    works bake -q "$LIMN_TEST_ASSETS/meshes/bigguyT.obj" -o frame.limn
    works export frame.limn --level 0 --weld -o frame.obj
    euler=$(obj_counts frame.obj | awk '{ print $1 - $2 / 2 }')
    closed "$euler" --eye 5,10,20 --tolerance 40
fi

# wrong PATTERN OPTION...: status 2; unseen PATTERN OPTION...: status 1, as it depends on the mesh.
wrong() {
    pattern=$1
    shift
    refuses 2 "$pattern" export torus.limn -o new.obj "$@"
}
unseen() {
    pattern=$1
    shift
    refuses 1 "$pattern" export torus.limn -o new.obj "$@"
}
for point in '' 1,2 1,2,3,4 1,2,x nan,0,0 0,0,1e99 '1, 2,3'; do
    wrong "--eye '$point': not a point" "--eye=$point"
done
for number in '' nan inf -1 0 180 45deg; do
    wrong "--fov '$number': not an angle" --eye 1,2,3 "--fov=$number"
done
for pixels in 10 10x0 -1x10 70000x10 1x1x1; do
    wrong "--viewport '$pixels': not WIDTHxHEIGHT" --eye 1,2,3 "--viewport=$pixels"
done
wrong "--target '1,2': not a point" --eye 1,2,3 --target 1,2
wrong "--up 'y': not a direction" --eye 1,2,3 --up y
wrong "--near '0': not a distance" --eye 1,2,3 --near 0
wrong "--far '-1': not a distance" --eye 1,2,3 --far=-1
wrong "--tolerance '0': not " --eye 1,2,3 --tolerance 0
wrong "--budget '0': not a number of vertices" --level 1 --budget 0
wrong "--budget '4294967296': not a number of vertices" --level 1 --budget 4294967296
wrong "--bias 'nan': not a number" --level 1 --bias nan
wrong "--min-level '-1': not a level" --level 1 --min-level=-1
wrong "--max-level '5': not a level" --level 1 --max-level 5
wrong "--lod 'far': not length, error or uniform" --eye 1,2,3 --lod far
wrong '--lod length: contradicts --level' --eye 1,2,3 --lod length --level 1
wrong '--lod error: contradicts --level' --eye 1,2,3 --lod error --level 1
wrong '--lod uniform: there is no --level' --eye 1,2,3 --lod uniform
wrong '--tolerance: contradicts --level' --eye 1,2,3 --tolerance 2 --level 1
wrong '--min-level 3: is above --max-level 2' --eye 1,2,3 --min-level 3 --max-level 2
for option in target=1,2,3 up=0,1,0 fov=45 viewport=9x9 near=1 far=1 cull; do
    wrong "--${option%%=*}: there is no --eye" --level 1 "--$option"
done
unseen '--eye 1,2,3: is the target too' --eye 1,2,3 --target 1,2,3
unseen '--up 0,2,0: is not across the line of sight' --eye 0,9,0 --target 0,0,0 --up 0,2,0
unseen '--up 0,0,0: is not across the line of sight' --eye 0,9,0 --up 0,0,0
unseen '--near 1e+09: is not nearer than the far plane' --eye 1,2,3 --near 1e9
unseen '--near 3: is not nearer than the far plane, 2' --eye 1,2,3 --near 3 --far 2
unseen '--eye 1e+38,0,0: floats cannot tell' --eye 1e38,0,0

finish
