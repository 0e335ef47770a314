#!/bin/sh
# SPDX-License-Identifier: MIT
# How much of the runtime and the baker the tests run: lines and branches of each file, and a list of those that none does.
# Branches of LIMNI_REQUIRE, a caller's mistake, do not count. Not a part of the CI: takes about ten minutes on two idle
# cores, without `slow` tests (-LE slow) six. Needs gcovr.
#
# usage: coverage.sh WORK_FOLDER [CTEST_OPTION...]
set -eu
[ $# -ge 1 ] || {
    echo "usage: $0 WORK_FOLDER [CTEST_OPTION...]" >&2
    exit 2
}
mkdir -p "$1"
work=$(cd "$1" && pwd)
source=$(cd "$(dirname "$0")/.." && pwd)
shift
# Without assertions, whose failing branches no test takes.
cmake -S "$source" -B "$work/build" -G Ninja --log-level=WARNING -DCMAKE_BUILD_TYPE=None "-DCMAKE_C_FLAGS=-O1 -DNDEBUG --coverage" \
    "-DCMAKE_CXX_FLAGS=-O1 -DNDEBUG" -DLIMN_BUILD_VIEWER=OFF -DLIMN_BUILD_BENCH=OFF -DLIMN_BUILD_EXAMPLES=OFF -DLIMN_INSTALL=OFF \
    "-DLIMN_TEST_ASSETS=${LIMN_TEST_ASSETS:-}" >"$work/log.txt"
cmake --build "$work/build" >>"$work/log.txt" 2>&1 || { tail -n 30 "$work/log.txt" && exit 1; }
find "$work/build" -name '*.gcda' -delete
# What builds again, or looks at builds, says nothing here.
ctest --test-dir "$work/build" -j2 --output-on-failure -E '^(determinism.*|threads_sanitized|runtime_symbols|.*_exports)$' "$@"
cd "$source"
gcovr --root . --filter runtime/ --filter simd/ --filter baker/ --exclude runtime/generate_domain --exclude-throw-branches \
    --exclude-lines-by-pattern '.*LIMNI_REQUIRE.*' "$work/build" --txt "$work/lines.txt" --json "$work/coverage.json" \
    >>"$work/log.txt" 2>&1
gcovr --root . --add-tracefile "$work/coverage.json" --branches --txt "$work/branches.txt" >>"$work/log.txt" 2>&1
for what in lines branches; do
    for folder in runtime simd baker; do
        awk -v what=$what -v folder=$folder 'index($1, folder "/") == 1 && $4 ~ /%/ { all += $2; run += $3 }
            END { printf "%-8s %-8s %5d of %5d, %.1f %%\n", folder, what, run, all, 100 * run / all }' "$work/$what.txt"
    done
done
echo "$work/lines.txt, $work/branches.txt: file by file, with what is not run"
