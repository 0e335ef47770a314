#!/bin/sh
# SPDX-License-Identifier: MIT
# Same input, same bits: the hashes of baked files, and of what is evaluated from them, are those of table.txt.
#
#   sh determinism_test.sh tested SOURCE_FOLDER WORK_FOLDER LIMN HASHES    with these programs; leaves WORK_FOLDER/tested
#   sh determinism_test.sh COMPILER FLAGS SOURCE_FOLDER WORK_FOLDER        builds `hashes`, for the files of `tested`
#   sh determinism_test.sh COMPILER FLAGS SOURCE_FOLDER WORK_FOLDER bake   builds the baker, too, and bakes with it
#   sh determinism_test.sh refused SOURCE_FOLDER                           flags that would change bits do not compile
#
# COMPILER is gcc, clang, arm64 or i686; the last two cross-build with gcc and run in qemu. Where results are meant to
# change, WORK_FOLDER/tested/hashes.txt becomes the table. Exit status 77, which skips the test: the compiler is missing.
set -eu

fail() {
    echo "$*" >&2
    exit 1
}

require() {
    command -v "$1" >/dev/null && return
    echo "$1 is missing" >&2
    exit 77
}

# compare FILES FOLDER PROGRAM...: the hashes of all files in the folder FILES, or of the small ones where the program is
# emulated. They are left in FOLDER.
compare() {
    files=$1
    result=$2/hashes.txt
    expected=$2/expected.txt
    shift 2
    case $1 in
    qemu*) names='torus torus-pieces sail sail-butterfly cube cube-quads cube-butterfly box character' ;;
    *) names=$(cut -d ' ' -f 1 "$source_folder/tests/determinism/table.txt" | uniq) ;;
    esac
    : >"$expected"
    for name in $names; do
        grep "^$name " "$source_folder/tests/determinism/table.txt" >>"$expected"
        set -- "$@" "$files/$name.limn"
    done
    "$@" >"$result" || fail "$1: not one result"
    diff "$expected" "$result" || fail "$result: not those of table.txt"
    echo "$(grep -c '' "$result") hashes: those of table.txt"
}

# build FOLDER TARGET...
build() {
    folder=$1
    shift
    mkdir -p "$folder"
    {
        case $compiler in
        arm64 | i686) set -- "$@" -- -DCMAKE_TOOLCHAIN_FILE="$source_folder/cmake/$compiler.cmake" ;;
        gcc) set -- "$@" -- -DCMAKE_C_COMPILER=gcc -DCMAKE_CXX_COMPILER=g++ ;;
        clang) set -- "$@" -- -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ ;;
        esac
        targets=
        while [ "$1" != -- ]; do
            targets="$targets $1"
            shift
        done
        shift
        cmake -S "$source_folder" -B "$folder" -G Ninja "$@" -DCMAKE_BUILD_TYPE=None \
            -DCMAKE_C_FLAGS_NONE="$flags" -DCMAKE_CXX_FLAGS_NONE="$flags" -DLIMN_BUILD_BAKER="$baker" \
            -DCMAKE_DISABLE_FIND_PACKAGE_OpenSubdivCPU=ON -DLIMN_BUILD_BENCH=OFF -DLIMN_BUILD_EXAMPLES=OFF \
            -DLIMN_BUILD_VIEWER=OFF -DLIMN_INSTALL=OFF &&
            # shellcheck disable=SC2086 # one word per target
            cmake --build "$folder" -j 1 --target $targets
    } >"$folder/log.txt" 2>&1 || {
        cat "$folder/log.txt" >&2
        exit 1
    }
}

# refuse COMPILER PATTERN FLAG...: a kernel does not compile, and says why.
refuse() {
    compiler=$1
    pattern=$2
    shift 2
    command -v "$compiler" >/dev/null || return 0
    if text=$("$compiler" "$@" -fsyntax-only -std=c11 -I"$source_folder/include" -I"$source_folder/runtime" \
        "$source_folder/simd/kernels_scalar.c" 2>&1); then fail "$compiler $*: compiles"; fi
    case $text in *"$pattern"*) ;; *) fail "$compiler $*: $text" ;; esac
}

case $1 in
tested)
    [ $# -eq 5 ] || fail "usage: see $0"
    source_folder=$2
    sh "$source_folder/tests/determinism/bake.sh" "$4" "$source_folder" "$3/tested"
    compare "$3/tested" "$3/tested" "$5" 4
    ;;
refused)
    source_folder=$2
    for compiler in gcc clang; do
        require $compiler
        refuse $compiler "fast-math reorders" -Ofast
        refuse $compiler "fast-math reorders" -O2 -ffast-math
    done
    refuse i686-linux-gnu-gcc "floats must be rounded" -O2 -mfpmath=387
    ;;
gcc | clang | arm64 | i686)
    compiler=$1
    flags=$2
    source_folder=$3
    work_folder=$4
    baker=OFF
    run=
    threads=4
    files=$work_folder/tested
    case $compiler in
    arm64) set -- aarch64-linux-gnu-gcc qemu-aarch64 ;;
    i686) set -- i686-linux-gnu-gcc qemu-i386 ;;
    *) set -- "$compiler" ${5:+"$5"} ;;
    esac
    require "$1"
    folder=$work_folder/$compiler$(printf %s "$flags" | tr -d ' =')
    case ${2:-} in
    qemu-aarch64) run="$2 -L /usr/aarch64-linux-gnu" ;;
    qemu-i386) run="$2 -L /usr/i686-linux-gnu" ;;
    bake) baker=ON ;;
    esac
    if [ -n "$run" ]; then
        require "$2"
        threads=1 # qemu-i386 may hang as it starts one
    fi
    if [ $baker = ON ]; then
        build "$folder" hashes limn
        files=$folder/baked
        sh "$source_folder/tests/determinism/bake.sh" "$folder/baker/limn" "$source_folder" "$files"
    else
        build "$folder" hashes
    fi
    # shellcheck disable=SC2086 # qemu and its options
    compare "$files" "$folder" $run "$folder/tests/hashes" $threads
    ;;
*) fail "usage: see $0" ;;
esac
