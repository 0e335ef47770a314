#!/bin/sh
# SPDX-License-Identifier: MIT
# What takes too long for the CI, or needs programs of its own: sanitizers that exclude one another, valgrind, and
# analysers of the source. ASan and UBSan are in the CI, over all tests.
#
# usage: analysis.sh BUILD_FOLDER WORK_FOLDER [PART...]
#
#   cppcheck   15 seconds    cppcheck
#   tidy       5 minutes     clang-tidy, with .clang-tidy
#   msan       a minute      clang: tests of the runtime, none of which may use what nobody wrote
#   tsan       20 seconds    the tests with threads
#   valgrind   2 minutes     valgrind: small tests of the runtime and the baker, and limn itself
#
# BUILD_FOLDER is a build of preset release. All parts unless some are named; times on an idle core. Exit status: how many
# parts found something.
set -u
[ $# -ge 2 ] || {
    echo "usage: $0 BUILD_FOLDER WORK_FOLDER [cppcheck] [tidy] [msan] [tsan] [valgrind]" >&2
    exit 2
}
mkdir -p "$2"
built=$(cd "$1" && pwd)
work=$(cd "$2" && pwd)
source=$(cd "$(dirname "$0")/.." && pwd)
limn=$built/baker/limn
shift 2
[ $# -gt 0 ] || set -- cppcheck tidy msan tsan valgrind
includes="-I include -I runtime -I simd -I baker -I runtime/file -I options"
cd "$source" || exit 2

# Suppressed, each with its reason:
#   selfAssignment      takes a field of the file's header for the field of the same name in the view
#   uninitvar, templates.c        does not see that the loop before writes the same elements
#   ctuuninitvar, triangulate.c   does not see that a polygon with no new diagonal has an existing one
check_cppcheck() {
    cppcheck --quiet --std=c11 --enable=warning,portability,performance --error-exitcode=1 \
        --suppress=selfAssignment:runtime/pack.c --suppress=uninitvar:runtime/templates.c \
        --suppress=ctuuninitvar:baker/triangulate.c $includes runtime/*.c runtime/file/*.c baker/*.c options/*.c
}

# In the baker without what follows values through calls: each step sets its results or fails, which is not seen from
# another file, and lists and valences that are never empty are taken to be.
check_tidy() {
    clang-tidy --quiet runtime/*.c runtime/file/*.c simd/kernels_scalar.c options/*.c -- -std=c11 $includes \
        -D_XOPEN_SOURCE=700 2>"$work/log.txt" &&
        clang-tidy --quiet '--checks=-clang-analyzer-core.*,-clang-analyzer-unix.Malloc' baker/*.c -- -std=c11 $includes \
            -D_XOPEN_SOURCE=700 2>"$work/log.txt"
}

# run_tests RUNNER FOLDER NAME...: with what they print if one fails
run_tests() {
    runner=$1
    folder=$2
    shift 2
    for test in "$@"; do
        LIMN_ASSETS=$source/assets LIMN_TEST_ASSETS='' $runner "$folder/test_$test" >"$work/output.txt" 2>&1 || {
            cat "$work/output.txt"
            return 1
        }
    done
    $runner "$folder/test_files" tests/compatibility
}

runtime_tests="abi domain templates kernels skin quads view_planes"
check_msan() {
    cmake -S "$source" -B "$work/msan" -G Ninja --log-level=WARNING -DCMAKE_BUILD_TYPE=None -DCMAKE_C_COMPILER=clang \
        "-DCMAKE_C_FLAGS=-O1 -g -fsanitize=memory -fsanitize-memory-track-origins -fno-omit-frame-pointer" \
        -DLIMN_BUILD_BAKER=OFF -DLIMN_BUILD_VIEWER=OFF -DLIMN_BUILD_BENCH=OFF -DLIMN_BUILD_EXAMPLES=OFF -DLIMN_INSTALL=OFF \
        >"$work/log.txt" &&
        cmake --build "$work/msan" --target fuzz_limn test_files $(printf 'test_%s ' $runtime_tests) >>"$work/log.txt" 2>&1 || {
        cat "$work/log.txt"
        return 1
    }
    run_tests '' "$work/msan/tests" $runtime_tests && "$work/msan/tests/fuzz/fuzz_limn" tests/fuzz/corpus/limn
}

check_tsan() {
    for isolate in 0 1; do
        "$limn" bake -q --normals exact --isolate $isolate assets/sail.obj -o "$work/sail$isolate.limn" || return 1
    done
    sh tests/threads_test.sh "$source" "$work/tsan" "$work/sail0.limn" "$work/sail1.limn"
}

check_valgrind() {
    checked="valgrind --quiet --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite,indirect,possible"
    run_tests "$checked" "$built/tests" abi view_planes templates fixed mirror subdivide readers read_ply read_lomont &&
        $checked "$limn" bake -q assets/sail.obj tests/fuzz/corpus/gltf/character.glb -o "$work/valgrind.limn" --normals exact \
            --isolate auto 2>"$work/notes.txt" || { cat "$work/notes.txt" && return 1; }
    $checked "$limn" info "$work/valgrind.limn" >"$work/output.txt" &&
        $checked "$limn" export --eye 0,1,3 "$work/valgrind.limn" -o "$work/valgrind.obj" >"$work/output.txt"
}

failed=0
for part in "$@"; do
    case $part in cppcheck | tidy | msan | tsan | valgrind) ;; *) echo "no part $part" >&2 && exit 2 ;; esac
    if "check_$part"; then
        echo "$part: nothing found"
    else
        echo "$part: FAILED"
        failed=$((failed + 1))
    fi
done
exit $failed
