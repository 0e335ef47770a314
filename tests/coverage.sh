#!/bin/sh
# SPDX-License-Identifier: MIT
# How much of the runtime and the baker the tests run: lines and branches of each file, and a list of the lines that none
# does. Not a part of the CI: takes about ten minutes on two idle cores. Needs gcovr.
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
# What builds again, or measures builds, says nothing here.
ctest --test-dir "$work/build" -j2 --output-on-failure -E '^(golden|determinism|threads_sanitized|runtime_symbols)$' "$@"
cd "$source"
gcovr --root . --filter runtime/ --filter simd/ --filter baker/ --exclude 'runtime/generate_domain' --exclude-throw-branches \
    "$work/build" --txt "$work/coverage.txt" --json "$work/coverage.json" >>"$work/log.txt" 2>&1
gcovr --root . --add-tracefile "$work/coverage.json" --branches --txt "$work/branches.txt" >>"$work/log.txt" 2>&1
sed -n 's/^TOTAL/lines   /p' "$work/coverage.txt"
sed -n 's/^TOTAL/branches/p' "$work/branches.txt"
echo "$work/coverage.txt, $work/branches.txt: file by file, with the lines that are not run"
