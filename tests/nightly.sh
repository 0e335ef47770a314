#!/bin/sh
# SPDX-License-Identifier: MIT
# What is too long for every run of the tests: about an hour on two cores. Say which parts are wanted, or none for all:
#
#   sh tests/nightly.sh [hostile | faults | determinism]...
#
# hostile       40 min   every length, byte and word of the corpora damaged, under sanitizers
# faults        15 min   every allocation of the baker's test fails, under sanitizers; 300 killed processes
# determinism    6 min   the table of hashes from gcc -O2 and clang -O0 and -O3; every mesh baked by gcc and by clang
#
# LIMN_TEST_ASSETS may name a folder of further meshes. Works in build/asan, build/release and build/nightly.
set -eu
cd "$(dirname "$0")/.."
folder=$PWD
work=$folder/build/nightly
corpus=$folder/tests/fuzz/corpus
mkdir -p "$work"

say() {
    printf '\n== %s\n' "$*"
}

# built PRESET TARGET...
built() {
    preset=$1
    shift
    cmake --preset "$preset" >"$work/log.txt" && cmake --build --preset "$preset" --target "$@" >"$work/log.txt" || {
        cat "$work/log.txt" >&2
        exit 1
    }
}

hostile() {
    built asan hostile_limn hostile_obj hostile_off hostile_ply hostile_lomont hostile_gltf
    for name in obj off ply lomont gltf; do
        say "Damaged files: $name"
        build/asan/tests/fuzz/hostile_$name "$corpus/$name" 1 all
    done
    say "Damaged files: limn"
    build/asan/tests/fuzz/hostile_limn "$corpus/limn" 1
}

faults() {
    built asan test_allocations
    built release limn
    say "Allocations"
    build/asan/tests/test_allocations "$corpus" "$work/allocations" 1
    say "Files"
    sh tests/faults/files_test.sh build/release/baker/limn assets "$work/files" 150
}

determinism() {
    built release limn hashes
    say "Hashes"
    script=tests/determinism/determinism_test.sh
    sh $script tested "$folder" "$work" build/release/baker/limn build/release/tests/hashes
    sh $script gcc -O2 "$folder" "$work"
    sh $script clang -O0 "$folder" "$work"
    sh $script clang -O3 "$folder" "$work" bake
    say "Every mesh, by gcc and by clang"
    sh tests/determinism/all_meshes.sh build/release/baker/limn "$work/clang-O3/baker/limn" "$folder" "$work/meshes"
}

[ $# -gt 0 ] || set -- hostile faults determinism
for part in "$@"; do
    case $part in
    hostile | faults | determinism) ;;
    *)
        echo "nightly.sh: no part '$part'" >&2
        exit 2
        ;;
    esac
done
for part in "$@"; do $part; done
say "Done"
