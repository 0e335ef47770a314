# SPDX-License-Identifier: MIT
# What the tests of the command line share, which try every command of limn, right and wrong: exit statuses, messages, and
# what is left on the disk. A test sources this, which leads it to an empty folder, and ends with `finish`.
#
# usage: NAME_test.sh LIMN ASSETS_FOLDER WORK_FOLDER
set -u
export LC_ALL=C # the messages of the system too

if [ $# -ne 3 ]; then
    echo "usage: $0 LIMN ASSETS_FOLDER WORK_FOLDER" >&2
    exit 2
fi
case $1 in */*) limn=$(cd "$(dirname "$1")" && pwd)/$(basename "$1") ;; *) limn=$1 ;; esac
assets=$(cd "$2" && pwd) || exit 1
corpus=$(cd "$(dirname "$0")/../fuzz/corpus" && pwd) || exit 1

# Never touch what somebody else keeps in the folder: everything happens in one of our own.
mkdir -p "$3" || exit 1
folder=$(mktemp -d "$3/$(basename "$0" .sh).XXXXXX") || exit 1
cd "$folder" || exit 1
folder=$(pwd)

# Counted in a file: what reads from a pipe runs in a shell of its own.
fail() {
    echo "FAILED: $*" >&2
    echo "$*" >>"$folder/failures.txt"
}

# run STATUS ARGUMENT...: limn with that exit status; its words go to stdout.txt and stderr.txt.
# What is wrong on the command line is found before anything is allocated, so leaks are not looked for: that takes longer
# than all the rest.
run() {
    status=$1
    shift
    ASAN_OPTIONS=detect_leaks=$((status != 2)) "$limn" "$@" >"$folder/stdout.txt" 2>"$folder/stderr.txt"
    actual=$?
    [ $actual -eq "$status" ] || {
        fail "limn $*: exit status $actual instead of $status"
        sed 's/^/    /' "$folder/stderr.txt" >&2
    }
}

# says STREAM PATTERN: a line of that stream of the last run holds the pattern.
says() {
    grep -q -e "$2" "$folder/$1.txt" || {
        fail "limn $last: nothing about '$2' on $1"
        sed 's/^/    /' "$folder/$1.txt" >&2
    }
}

# works ARGUMENT...: status 0 and nothing on stderr.
works() {
    last=$*
    run 0 "$@"
    [ ! -s "$folder/stderr.txt" ] || fail "limn $*: words on stderr: $(cat "$folder/stderr.txt")"
}

# notes PATTERN ARGUMENT...: status 0 and a note.
notes() {
    pattern=$1
    shift
    last=$*
    run 0 "$@"
    says stderr "^note: .*$pattern"
}

# refuses STATUS PATTERN ARGUMENT...: that status, a message with the pattern, nothing on stdout, and
# no file that was not there before.
refuses() {
    status=$1
    pattern=$2
    shift 2
    last=$*
    ls -A "$folder" "$folder/kept" >"$folder/before.txt"
    run "$status" "$@"
    says stderr "$pattern"
    [ ! -s "$folder/stdout.txt" ] || fail "limn $*: words on stdout"
    ls -A "$folder" "$folder/kept" >"$folder/after.txt"
    cmp -s "$folder/before.txt" "$folder/after.txt" || {
        fail "limn $*: left files behind"
        diff "$folder/before.txt" "$folder/after.txt" >&2
    }
}

# json KEY: the value of the first such key of the last run.
json() {
    sed -n "s/^ *\"$1\": \"\{0,1\}\([^\",]*\)\"\{0,1\},\{0,1\}\$/\1/p" "$folder/stdout.txt" | head -n 1
}

# expect WHAT ACTUAL EXPECTED
expect() {
    [ "$2" = "$3" ] || fail "$1: '$2' instead of '$3'"
}

size_of() {
    wc -c <"$1" | tr -d ' '
}

# Numbers of an OBJ: vertices, faces, and directed edges that have no single opposite.
obj_counts() {
    awk '$1 == "v" { vertices++ }
         $1 == "f" { faces++; for (c = 2; c <= 4; c++) used[$c " " $(c == 4 ? 2 : c + 1)]++ }
         END {
             for (edge in used) {
                 split(edge, end, " ")
                 if (used[edge] != 1 || used[end[2] " " end[1]] != 1) open++
             }
             print vertices + 0, faces + 0, open + 0
         }' "$1"
}

mkdir kept
touch stdout.txt stderr.txt before.txt after.txt failures.txt
torus=$assets/torus32.obj
sail=$assets/sail.obj
cube=$assets/cube.off

# finish: the exit status of the test.
finish() {
    if [ -s "$folder/failures.txt" ]; then
        echo "$(grep -c '' "$folder/failures.txt") failures; see $folder" >&2
        exit 1
    fi
    cd / && rm -rf "$folder"
}

# What several tests try: meshes that are not manifold, and faces that are none.
four="v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
write_broken_meshes() {
    printf "${four}v 1 1 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n" >edge.obj
    printf "${four}v 1 1 1\nf 1 2 3\nf 1 4 5\n" >vertex.obj
    printf "${four}f 1 2 3\nf 1 2 4\n" >winding.obj
    printf "${four}f 1 2 3\nf 1 3 3\n" >degenerate.obj
    printf "${four}f 1 2 3\nf 3 1 2\n" >repeated.obj
    printf "${four}f 1 2 5\n" >range.obj
    printf "v 0 0 nan\nf 1 1 1\n" >nan.obj
    # One vertex twice: three faces apart from a fourth.
    printf "${four}v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 3 2\nf 5 6 4\nf 2 7 4\nf 3 1 4\n" >loose.obj
}

# Baked files that several tests look into.
bake_samples() {
    works bake -q "$torus" -o torus.limn
    works bake -q "$sail" -o sail.limn
    works bake -q "$torus" "$sail" "$cube" "$torus" -o several.limn
    head -c 1000 sail.limn >short.limn
}

# A cube without its bottom: creases inside and on the boundary, sharp for ever, smooth again, and of
# many digits; corners; a hole; and both rules.
write_house() {
    cat >house.obj <<'END'
v 0 0 0
v 1 0 0.1
v 0 1 1e-30
v 1 1 -0
v 0 0 1.00000012
v 1 0 1
v 0 1 1000000064
v 1 1 1
f 5 6 8 7
f 1 2 6 5
f 2 4 8 6
f 4 3 7 8
f 3 1 5 7
t interpolateboundary 1/0/0 1
t creasemethod 0/0/1 chaikin
t crease 4/2/0 5 7 0 1 0.333333343 2
t crease 2/1/0 4 5 inf
t crease 2/1/0 6 7 10.5
t crease 2/1/0 4 6 1e-42
t corner 2/1/0 4 5 1.10000002
t hole 1/0/0 2
END
}

# verified ARGUMENT...: passes, and the numbers are those of float arithmetic.
verified() {
    works verify "$@"
    largest=$(sed -n 's/.*largest \([^ ]*\) .*/\1/p' stdout.txt)
    mean=$(sed -n 's/.*mean \(.*\); tolerance .*/\1/p' stdout.txt)
    awk -v largest="$largest" -v mean="$mean" \
        'BEGIN { exit !(mean > 0 && mean <= largest && largest > 1e-9 && largest <= 3e-7) }' ||
        fail "verify $*: largest '$largest', mean '$mean'"
}

# skip_without_opensubdiv: leaves the test, whose subject is `limn verify`.
skip_without_opensubdiv() {
    "$limn" verify torus.limn --against "$torus" 2>&1 | grep -q 'built without OpenSubdiv' || return
    echo "built without OpenSubdiv: verify is not tested"
    finish
    exit 0
}
