#!/bin/sh
# SPDX-License-Identifier: MIT
# limn --help and limn bake: what its options do, and where its output goes.
#
# usage: see cli.sh
. "$(dirname "$0")/cli.sh"

# ---- Help and version

works --help
for command in bake convert info export verify; do says stdout "^  $command "; done
works -h
works --version
says stdout '^limn [0-9]*\.[0-9]*\.[0-9]*$'
for command in bake convert info export verify; do
    "$limn" $command --help >stdout.txt 2>stderr.txt
    expect "$command --help" $? 0
    last="$command --help"
    says stdout "^Usage: limn $command "
    says stdout --help
    "$limn" $command -h | cmp -s - stdout.txt || fail "$command -h differs from --help"
done
refuses 2 '^Usage: '
refuses 2 "no command 'frob'" frob
refuses 2 "no command '--frob'" --frob
refuses 2 "no command ''" ''

# ---- bake

works bake "$torus" -o torus.limn
says stdout '^torus.limn: 1 mesh, 32 faces, 1 classes, '
works bake -q "$torus" -o quiet.limn
expect "bake -q" "$(cat stdout.txt)" ""
cmp torus.limn quiet.limn || fail "bake: not the same bytes twice"
works bake -o torus.limn -- "$torus"
cmp torus.limn quiet.limn || fail "bake: options before inputs"
works bake "$torus" --output=torus.limn --weights=loop --boundary edge-only
cmp torus.limn quiet.limn || fail "bake: the defaults are not what they are said to be"
works bake "$sail" -o sail.limn
works bake "$sail" -o warren.limn --weights warren
works bake "$sail" -o corner.limn --boundary edge-and-corner
cmp -s sail.limn warren.limn && fail "--weights does nothing"
cmp -s sail.limn corner.limn && fail "--boundary does nothing"
works bake "$sail" -o butterfly.limn --scheme butterfly
works bake "$sail" -o tension.limn --scheme butterfly --tension=-0.0625
cmp -s butterfly.limn tension.limn && fail "--tension does nothing"
works info tension.limn
says stdout '^baked with scheme=butterfly tension=-0.0625 boundary=edge-only normals=none$'
works bake "$sail" -o tension.limn --scheme butterfly --tension 0
cmp butterfly.limn tension.limn || fail "the tension is not 0 by default"
works bake "$sail" -o flat.limn --scheme none
works info flat.limn
says stdout '^baked with scheme=none boundary=edge-only normals=none$'
notes 'cube.off: triangulated 3 quads and 3 larger polygons: 7 faces became 16' bake "$cube" -o cube.limn
works bake -q "$cube" -o cube.limn
works bake -q "$torus" "$sail" "$cube" "$torus" -o several.limn


# What the mesh asks for, unless the command line says otherwise; and what it asks for in vain.
tagged() { { cat "$sail" && echo "$1"; } >tagged/sail.obj; }
mkdir tagged
tagged 't interpolateboundary 1/0/0 1'
works bake tagged/sail.obj -o tagged.limn
cmp tagged.limn corner.limn || fail "t interpolateboundary does nothing"
works bake tagged/sail.obj -o tagged.limn --boundary edge-only
cmp tagged.limn sail.limn || fail "--boundary does not prevail"
works bake tagged/sail.obj -o tagged.limn --scheme butterfly
cmp tagged.limn butterfly.limn || fail "t interpolateboundary changes the butterfly"
tagged 't crease 2/1/0 26 34 2.5'
notes 'sail.obj: sharp edges and vertices are smooth' bake tagged/sail.obj -o tagged.limn --scheme butterfly
cmp tagged.limn butterfly.limn || fail "t crease changes the butterfly"
tagged 't interpolateboundary 1/0/0 0'
works bake tagged/sail.obj -o tagged.limn
works bake "$sail" -o none.limn --boundary none
cmp tagged.limn none.limn || fail "t interpolateboundary 0 is not --boundary none"
tagged 't crease 2/1/0 26 34 2.5'
works bake tagged/sail.obj -o tagged.limn
cmp -s tagged.limn sail.limn && fail "t crease does nothing"
works info tagged.limn
says stdout 'creases=opensubdiv creasing=uniform'
works bake tagged/sail.obj -o tagged.limn --creasing chaikin --creases opensubdiv
works info tagged.limn
says stdout 'creasing=chaikin'
works bake tagged/sail.obj -o lomont.limn --creases lomont
works info lomont.limn
says stdout 'boundary=edge-only creases=lomont normals=none'
cmp -s tagged.limn lomont.limn && fail "--creases lomont does nothing"
refuses 2 '--creasing chaikin goes with' bake tagged/sail.obj -o tagged.limn --creases lomont --creasing chaikin
refuses 2 "no crease rules 'hoppe'" bake tagged/sail.obj -o tagged.limn --creases hoppe
refuses 2 "no creasing method 'hard'" bake tagged/sail.obj -o tagged.limn --creasing hard
tagged 't hole 3/0/0 0 5 87'
works bake tagged/sail.obj -o tagged.limn
works info tagged.limn --json
expect "patches beside holes" "$(json patches)" 85
tagged 't crease 2/1/0 0 5000 1'
notes 'sail.obj: ignored: 1 creases .*line' bake tagged/sail.obj -o tagged.limn
tagged 't vertexedit 16/24/3'
notes "sail.obj:[0-9]*: unknown tag 'vertexedit' is ignored" bake tagged/sail.obj -o tagged.limn

# C source holds the same bytes.
works bake -q "$torus" -o torus.c --c-array torus
expect "bytes as C" "$(sed -n 's/^[0-9].*/&/p' torus.c | tr , '\n' | grep .)" \
    "$(od -An -v -tu1 -w1 torus.limn | tr -d ' ')"
size=$(wc -c <torus.limn)
grep -q "^const size_t torus_size = $size;" torus.c || fail "size as C"
for name in 2 a-b while ''; do
    refuses 2 "'$name' cannot be the name of an array" bake "$torus" -o new.c --c-array "$name"
done

# Files take the usual permissions, replace what was there, and go where links lead.
(umask 027 && "$limn" bake -q "$torus" -o mode.limn)
expect "permissions" "$(ls -l mode.limn | cut -c1-10)" "-rw-r-----"
mkdir far
echo old >far/target.limn
ln -s far/target.limn link.limn
works bake -q "$torus" -o link.limn
[ -L link.limn ] || fail "the link was replaced"
cmp far/target.limn torus.limn || fail "the target of the link was not written"
ln -s far/new.limn dangling.limn
works bake -q "$torus" -o dangling.limn
[ -L dangling.limn ] || fail "the link to nowhere was replaced"
cmp far/new.limn torus.limn || fail "the target of the link to nowhere was not written"
expect "far" "$(ls -A far | tr '\n' ' ')" "new.limn target.limn "
works bake -q "$torus" -o /dev/null
[ -c /dev/null ] || fail "/dev/null was replaced"

finish
