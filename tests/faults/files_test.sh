#!/bin/sh
# SPDX-License-Identifier: MIT
# Disks that are full, inputs that vanish, processes that are killed: what was at the output's path stays, or the whole
# new file is there; never a part.
#
#   sh files_test.sh LIMN ASSETS_FOLDER WORK_FOLDER ROUNDS
set -u
export LC_ALL=C

limn=$(realpath "$1")
assets=$(realpath "$2")
rounds=$4
mkdir -p "$3"
cd "$3" || exit 1
rm -rf ./*
failed=0

fail() {
    echo "FAILED: $*" >&2
    failed=1
}

# left_alone WHAT: the older file is as it was, and nothing lies beside it.
left_alone() {
    cmp -s old out || fail "$1: the older file was damaged"
    [ "$(echo out*)" = out ] || fail "$1: left $(echo out*)"
}

"$limn" bake -q "$assets/imp.obj" -o imp.limn --normals exact || exit 1
"$limn" convert -q "$assets/imp.obj" imp.off || exit 1
echo old >old

# command_of KIND: becomes what writes imp.KIND to `out`, which takes several writes.
command_of() {
    case $1 in
    limn) set -- bake -q "$assets/imp.obj" -o out --normals exact ;;
    off) set -- convert -q "$assets/imp.obj" out --format off ;;
    esac
    exec "$limn" "$@"
}

# ---- A disk that is full after 8 KB: the write fails, or where the signal is not ignored, it kills.

for kind in limn off; do
    cp old out
    (
        trap '' XFSZ
        ulimit -f 16
        command_of $kind
    ) 2>stderr.txt
    [ $? -eq 1 ] || fail "$kind on a full disk: not status 1"
    grep -q "^limn: out: cannot write: File too large" stderr.txt || fail "$kind on a full disk: $(cat stderr.txt)"
    left_alone "$kind on a full disk"
done
(
    ulimit -c 0
    ulimit -f 16
    command_of limn
) 2>stderr.txt
cmp -s old out || fail "killed by a full disk: the older file was damaged"
rm -f out*

# ---- Inputs that cannot be read, or vanish

cp old out
if [ "$(id -u)" -ne 0 ]; then
    cp "$assets/imp.obj" secret.obj
    chmod 000 secret.obj
    "$limn" bake secret.obj -o out 2>stderr.txt && fail "an unreadable input was baked"
    grep -q 'secret.obj: cannot be read: Permission denied' stderr.txt || fail "unreadable: $(cat stderr.txt)"
    left_alone "an unreadable input"
fi
ln -s nowhere.obj dangling.obj
"$limn" bake dangling.obj -o out 2>stderr.txt && fail "a link to nowhere was baked"
grep -q 'dangling.obj: cannot be read: No such file' stderr.txt || fail "a link to nowhere: $(cat stderr.txt)"
left_alone "a link to nowhere"

# Another process takes the input away and brings back a part of it, all the time.
head -c 9000 "$assets/imp.obj" >part.obj
cp "$assets/imp.obj" whole.obj
(
    while [ ! -e stop ] && kill -0 $$ 2>/dev/null; do
        for name in part whole; do
            ln -f $name.obj changing.obj
            rm -f changing.obj
        done
        ln -f whole.obj changing.obj
    done
) &
changer=$!
"$limn" bake -q whole.obj -o imp_changing.limn --normals exact
round=0
while [ $round -lt "$rounds" ]; do
    cp old out
    status=0
    "$limn" bake -q changing.obj -o out --normals exact 2>stderr.txt || status=$?
    if [ $status -eq 0 ]; then
        [ "$(head -c 4 out)" = LIMN ] && "$limn" info out >/dev/null || fail "a changing input: not a whole file"
    else
        [ $status -eq 1 ] && [ -s stderr.txt ] || fail "a changing input: status $status, $(cat stderr.txt)"
        left_alone "a changing input"
    fi
    round=$((round + 1))
done
: >stop
wait $changer

# ---- Killed at any time: a part may lie beside the output, under a name of its own, but not at its path.

killed=0
round=0
while [ $round -lt "$rounds" ]; do
    for kind in limn off; do
        rm -f out*
        cp old out
        command_of $kind &
        process=$!
        sleep "0.0$(((round * 37 + 11) % 100 / 10))$((round % 10))"
        kill -9 $process 2>/dev/null && killed=$((killed + 1))
        wait $process 2>/dev/null
        cmp -s old out || cmp -s imp.$kind out || fail "$kind, killed: neither the older file nor the new one"
    done
    round=$((round + 1))
done
echo "$rounds times a changing input; $killed processes killed"
[ $killed -gt 0 ] || fail "none was killed in time"
exit $failed
