#!/bin/sh
# SPDX-License-Identifier: MIT
# Same input, same bits: builds the kernels with gcc and clang at three levels of optimisation, and compares the hashes of
# whole evaluations with the golden ones.
#
#   sh golden_test.sh SOURCE_FOLDER WORK_FOLDER
#
# Exit status 77, which skips the test, where a compiler is missing.
set -eu

source_folder=$1
work_folder=$2
mkdir -p "$work_folder"
for compiler in gcc clang; do
    command -v $compiler >/dev/null || {
        echo "$compiler is missing" >&2
        exit 77
    }
done

for compiler in gcc clang; do
    for level in 0 2 3; do
        build=$work_folder/$compiler-O$level
        cmake -S "$source_folder" -B "$build" -G Ninja --log-level=WARNING -DCMAKE_C_COMPILER=$compiler \
            -DCMAKE_BUILD_TYPE=None -DCMAKE_C_FLAGS=-O$level -DLIMN_BUILD_BAKER=OFF -DLIMN_BUILD_BENCH=OFF \
            -DLIMN_BUILD_EXAMPLES=OFF -DLIMN_BUILD_VIEWER=OFF -DLIMN_INSTALL=OFF >"$build.log"
        cmake --build "$build" --target test_kernels >>"$build.log" 2>&1 || {
            cat "$build.log" >&2
            exit 1
        }
        echo "$compiler -O$level"
        "$build/tests/test_kernels" golden
    done
done
