#!/bin/sh
# SPDX-License-Identifier: MIT
# FBX and Collada: a skinned box of quads.
#
# usage: see cli.sh
. "$(dirname "$0")/cli.sh"

for format in fbx dae; do
    cp "$corpus/$format/box.$format" box.$format
    notes "the texture 'brick.png' is missing" bake box.$format -o box.limn --scheme catmark
    works info box.limn
    says stdout '^body  *10  *12 '
    says stdout '^a skeleton of 3 joints$'
    works convert -q box.$format box.obj
    [ "$(grep -c '^f [^ ]* [^ ]* [^ ]* [^ ]*$' box.obj)" = 10 ] || fail "box.$format: not ten quads"
    works verify box.limn --against box.$format
    head -c 1500 box.$format >cut.$format
    refuses 1 "cut.$format: " bake cut.$format -o new.limn
    refuses 2 "new.$format: the output is a .limn file" bake box.$format -o new.$format
done

finish
