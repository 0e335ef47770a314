#!/bin/sh
# limn-bench: that benchmarks run, and what they write; not how fast anything is.
# usage: bench_test.sh LIMN_BENCH LIMN ASSETS WORK_DIR
set -u
bench=$1 limn=$2 assets=$3 work=$4
failed=0

# expect NAME COMMAND...
expect() {
    name=$1
    shift
    if "$@"; then return; fi
    echo "failed: $name"
    failed=1
}

rm -rf "$work" && mkdir -p "$work" && cd "$work" || exit 1

# Three meshes, both ways, of 2 families, 2 outputs, 2 kinds of tables and 5 levels
expect isolation "$bench" isolation --quick --rounds 1 --csv isolation.csv "$assets/imp.obj" >isolation.txt
expect "figures" [ "$(grep -c '^[a-z.]*,[0-9]*,[a-z]*,' isolation.csv)" = 240 ]
expect "one value per column" [ "$(grep -v '^#' isolation.csv | awk -F, '{ print NF }' | sort -u)" = 16 ]
expect "every figure is a time" [ "$(awk -F, '/^[a-z.]*,[0-9]/ && $15 <= 0' isolation.csv)" = "" ]
expect "tables, as limn info counts them" sh -c "
    '$limn' bake -q --isolate 1 '$assets/imp.obj' -o imp.limn &&
    size=\$('$limn' info --json imp.limn | sed -n 's/.*\"table_size\": \([0-9]*\),.*/\1/p' | head -n 1) &&
    grep -q \"^imp.obj,[0-9]*,isolated,[0-9]*,[0-9]*,\$size,\" isolation.csv"

rm isolation.csv
expect "a baked mesh is refused" sh -c "! '$bench' isolation --quick --csv isolation.csv imp.limn 2>error.txt"
expect "and named" grep -q imp.limn error.txt
expect "no results are left" [ ! -e isolation.csv ]
expect "a wrong option" sh -c "'$bench' isolation --rounds 0 2>error.txt; [ \$? = 2 ]"
expect "is named" grep -q -- --rounds error.txt

# 13 ways to light vertices, at 3 levels
expect light "$bench" light --quick --rounds 1 --csv light.csv "$assets/imp.obj" >light.txt
expect "steps of light" [ "$(grep -c '^imp.obj,' light.csv)" = 39 ]
expect "every step of light is a time" [ "$(awk -F, '/^imp/ && $(NF - 1) <= 0' light.csv)" = "" ]

# 13 steps of a frame
expect skin "$bench" skin --quick --rounds 1 --csv skin.csv "$assets/imp.obj" >skin.txt
expect "steps" [ "$(grep -c '^imp.obj,' skin.csv)" = 13 ]
expect "every step is a time" [ "$(awk -F, '/^imp/ && $(NF - 1) <= 0' skin.csv)" = "" ]

# A scene by all means, and what compares two results; then scenes with mistakes
printf 'mesh %s\ncount 3\narea 2 2\nlod error 2\nlight exact\nsun 0 -1 0 1 1 1\ncamera 0 0 1 9 0 0 0\n' "$assets/imp.obj" >few.scene
printf 'camera 1 0 1 5 0 0 0 # nearer\n' >>few.scene
expect frame "$bench" frame --scene few.scene --frames 16 --rounds 1 --lod error:4 --threads 2 --peers floats,dense,discrete \
    --json few.json --csv few.csv --html few.html >few.txt
expect "a line for each frame" [ "$(grep -c '^few,3,' few.csv)" = 64 ]
expect "one value per column" [ "$(grep -v '^#' few.csv | awk -F, '{ print NF }' | sort -u)" = 24 ]
expect "stages with times" [ "$(awk -F, '/"limn"/ && ($6 <= 0 || $8 <= 0 || $9 <= 0 || $10 <= 0 || $14 <= 0)' few.csv)" = "" ]
expect "16 bytes a vertex, lit and packed, and 24 as floats" [ "$(awk -F, '/"limn"|"floats"/ && $18 != $16 * ($3 ~ /limn/ ? 16 : 24)' few.csv)" = "" ]
expect "patches are drawn or culled" [ "$(awk -F, '/"limn"/ && $19 + $20 + $21 + $22 + $23 + $24 != 3 * 680' few.csv)" = "" ]
expect "three pictures" [ "$(grep -c '<svg' few.html)" = 3 ]
expect "a page of its own" sh -c "! grep -q 'http\|<script\|src=' few.html"
expect "the same is no slower" "$bench" compare few.json few.json >compare.txt
expect "of all ways" [ "$(grep -c 'no difference' compare.txt)" = 4 ]
awk '/"frames": \[/ { on = 1; print; next } /\]/ { on = 0 } on { sub(",", ""); print 2 * $1 (++n % 16 ? "," : ""); next } { print }' few.json >slow.json
expect "twice the time" sh -c "'$bench' compare few.json slow.json >compare.txt; [ \$? = 1 ]"
expect "is slower" [ "$(grep -c ' 2.000 .*slower$' compare.txt)" = 4 ]
expect "and half of it faster" "$bench" compare slow.json few.json >compare.txt
expect "which is said" grep -q ' 0.500 .*faster$' compare.txt
expect "no results" sh -c "echo '{}' >none.json; '$bench' compare few.json none.json 2>error.txt; [ \$? = 2 ]"
expect "are named" grep -q none.json error.txt
expect "a crowd for each way" sh -c "'$bench' frame --scene few.scene --quick --find-crowd --budget 0.5 | grep -q '^  limn  *[0-9]'"
# Frames that are drawn, where limn-view is built, too
sed '$a viewport 64 36' few.scene >small.scene
if "$bench" frame --scene small.scene --png 0.png 2>error.txt || ! grep -q 'built without' error.txt; then
    expect "another frame" "$bench" frame --scene small.scene --png 119.png --frame 119
    expect "is another picture" sh -c "! cmp -s 0.png 119.png"
    expect "a picture of a size" "$bench" frame --scene small.scene --png large.png --size 160x90
    expect "as large" [ "$(od -An -tu1 -j16 -N8 large.png | tr -s ' ')" = " 0 0 0 160 0 0 0 90" ]
    expect "no such frame" sh -c "'$bench' frame --scene small.scene --png no.png --frame 120 2>error.txt; [ \$? = 2 ]"
    expect "draw" "$bench" frame --scene small.scene --quick --draw --csv draw.csv >draw.txt
    expect "drawing takes time" [ "$(awk -F, '/"drawn"/ && ($13 <= 0 || $14 < $13)' draw.csv)" = "" ]
    expect "of that way alone" [ "$(awk -F, '/^small/ && ($13 > 0) != /"drawn"/' draw.csv)" = "" ]
fi
printf 'mesh a.obj\n\nlod error -1\n' >bad.scene
expect "a wrong line" sh -c "! '$bench' frame --scene bad.scene --csv bad.csv 2>error.txt"
expect "is named" grep -q 'bad.scene:3: .*lod error PX' error.txt
expect "no frames are left" [ ! -e bad.csv ]
expect "an unknown way" sh -c "'$bench' frame --peers dense,none 2>error.txt; [ \$? = 2 ]"
for scene in hero crowd worst; do
    expect "scene $scene" sh -c "'$bench' frame --scene $scene --quick --count 2 | grep -q '^  frame'"
done

# An open cube, closed with triangles so that faces are divided, and two quads, whose corners Embree rounds otherwise
printf 'v 0 0 0\nv 1 0 0\nv 1 1.3 0\nv 0 1 0\nv 0 0 1\nv 1 0 1.2\nv 1 1 1\nv 0 1 1\n' >quads.obj
cp quads.obj corners.obj
printf 'f 1 2 6 5\nf 2 3 7 6\n' >>corners.obj
printf 'f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n' >>quads.obj
expect "quads isolated" "$bench" isolation --scheme catmark --quick --rounds 1 --csv isolation.csv quads.obj >isolation.txt
expect "their figures" [ "$(grep -c '^[a-z.]*,[0-9]*,[a-z]*,' isolation.csv)" = 240 ]
expect "a regular torus of quads: one table of a piece" grep -q '^regular,64,isolated,1,1,' isolation.csv
expect "quads baked" "$limn" bake -q --scheme catmark quads.obj -o quads.limn
expect "quads from frame to frame" "$bench" dolly --frames 3 quads.limn >dolly.txt
expect "a line for each step" [ "$(grep -c '^[0-9]' dolly.txt)" = 2 ]

cp quads.obj mixed.obj
printf 'f 5 6 7\nf 5 7 8\n' >>mixed.obj
for isolate in 0 1; do
    expect "peers, isolate $isolate" "$bench" peers --scheme catmark --isolate $isolate --level 1 --rounds 1 \
        --threads 1 --csv peers.csv quads.obj mixed.obj corners.obj >peers.txt 2>notes.txt
    for mesh in quads mixed corners; do
        expect "$mesh by both" sh -c "grep -q '^limn,.*,$mesh,1,' peers.csv && grep -q '^recursive catmark,.*,$mesh,1,' peers.csv"
    done
    expect "the scheme and the tables" [ "$(grep ',[01]$' peers.csv | grep -vc ",catmark,$isolate\$")" = 0 ]
    expect "no Embree at corners" sh -c "! grep -q '^embree,.*,corners,' peers.csv"
done
expect "Loop's peers" "$bench" peers --level 1 --rounds 1 --threads 1 --csv peers.csv "$assets/torus32.obj" >peers.txt
expect "are of that scheme" grep -q '^recursive loop,.*,loop,0$' peers.csv
expect "an unknown scheme" sh -c "'$bench' peers --scheme butterfly quads.obj 2>error.txt; [ \$? = 2 ]"
expect "is named" grep -q -- --scheme error.txt
exit $failed
