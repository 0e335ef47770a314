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
