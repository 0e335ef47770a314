#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds the runtime and test_threads with ThreadSanitizer and runs it; then once more with ranges that overlap, which it
# must see.
#
#   sh threads_test.sh SOURCE_FOLDER WORK_FOLDER FILE.limn...
#
# Exit status 77, which skips the test, where the compiler has no ThreadSanitizer or its programs cannot run.
set -eu

source_folder=$1
work_folder=$2
shift 2
mkdir -p "$work_folder"
cd "$work_folder"

fail() {
    cat log.txt >&2
    echo "threads_test.sh: $*" >&2
    exit 1
}

echo 'int main(void) { return 0; }' >probe.c
cc -fsanitize=thread probe.c -o probe 2>log.txt && ./probe 2>>log.txt || {
    cat log.txt >&2
    exit 77
}

cmake -S "$source_folder" -B build -G Ninja --log-level=WARNING -DCMAKE_C_COMPILER=cc -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_C_FLAGS='-O2 -g -fsanitize=thread' -DLIMN_BUILD_BAKER=OFF -DLIMN_BUILD_BENCH=OFF -DLIMN_BUILD_EXAMPLES=OFF \
    -DLIMN_BUILD_VIEWER=OFF -DLIMN_INSTALL=OFF >log.txt
cmake --build build --target test_threads >log.txt 2>&1 || fail "cannot be built"
TSAN_OPTIONS=halt_on_error=1
export TSAN_OPTIONS
for file in "$@"; do
    build/tests/test_threads "$file" >log.txt 2>&1 || fail "$file: a race, or other bytes"
    cat log.txt
done
build/tests/test_threads "$1" overlap >log.txt 2>&1 && fail "ranges that overlap were not noticed"
grep -q 'ThreadSanitizer: data race' log.txt || fail "no race was reported"
echo "ranges that overlap are a race, as they should be"
