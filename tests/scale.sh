#!/bin/sh
# SPDX-License-Identifier: MIT
# Two million faces: a torus bakes in bounded memory, each time within a limit of the address space, and plays. Not a part
# of the CI: takes about two minutes on an idle core, and 700 MB of disk.
#
# usage: scale.sh LIMN WORK_FOLDER
set -eu
[ $# -eq 2 ] || {
    echo "usage: $0 LIMN WORK_FOLDER" >&2
    exit 2
}
limn=$(realpath "$1")
mkdir -p "$2"
cd "$2"

# A torus of 2 n m triangles; every seventeenth cell in each direction has its diagonal the other way, so that there are
# vertices of valence 5 and 7.
torus() {
    awk -v n="$1" -v m="$2" 'BEGIN {
        turn = 8 * atan2(1, 1)
        for (i = 0; i < n; i++) for (j = 0; j < m; j++) {
            r = 3 + cos(turn * j / m)
            printf "v %.7f %.7f %.7f\n", r * cos(turn * i / n), r * sin(turn * i / n), sin(turn * j / m)
        }
        for (i = 0; i < n; i++) for (j = 0; j < m; j++) {
            a = i * m + j + 1; b = (i + 1) % n * m + j + 1
            c = (i + 1) % n * m + (j + 1) % m + 1; d = i * m + (j + 1) % m + 1
            if (i % 17 == 8 && j % 17 == 8) printf "f %d %d %d\nf %d %d %d\n", a, b, d, b, c, d
            else printf "f %d %d %d\nf %d %d %d\n", a, b, c, a, c, d
        }
    }'
}

# within MEGABYTES COMMAND...: how long it takes with so much address space
within() {
    megabytes=$1
    shift
    begin=$(date +%s)
    (ulimit -v $((megabytes * 1024)) && "$@") >output.txt 2>&1 || {
        cat output.txt >&2
        echo "within $megabytes MB: $*: failed" >&2
        exit 1
    }
    printf '%4d s within %4d MB: %s %s\n' $(($(date +%s) - begin)) "$megabytes" "$(basename "$1") $2" "$(head -n 1 output.txt)"
}

torus 1000 1000 >torus.obj
within 700 "$limn" bake torus.obj -o dense.limn
within 1600 "$limn" bake torus.obj -o isolated.limn --isolate 1
within 900 "$limn" bake torus.obj -o normals.limn --normals exact
[ "$("$limn" info --json dense.limn | grep -c '"faces": 2000000')" = 1 ]
# What a frame needs: opening, which checks all of it; a plan of all patches, and levels 0 and 1
within 640 "$limn" export dense.limn --level 0 -o dense.ply
within 1600 "$limn" export dense.limn --eye 0,5,9 --lod error --max-level 1 -o dense.ply
within 1600 "$limn" export isolated.limn --eye 0,5,9 --lod error --max-level 1 -o dense.ply
# Where memory ends, so does the bake, with a message and without a file.
rm -f small.limn
if (ulimit -v 204800 && "$limn" bake torus.obj -o small.limn) 2>output.txt; then exit 1; fi
grep -q 'out of memory' output.txt
[ ! -e small.limn ]
rm -f torus.obj dense.limn isolated.limn normals.limn dense.ply output.txt
