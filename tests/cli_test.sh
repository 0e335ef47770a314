#!/bin/sh
# SPDX-License-Identifier: MIT
# Every command of limn, right and wrong: exit statuses, messages, and what is left on the disk.
#
# usage: cli_test.sh LIMN ASSETS_FOLDER WORK_FOLDER
set -u
export LC_ALL=C # the messages of the system too

if [ $# -ne 3 ]; then
    echo "usage: $0 LIMN ASSETS_FOLDER WORK_FOLDER" >&2
    exit 2
fi
case $1 in */*) limn=$(cd "$(dirname "$1")" && pwd)/$(basename "$1") ;; *) limn=$1 ;; esac
assets=$(cd "$2" && pwd) || exit 1
character=$(cd "$(dirname "$0")" && pwd)/fuzz/corpus/gltf/character.gltf

# Never touch what somebody else keeps in the folder: everything happens in one of our own.
mkdir -p "$3" || exit 1
folder=$(mktemp -d "$3/cli_test.XXXXXX") || exit 1
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

# ---- Meshes that cannot be baked

# bad NAME PATTERN: the lines of stdin cannot be baked, and an older output stays as it was.
bad() {
    cat >"$1"
    refuses 1 "^limn: $1:.*$2" bake "$1" -o new.limn
    cp torus.limn kept/old.limn
    refuses 1 "$2" bake "$torus" "$1" -o kept/old.limn
    cmp -s kept/old.limn torus.limn || fail "$1: the older file was damaged"
}
four="v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
printf "${four}v 1 1 1\nf 1 2 3\nf 2 1 4\nf 1 2 5\n" | bad edge.obj \
    'non-manifold edge from vertex 1 (line 1) to vertex 2 (line 2): 3 faces share it, among them face 1 (line 6) and face 3 (line 8)'
printf "${four}v 1 1 1\nf 1 2 3\nf 1 4 5\n" | bad vertex.obj \
    'non-manifold vertex 1 (line 1): face 1 (line 6) and face 2 (line 7)'
printf "${four}f 1 2 3\nf 1 2 4\n" | bad winding.obj \
    'inconsistent winding: face 1 (line 5) and face 2 (line 6) both run from vertex 1 (line 1) to vertex 2 (line 2)'
printf "${four}f 1 2 3\nf 1 3 3\n" | bad degenerate.obj '6: degenerate face'
printf "${four}f 1 2 3\nf 3 1 2\n" | bad repeated.obj '6: repeated face'
printf "${four}f 1 2 5\n" | bad range.obj '5: .*5'
printf "${four}f 1 2 0\n" | bad zero.obj '5: '
printf "${four}f 1 2 3\nt crease 2/1/0 0 1 -1\n" | bad negative.obj "6: sharpness is negative: '-1'"
printf "${four}f 1 2 3\nt hole 1/0/0 0\n" | bad hole.obj ' every face is a hole'
printf "v 0 0 nan\nf 1 1 1\n" | bad nan.obj '1: '
printf "v 0 0 1e99\nf 1 1 1\n" | bad huge.obj '1: '
printf "" | bad empty.obj ' '
printf "$four" | bad faceless.obj ' '
printf "OFF\n3 1 0\n0 0 0\n1 0 0\n" | bad truncated.off '2: the file ends too early'
printf "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n" | bad range.off '6: '
printf "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 1 3\n" | bad winding.off \
    'face 0 (line 7) and face 1 (line 8) both run from vertex 0 (line 3) to vertex 1 (line 4)'

# bipyramid COUNT: its tips have that many neighbours, which are next to each other and to both tips.
bipyramid() {
    awk -v n="$1" 'BEGIN {
        print "v 0 0 1\nv 0 0 -1"
        for (k = 0; k < n; k++) print "v", cos(6.2831853 * k / n), sin(6.2831853 * k / n), 0
        for (k = 0; k < n; k++) print "f 1", k + 3, (k + 1) % n + 3 "\nf 2", (k + 1) % n + 3, k + 3
    }'
}
bipyramid 200 >points.obj
works bake points.obj -q -o points.limn --scheme butterfly # 202 points, whose edges are counted 2200 times
bipyramid 2047 >points.obj
refuses 1 'points.obj: vertex 1 (line 1) has valence 2047: around face 1 (line 2050) there are more than 2048 control points' \
    bake points.obj -o new.limn --scheme butterfly
refuses 1 'has valence 2047: the corners of face 1 (line 2050) have more than 2048 edges in all' bake points.obj -o new.limn
# Of a mesh that is divided first, what the file has is named, and what it has not is not.
refuses 1 'points.obj: vertex 1 (line 1) has valence 2047: around a part of face 1 (line 2050) there are more than 2048' \
    bake points.obj -o new.limn --scheme butterfly --isolate 1
{
    awk 'BEGIN { for (k = 0; k < 1030; k++) print "v", cos(6.2831853 * k / 1030), sin(6.2831853 * k / 1030), 0 }'
    seq -s ' ' 1 1030 | sed 's/^/f /'
} >polygon.obj
refuses 1 'polygon.obj: a vertex of the divided mesh has valence 1030: the corners of a part of face 1 (line 1031) have more' \
    bake polygon.obj -o new.limn --scheme catmark

# Coordinates whose sums would overflow.
printf 'v 0 0 0\nv 1e37 0 0\nv 0 -1.1e37 0\nvt 0 0\nvt 0 2e37\nvt 1 0\nf 1/1 2/2 3/3\n' >large.obj
refuses 1 'large.obj: a coordinate of vertex 3 (line 3) is too large: 1.1e+37; 1e37 is the most' bake large.obj -o new.limn
sed 's/1\.1e37/1e37/' large.obj >uv.obj
refuses 1 'uv.obj: value 2 of uv is too large: 2e+37; 1e37 is the most' bake uv.obj -o new.limn
works bake uv.obj -q -o large.limn --no-channels --isolate 1

refuses 1 'missing.obj: cannot be read: No such file' bake missing.obj -o new.limn
refuses 1 'folder' bake far -o new.limn
refuses 1 'torus.limn: unknown kind' bake torus.limn -o new.limn
refuses 1 'no_folder/new.limn: cannot .*: No such file' bake "$torus" -o no_folder/new.limn
refuses 1 'far: cannot write: Is a directory' bake "$torus" -o far
refuses 1 'far/: cannot write: Is a directory' bake "$torus" -o far/
refuses 2 'there is no output' bake "$torus" -o ''
refuses 1 'torus.limn/new.limn: cannot .*: Not a directory' bake "$torus" -o torus.limn/new.limn
if [ -c /dev/full ]; then refuses 1 '/dev/full: cannot write: No space' bake -q "$torus" -o /dev/full; fi

refuses 2 'no input' bake
refuses 2 'no input' bake -o new.limn
refuses 2 'no output' bake "$torus"
refuses 2 'see limn bake --help' bake "$torus" -o
refuses 2 'see limn bake --help' bake "$torus" -o new.limn --frob
refuses 2 'see limn bake --help' bake "$torus" -o new.limn --quiet=3
refuses 2 "no weights 'Loop'" bake "$torus" -o new.limn --weights Loop
refuses 2 "no scheme 'sqrt3'" bake "$torus" -o new.limn --scheme sqrt3
for scheme in catmark butterfly none; do
    refuses 2 '--weights are those of --scheme loop' bake "$torus" -o new.limn --scheme $scheme --weights warren
    refuses 2 '--creases lomont goes with --scheme loop' bake "$torus" -o new.limn --scheme $scheme --creases lomont
done
for scheme in butterfly none; do
    for creasing in uniform chaikin; do
        refuses 2 '--creasing goes with' bake "$torus" -o new.limn --creasing $creasing --scheme $scheme
    done
    refuses 2 'edge-and-corner goes with' bake "$torus" -o new.limn --boundary edge-and-corner --scheme $scheme
done
for scheme in loop catmark none; do
    refuses 2 '--tension is that of --scheme butterfly' bake "$torus" -o new.limn --tension 0.1 --scheme $scheme
done
for tension in 0.26 -0.2500001 nan 1/16 '' ' '; do
    refuses 2 "'$tension' is not a tension between" bake "$torus" -o new.limn --scheme butterfly --tension "$tension"
done
refuses 2 "no boundary rule ''" bake "$torus" -o new.limn --boundary ''
for steps in '' , weld, ,weld welt 'weld drop' weld,,drop WELD; do
    refuses 2 'cannot repair' bake "$torus" -o new.limn "--repair=$steps"
done
cp "$torus" both.obj
refuses 2 'the output is a .limn file' bake both.obj -o both.obj
refuses 2 'the output is a .limn file' bake "$torus" -o both.OFF
ln both.obj other_name.limn
refuses 2 'both.obj is input and output' bake both.obj -o ./other_name.limn
cmp both.obj "$torus" || fail "the input was overwritten"

# ---- convert

# same_bake A B OPTION...: two meshes give the same file, byte for byte; they have one name.
same_bake() {
    first=$1
    second=$2
    shift 2
    works bake -q "$first" -o one.limn "$@"
    works bake -q "$second" -o two.limn "$@"
    cmp one.limn two.limn || fail "$first and $second do not give the same file"
    run 0 bake -q "$first" -o one.limn --creases lomont "$@"
    works bake -q "$second" -o two.limn --creases lomont "$@"
    cmp one.limn two.limn || fail "$first and $second do not give the same file with Lomont's rules"
}

# tags_of FILE: its creases and corners that are not smooth, in an order of their own.
tags_of() {
    awk '$2 == "crease" && $6 != 0 { print $2, ($4 < $5 ? $4 " " $5 : $5 " " $4), $6 }
         $2 == "corner" && $5 != 0' "$1" | sort
}

# round_trip MESH FOLDER: through every format and back. What has tags keeps them where formats have.
round_trip() {
    name=$(basename "$1")
    name=${name%.*}
    for format in obj off ply lomont; do mkdir -p "$2/$format" "$2/back_$format"; done
    run 0 convert -q "$1" "$2/obj/$name.obj"
    run 0 convert -q "$1" "$2/lomont/$name.obj" --format lomont
    same_bake "$1" "$2/obj/$name.obj"
    same_bake "$1" "$2/lomont/$name.obj" --no-channels
    works convert -q "$2/obj/$name.obj" "$2/back_obj/$name.obj"
    cmp "$2/obj/$name.obj" "$2/back_obj/$name.obj" || fail "$1: OBJ changes on the way"
    works convert -q "$2/lomont/$name.obj" "$2/back_obj/$name.obj"
    same_bake "$1" "$2/back_obj/$name.obj" --no-channels
    works convert -q "$2/back_obj/$name.obj" "$2/back_lomont/$name.obj" --format=lomont
    cmp "$2/lomont/$name.obj" "$2/back_lomont/$name.obj" || fail "$1: Lomont's OBJ changes on the way"
    tags_of "$2/obj/$name.obj" >one.txt
    tags_of "$2/back_obj/$name.obj" >two.txt
    cmp one.txt two.txt || fail "$1: tags change on the way through Lomont's OBJ"
    for format in off ply; do
        run 0 convert -q "$1" "$2/$format/$name.$format"
        works convert -q "$2/$format/$name.$format" "$2/back_$format/$name.obj"
        sed '/^v*t /d; s,/[0-9]*,,g' "$2/obj/$name.obj" | cmp - "$2/back_$format/$name.obj" ||
            fail "$1: not the same bits after $format"
    done
}

# ---- glTF: two meshes, a skeleton, a clip and a material

cp "$assets/../tests/fuzz/corpus/gltf/character.glb" character.glb
run 0 bake character.glb -o character.limn --images -q # or it was built without
if ! grep -q 'built without tinygltf' stderr.txt; then
    notes "mesh 0: 1 positions have the place of another and are kept apart" bake character.glb -o character.limn --images
    works info character.limn
    says stdout '^a skeleton of 3 joints$'
    says stdout '^animation 0  *1.000  *4$'
    says stdout '^material 0  *1 1 1 1  *4  image 0$'
    works info character.limn --json
    for key in joints clips materials influences morph_targets; do
        says stdout "\"$key\""
    done
    works bake character.glb -o named.limn -q
    works info named.limn
    says stdout '^material 0  *1 1 1 1  *0  image 0$'
    refuses 1 'character.glb: it has 2 meshes, and one is needed' convert character.glb new.obj
    refuses 2 'new.glb: the output is a .limn file' bake character.glb -o new.glb
    head -c 2000 character.glb >cut.glb
    refuses 1 'cut.glb: not good glTF: ' bake cut.glb -o new.limn
fi

# A cube without its bottom: creases inside and on the boundary, sharp for ever, smooth again, and of
# many digits; corners; a hole; and both rules.
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
mkdir trip
round_trip house.obj trip
round_trip "$cube" trip
round_trip "$sail" trip
if [ -n "${LIMN_TEST_ASSETS:-}" ]; then
    for name in loop_cubes_semisharp loop_icos_infsharp catmark_hole_test2 catmark_dart_edgecorner; do
        round_trip "$LIMN_TEST_ASSETS/opensubdiv_shapes/$name.obj" trip
    done
fi
notes 'triangulated' convert house.obj lomont.obj -f lomont
says stdout '^lomont.obj: 8 vertices, 10 faces$'
expect "Lomont's first line" "$(head -n 1 lomont.obj)" '#SubdivisionSurfL 0.1'
expect "Lomont's sizes" "$(sed -n 2p lomont.obj)" 'si 8 10 17 0'
expect "Lomont's entries" "$(cut -d' ' -f1 lomont.obj | uniq -c | tr -s ' \n' ' ')" \
    " 1 #SubdivisionSurfL 1 si 8 v 10 f 30 hd 8 vs 5 t "
expect "boundaries" "$(grep '^hd -1' lomont.obj | sort | uniq -c | tr -s ' ')" ' 4 hd -1 inf'
expect "one sharpness, twice" "$(grep -c '^hd .* 0.333333343$' lomont.obj)" 2
notes "lomont.obj: a mesh of Lomont's with OpenSubdiv's creases" bake lomont.obj -o lomont.limn
works bake -q lomont.obj -o lomont.limn --creases lomont
notes "house.obj: Chaikin's creasing is ignored" bake house.obj -o lomont.limn --creases lomont
notes 'house.off: lost, as the format has no tags: 5 creases, 2 corners, 1 holes, and rules' convert house.obj house.off
works convert house.off house.ply
says stdout '^house.ply: 8 vertices, 5 faces$'
works convert house.ply house.off.obj -q
expect "convert -q" "$(cat stdout.txt)" ""
works convert house.off house.data --format off
cmp house.off house.data || fail "convert --format: not the same"
works convert house.off /dev/null -f ply
awk '/^hd/ && !done { $3 = 7; done = 1 } { print }' lomont.obj >bad_weight.obj
refuses 1 'bad_weight.obj:21: half-edges 1 and .* are a pair, but differ in sharpness' convert bad_weight.obj new.obj
printf 'f 1 2 3\nt corner 1/1/0 9 1\n' | cat house.obj - >extra.obj
notes 'extra.obj: ignored: 1 corners that name no vertex (the first is in line 23)' convert extra.obj kept_tags.obj
grep -q 'corner 1/1/0 9' kept_tags.obj && fail "convert keeps the tag of a vertex that is not there"
refuses 1 'edge.obj: non-manifold edge' convert edge.obj new.obj --format lomont
works convert edge.obj edge.ply
refuses 2 "cannot 'weld' what is not" convert edge.obj new.obj --non-manifold weld
notes 'edge.obj: split: 1 edges' convert edge.obj split_lomont.obj --format lomont --non-manifold split
says stdout '^split_lomont.obj: 9 vertices, 3 faces$'
works bake split_lomont.obj -o split_lomont.limn -q
refuses 1 'missing.obj: cannot be read' convert missing.obj new.ply
refuses 1 'nan.obj:1: ' convert nan.obj new.ply
refuses 1 'no_folder/new.ply: cannot ' convert house.obj no_folder/new.ply -q
if [ -c /dev/full ]; then refuses 1 '/dev/full: cannot write: No space' convert house.off /dev/full -f ply; fi
echo old >kept/old.obj
refuses 1 'nan.obj:1: ' convert nan.obj kept/old.obj
expect "the older file" "$(cat kept/old.obj)" old
refuses 2 'one input and one output' convert
refuses 2 'one input and one output' convert house.obj
refuses 2 'one input and one output' convert house.obj a.obj b.obj
refuses 2 'new.stl: the output must end in .obj, .off or .ply' convert house.obj new.stl
refuses 2 "no format 'OBJ'" convert house.obj new.obj --format OBJ
refuses 2 'house.obj is input and output' convert house.obj ./house.obj
refuses 2 'see limn convert --help' convert house.obj new.obj --frob

# ---- Welding goes by place: surfaces that only touch stay apart

printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n' >pillow.obj
works bake pillow.obj -o pillow.limn
works export pillow.limn --level 4 --weld -o pillow_dense.obj
expect "welded vertices of a pillow" "$(grep -c '^v ' pillow_dense.obj)" $((3 + 15 * 3 + 105 * 2))

# ---- What no face uses does not matter

printf 'v 5 5 5\nv 6 5 5\nv 5 6 5\nv 5 5 6\nv 1e30 0 0\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' >far.obj
works bake -q far.obj -o far.limn
works export far.limn --level 1 --weld -o far_dense.obj
expect "welded vertices beside an unused one" "$(grep -c '^v ' far_dense.obj)" 10

# ---- Repair

notes 'repaired: 1 degenerate and 0 repeated' bake degenerate.obj -o repaired.limn --repair=drop
notes 'repaired: 0 degenerate and 1 repeated' bake repeated.obj -o repaired.limn --repair=weld,drop
printf "${four}v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 3 2\nf 5 6 4\nf 2 7 4\nf 3 1 4\n" >loose.obj
notes 'loose.obj: repaired: 3 control points welded' bake loose.obj -o loose.limn --repair=weld
works info loose.limn --json
expect "welded control points" "$(json control_points)" 4
works bake -q loose.obj -o loose.limn --repair=all
refuses 1 'edge.obj: non-manifold edge' bake edge.obj -o new.limn --repair
refuses 2 'cannot repair' bake edge.obj -o new.limn --repair=split
refuses 1 'range.obj:5: ' bake range.obj -o new.limn --repair
printf "${four}f 1 2 2\n" >hopeless.obj
refuses 1 'hopeless.obj: the mesh has no faces' bake -q hopeless.obj -o new.limn --repair

# ---- No scheme

refuses 2 "no scheme 'cubic'" bake "$sail" -o new.limn --scheme cubic
works bake "$sail" -o flat.limn --scheme none --normals exact
says stdout '88 faces, 1 classes'

# ---- Isolation

# What a face takes at a level, with the points of level 1, by the last `info --json`.
json_ns() {
    awk -v level="$1" '/"ns_per_face"/ { at = NR + 1 + level } NR == at { ns = $1 } /"points_ns_per_face"/ { print ns + $2 }' stdout.txt
}

refuses 2 "there is no face-varying mode 'corner'" bake "$torus" -o new.limn --face-varying corner
refuses 2 'with --scheme none, --face-varying is all' bake "$torus" -o new.limn --scheme none --face-varying none
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nf 1/1 2/2 3/3\n' >uv.obj
refuses 1 'uv.obj:6: face refers to texture coordinate 3, but the file has 2' bake uv.obj -o new.limn
printf 'vt 0 1\n' >>uv.obj
works bake -q uv.obj -o uv.limn --face-varying corners-plus2
works info uv.limn
says stdout '^uv .* uv .* uv .* corners-plus2 .* 3 '
works verify uv.limn --against uv.obj
says stdout '^uv, channel 0: [0-9]* values; '
works convert -q uv.obj uv_again.obj
grep -q '^f 1/1 2/2 3/3$' uv_again.obj || fail 'texture coordinates are not in uv_again.obj'
notes "lost, as the format has none: the texture coordinates 'uv'" convert uv.obj uv.ply
refuses 2 "cannot isolate '2'" bake "$torus" -o new.limn --isolate 2
works bake -q "$sail" -o isolated.limn --isolate 1
works info isolated.limn
says stdout '^baked with .* isolate=1$'
says stdout 'which are made of [0-9]* pieces'
way='[0-9]* bytes, of which [0-9]* are tables, and [0-9.]* ns per face at level 3'
notes "sail: isolated: 0\.[0-9]* times the bytes in 1\.[0-9]* times the time: $way; isolated $way" \
    bake "$sail" "$torus" -o chosen.limn --isolate auto
says stderr "torus32: not isolated: its tables take at most 256 KB: $way; isolated $way"
works info chosen.limn
says stdout 'isolate=mixed bytes=[0-9]* isolated-bytes=[0-9]* ns=[0-9]* isolated-ns=[0-9]*$'
notes "sail: not isolated: 0\.[0-9]* times the bytes in 1\.[0-9]* times the time: $way; isolated $way" \
    bake "$sail" -o alone.limn --isolate auto --scheme catmark
notes 'sail: isolated: ' bake "$sail" -o alone.limn --isolate auto
works info alone.limn --json
bytes=0
for key in table_size columns_size patch_size points_size; do bytes=$((bytes + $(json $key))); done
says stdout " isolated-bytes=$bytes "
expect "time of an isolated mesh" "$(sed -n 's/.* isolated-ns=\([0-9]*\).*/\1/p' stdout.txt)" "$(json_ns 3 | awk '{ print int($1 * 88) }')"
notes 'torus32: not isolated: ' bake "$torus" -o alone.limn --isolate auto
works info --json alone.limn
expect "points of a mesh that is not isolated" "$(json points)" 16
notes 'torus32.obj: not isolated: with the butterfly' bake "$torus" -o alone.limn --isolate auto --scheme butterfly
works info alone.limn
says stdout ' normals=none isolate=0$'
# Counted by hand: a torus of one class, 12 control points of which 11 are in mirrored sums, 32 patches. A patch, its
# rows, its blocks of 8 rows (at level 4, 64 rows and 48 pairs), and a 32nd of a change of class; isolated, four pieces,
# of which level 0 takes three: 18 points are looked at for each and 12 summed; and 2 points of 9.5 terms.
counted() {
    works bake -q "$torus" -o counted.limn --isolate "$1"
    works info --json counted.limn
    expect "ns at level $2" "$(json_ns "$2" | awk '{ printf "%.2f", $1 }')" "$(awk "BEGIN { printf \"%.2f\", $3 }")"
}
counted 0 0 '18 + 3 * 0.35 + 12 * 0.5 + 80 / 32'
counted 0 4 '18 + 153 * 0.35 + (12 * 8 + 11 * 6) * 0.5 + 80 / 32'
counted 1 0 '18 + 3 * 0.35 + 3 * (18 * 1.25 + 12 * 0.5) + 80 / 32 + 2 * 0.75 + 9.5 * 0.5'
counted 1 4 '18 + 153 * 0.35 + 4 * 18 * 1.25 + (3 * 5 + 6) * 12 * 0.5 + 80 / 32 + 2 * 0.75 + 9.5 * 0.5'
# Tables of tens of kilobytes for any mesh without creases, and few more for several.
tables_below() {
    limit=$1
    shift
    works bake -q "$@" -o small.limn --isolate 1
    works info --json small.limn
    [ "$(json table_size)" -le "$limit" ] || fail "$*: tables of $(json table_size) bytes, more than $limit"
}
tables_below 65536 "$assets/imp.obj"
tables_below 65536 "$assets/imp_quads.obj" --scheme catmark
tables_below 131072 "$assets"/*.obj

# ---- What is not a manifold

notes 'edge.obj: split: 1 edges, sharp now, and 2 vertices, of which 2 are corners now; 4 control points added' \
    bake edge.obj -o split.limn --non-manifold split
works info split.limn --json
expect "split control points" "$(json control_points)" 9
notes 'split: 0 edges, sharp now, and 1 vertices, of which 1 are corners now; 1 control points' \
    bake vertex.obj -o vertex.limn --non-manifold=split
notes 'split: 1 edges' bake winding.obj -o winding.limn --non-manifold split
refuses 1 'degenerate.obj:6: degenerate' bake degenerate.obj -o new.limn --non-manifold split
refuses 1 'edge.obj: non-manifold edge' bake edge.obj -o new.limn --non-manifold refuse
refuses 2 "cannot 'weld' what is not a manifold" bake edge.obj -o new.limn --non-manifold weld
works bake -q "$torus" -o clean.limn --non-manifold split
cmp -s clean.limn torus.limn || fail "splitting a manifold makes a difference"


# ---- info

works info several.limn
for name in torus32 sail cube; do says stdout "^$name "; done
says stdout 'scheme=loop weights=loop boundary=edge-only'
says stdout '^torus32  *0\.[0-9]*  *0\.[0-9]*  *0\.[0-9]*  *0\.[0-9]*$'
says stdout '^torus32  *[0-9.]*  *[0-9.]*  *[0-9.]*  *[0-9.]*  *[0-9.]*  *0\.0$'
works info --json several.limn
for key in file version size table_size columns_size class_count piece_count meshes name faces control_points patches points points_size patch_size \
    bytes_per_face ns_per_face points_ns_per_face edge_errors classes use_count; do
    says stdout "^ *\"$key\": "
done
expect "version" "$(json version)" 6
expect "size" "$(json size)" "$(size_of several.limn)"
expect "meshes" "$(grep -c '"bytes_per_face"' stdout.txt)" 4
expect "names" "$(sed -n 's/^ *"name": "\(.*\)",*$/\1/p' stdout.txt | tr '\n' ' ')" "torus32 sail cube torus32 "
expect "classes" "$(grep -c '"use_count"' stdout.txt)" "$(json class_count)"
expect "uses" "$(sed -n 's/^ *"use_count": \([0-9]*\),*$/\1/p' stdout.txt | awk '{ sum += $1 } END { print sum }')" \
    $((32 + 88 + 16 + 32))
expect "brackets" "$(tr -cd '{[' <stdout.txt | wc -c)" "$(tr -cd '}]' <stdout.txt | wc -c)"
several=$(json class_count)
works bake -q "$torus" "$sail" "$cube" -o three.limn
works info three.limn --json
expect "shared classes" "$(json class_count)" "$several"
works info torus.limn --json
expect "faces" "$(json faces)" 32
expect "patches" "$(json patches)" 32
expect "control points" "$(json control_points)" 16
expect "class count" "$(json class_count)" 1

# A name that is not UTF-8 is a name nevertheless.
latin=$(printf 'caf\351')
cp "$torus" "$latin.obj"
works bake -q "$latin.obj" -o latin.limn
works info latin.limn --json
says stdout '^ *"name": "caf'

# damaged COMMAND...: each is tried with files that are not whole; FILE stands for them.
damaged() {
    size=$(size_of sail.limn)
    : >empty.limn
    head -c 63 sail.limn >header.limn
    head -c 1000 sail.limn >beginning.limn
    head -c $((size - 1)) sail.limn >short.limn
    { cat sail.limn && printf x; } >long.limn
    { head -c $((size - 5)) sail.limn && printf 'x' && tail -c 4 sail.limn; } >changed.limn
    refuses 1 'missing.limn: No such file' "$1" missing.limn "$2" "$3" "$4" "$5"
    refuses 1 'empty.limn: .*empty' "$1" empty.limn "$2" "$3" "$4" "$5"
    for name in header beginning short; do
        refuses 1 "$name.limn: the blob is shorter" "$1" $name.limn "$2" "$3" "$4" "$5"
    done
    refuses 1 'long.limn: the blob is longer' "$1" long.limn "$2" "$3" "$4" "$5"
    refuses 1 'changed.limn: the file is damaged' "$1" changed.limn "$2" "$3" "$4" "$5"
    refuses 1 'torus32.obj: the blob is not a .limn file' "$1" "$torus" "$2" "$3" "$4" "$5"
    refuses 1 'far: ' "$1" far "$2" "$3" "$4" "$5"
}
refuses 1 'short.limn: No such file' info short.limn
damaged export --level 1 -o new.obj
damaged export --level=1 --weld -o new.ply
for name in header beginning short long changed; do
    refuses 1 "$name.limn: the " info $name.limn
    refuses 1 "$name.limn: the " info $name.limn --json
done
refuses 2 'one .limn file' info
refuses 2 'one .limn file' info torus.limn sail.limn
refuses 2 'see limn info --help' info torus.limn --frob
if [ -c /dev/full ]; then
    "$limn" info torus.limn --json >/dev/full 2>stderr.txt
    expect "info --json to a full disk" $? 1
    "$limn" info torus.limn >/dev/full 2>stderr.txt
    expect "info to a full disk" $? 1
fi

# ---- export: V + E, then each level has four times the faces of the one before

for level in 0 1 2 3 4; do
    steps=$((1 << level))
    works export torus.limn --level $level --weld -o welded.obj
    inner=$(((steps - 1) * (steps - 2) / 2))
    expect "welded, level $level" "$(obj_counts welded.obj)" \
        "$((16 + 48 * (steps - 1) + 32 * inner)) $((32 * steps * steps)) 0"
    works export torus.limn -l $level -o patches.obj
    rows=$(((steps + 1) * (steps + 2) / 2))
    expect "patches, level $level" "$(obj_counts patches.obj | cut -d' ' -f1,2)" \
        "$((32 * rows)) $((32 * steps * steps))"
    works export torus.limn --level $level --weld -o welded.ply
    vertices=$((16 + 48 * (steps - 1) + 32 * inner))
    header=$(sed '/^end_header/q' welded.ply | wc -c | tr -d ' ')
    expect "ply, level $level" "$(size_of welded.ply)" $((header + 12 * vertices + 13 * 32 * steps * steps))
done
sed '/^end_header/q' welded.ply >stdout.txt
last="export welded.ply"
says stdout '^ply$'
says stdout '^format binary_little_endian 1.0$'
says stdout "^element vertex $((16 + 15 * 48 + 105 * 32))\$"
says stdout "^element face $((256 * 32))\$"
works export several.limn --level 2 --weld -o several.obj
expect "objects" "$(grep '^o ' several.obj | tr '\n' ' ')" "o torus32 o sail o cube o torus32 "
expect "faces of several" "$(obj_counts several.obj | cut -d' ' -f2)" $(((32 + 88 + 16 + 32) * 16))

# What was exported can be baked again: it is a manifold.
works bake -q welded.obj -o again.limn
works export sail.limn --level 2 --weld -o sail.obj
works bake -q sail.obj -o again.limn
works export torus.limn --level 0 -o far/out.ply

# A moment of a clip. Names of clips are made different.
notes "there is a clip 'animation 0' already: this one is 'animation 0 2'" bake "$character" "$character" -o two.limn
works export two.limn --level 1 -o later.obj --clip 'animation 0 2'
works bake -q "$character" -o character.limn
works export character.limn --level 1 -o bind.obj
works export character.limn --level 1 -o start.obj --clip 'animation 0'
works export character.limn --level 1 -o later.obj --clip 'animation 0' --time 0.5
cmp -s bind.obj later.obj && fail "export --clip: nothing moves"
cmp -s start.obj later.obj && fail "export --time: nothing moves"
refuses 1 "clip 'walk': the file has animation 0" export character.limn --level 1 -o new.obj --clip walk
refuses 1 "clip 'walk': the file has no clips" export torus.limn --level 1 -o new.obj --clip walk
refuses 2 'time: there is no --clip' export torus.limn --level 1 -o new.obj --time 1
refuses 2 "time '-1': not a time" export torus.limn --level 1 -o new.obj --time -1
refuses 2 'no level and no eye' export torus.limn -o new.obj
refuses 2 'no output' export torus.limn --level 2
refuses 2 'one .limn file' export --level 2 -o new.obj
refuses 2 'one .limn file' export torus.limn sail.limn --level 2 -o new.obj
for level in 5 -1 1x x '' 4.1 nan inf ' 1' 1,5 4294967296 18446744073709551617; do
    refuses 2 "--level '$level': not a level" export torus.limn "--level=$level" -o new.obj
done
for name in new new.stl .obj new.obj.gz new.OBJ ''; do
    refuses 2 'must end in .obj or .ply' export torus.limn --level 1 -o "$name"
done
refuses 2 'see limn export --help' export torus.limn --level 1 -o new.obj --frob
refuses 1 'no_folder/new.obj: cannot ' export torus.limn --level 1 -o no_folder/new.obj
mkdir folder.obj
refuses 1 'folder.obj: cannot write: Is a directory' export torus.limn --level 1 -o folder.obj
if [ -c /dev/full ]; then
    ln -s /dev/full full.ply
    refuses 1 'full.ply: cannot write: No space' export torus.limn --level 4 -o full.ply
fi
echo old >kept/old.obj
refuses 1 'short.limn: ' export short.limn --level 1 -o kept/old.obj
expect "the older file" "$(cat kept/old.obj)" old

# ---- export of frames

# closed EULER OPTION...: a frame of frame.limn is a closed surface with that Euler characteristic,
# V - F / 2, and uses all its vertices.
closed() {
    euler=$1
    shift
    works export frame.limn --weld -o frame.obj "$@"
    read -r vertices faces open <<END
$(obj_counts frame.obj)
END
    expect "open edges of a frame $*" "$open" 0
    expect "Euler characteristic of a frame $*" $((vertices - faces / 2)) "$euler"
    used=$(awk '$1 == "f" { used[$2] = used[$3] = used[$4] = 1 } END { for (v in used) n++; print n }' frame.obj)
    expect "used vertices of a frame $*" "$used" "$vertices"
}

# faces_of OPTION...: how many triangles a frame of frame.limn has.
faces_of() {
    works export frame.limn -o frame.obj "$@"
    grep -c '^f ' frame.obj
}

works bake -q "$assets/imp.obj" -o frame.limn
near="--eye 0.5,1.8,2 --target 0,1.6,0"
closed 2 $near --tolerance 60
closed 2 $near --lod error --tolerance 4
closed 2 $near --tolerance 8 --no-morph --up 1,1,0 --fov 120 --viewport 320x240
closed 2 $near --budget 6000 --bias 0.4 --min-level 0.5 --max-level 2.5
works export frame.limn --level 2 --no-morph --weld -o whole.obj
works export frame.limn --level 1.25 --no-morph --weld -o frame.obj
cmp whole.obj frame.obj || fail "--no-morph does not round up"
works export frame.limn --level 1.25 --weld -o frame.obj
cmp -s whole.obj frame.obj && fail "a level between whole numbers does not morph"
works export frame.limn --level 2 --weld -o frame.obj
cmp whole.obj frame.obj || fail "a whole level morphs"
works export frame.limn $near --lod uniform --level=2 --weld -o frame.obj
cmp whole.obj frame.obj || fail "an eye changes a uniform frame"
works export frame.limn $near --max-level 0 --weld -o frame.obj
expect "--max-level 0" "$(obj_counts frame.obj)" "342 680 0"

near="$near --tolerance 50"
all=$(faces_of $near)
[ "$(faces_of $near --cull)" -lt "$all" ] || fail "--cull leaves nothing out"
[ "$(faces_of $near --tolerance 40)" -gt "$all" ] || fail "--tolerance does nothing"
[ "$(faces_of $near --viewport 320x180)" -lt "$all" ] || fail "--viewport does nothing"
[ "$(faces_of $near --fov 120)" -lt "$all" ] || fail "--fov does nothing"
[ "$(faces_of $near --bias -1)" -lt "$all" ] || fail "--bias does nothing"
expect "straight down" "$(faces_of --eye 0,9,0 --target 0,0,0 --level 0 --cull)" 680
notes 'imp: nothing of it is in view' export frame.limn --eye 0,0,5 --target 0,0,9 --cull -o frame.obj
expect "an empty frame" "$(obj_counts frame.obj)" "0 0 0"
notes '2040 vertices, more than --budget 2' export frame.limn $near --budget 2 -o frame.ply

if [ -n "${LIMN_TEST_ASSETS:-}" ] && [ -f "$LIMN_TEST_ASSETS/meshes/bigguyT.obj" ]; then
    works bake -q "$LIMN_TEST_ASSETS/meshes/bigguyT.obj" -o frame.limn
    works export frame.limn --level 0 --weld -o frame.obj
    euler=$(obj_counts frame.obj | awk '{ print $1 - $2 / 2 }')
    closed "$euler" --eye 5,10,20 --tolerance 40
fi

# wrong PATTERN OPTION...: status 2; unseen PATTERN OPTION...: status 1, as it depends on the mesh.
wrong() {
    pattern=$1
    shift
    refuses 2 "$pattern" export torus.limn -o new.obj "$@"
}
unseen() {
    pattern=$1
    shift
    refuses 1 "$pattern" export torus.limn -o new.obj "$@"
}
for point in '' 1,2 1,2,3,4 1,2,x nan,0,0 0,0,1e99 '1, 2,3'; do
    wrong "--eye '$point': not a point" "--eye=$point"
done
for number in '' nan inf -1 0 180 45deg; do
    wrong "--fov '$number': not an angle" --eye 1,2,3 "--fov=$number"
done
for pixels in 10 10x0 -1x10 70000x10 1x1x1; do
    wrong "--viewport '$pixels': not WIDTHxHEIGHT" --eye 1,2,3 "--viewport=$pixels"
done
wrong "--target '1,2': not a point" --eye 1,2,3 --target 1,2
wrong "--up 'y': not a direction" --eye 1,2,3 --up y
wrong "--near '0': not a distance" --eye 1,2,3 --near 0
wrong "--far '-1': not a distance" --eye 1,2,3 --far=-1
wrong "--tolerance '0': not " --eye 1,2,3 --tolerance 0
wrong "--budget '0': not a number of vertices" --level 1 --budget 0
wrong "--budget '4294967296': not a number of vertices" --level 1 --budget 4294967296
wrong "--bias 'nan': not a number" --level 1 --bias nan
wrong "--min-level '-1': not a level" --level 1 --min-level=-1
wrong "--max-level '5': not a level" --level 1 --max-level 5
wrong "--lod 'far': not length, error or uniform" --eye 1,2,3 --lod far
wrong '--lod length: contradicts --level' --eye 1,2,3 --lod length --level 1
wrong '--lod error: contradicts --level' --eye 1,2,3 --lod error --level 1
wrong '--lod uniform: there is no --level' --eye 1,2,3 --lod uniform
wrong '--tolerance: contradicts --level' --eye 1,2,3 --tolerance 2 --level 1
wrong '--min-level 3: is above --max-level 2' --eye 1,2,3 --min-level 3 --max-level 2
for option in target=1,2,3 up=0,1,0 fov=45 viewport=9x9 near=1 far=1 cull; do
    wrong "--${option%%=*}: there is no --eye" --level 1 "--$option"
done
unseen '--eye 1,2,3: is the target too' --eye 1,2,3 --target 1,2,3
unseen '--up 0,2,0: is not across the line of sight' --eye 0,9,0 --target 0,0,0 --up 0,2,0
unseen '--up 0,0,0: is not across the line of sight' --eye 0,9,0 --up 0,0,0
unseen '--near 1e+09: is not nearer than the far plane' --eye 1,2,3 --near 1e9
unseen '--near 3: is not nearer than the far plane, 2' --eye 1,2,3 --near 3 --far 2
unseen '--eye 1e+38,0,0: floats cannot tell' --eye 1e38,0,0

# ---- verify

# verified ARGUMENT...: passes, and the numbers are those of float arithmetic.
verified() {
    works verify "$@"
    largest=$(sed -n 's/.*largest \([^ ]*\) .*/\1/p' stdout.txt)
    mean=$(sed -n 's/.*mean \(.*\); tolerance .*/\1/p' stdout.txt)
    awk -v largest="$largest" -v mean="$mean" \
        'BEGIN { exit !(mean > 0 && mean <= largest && largest > 1e-9 && largest <= 3e-7) }' ||
        fail "verify $*: largest '$largest', mean '$mean'"
}

if "$limn" verify torus.limn --against "$torus" 2>&1 | grep -q 'built without OpenSubdiv'; then
    echo "built without OpenSubdiv: verify is not tested"
else
    # Far from the origin, where floats are 1/16 apart and the mesh is 3 wide.
    awk '/^v / { $2 += 1e6 } { print }' "$torus" >away.obj
    works bake -q away.obj -o away.limn
    notes 'away: so far from the origin, floats cannot hold the mesh to better than 0.0[0-9]* of its diagonal' \
        verify away.limn --against away.obj
    says stdout '; tolerance 0.0[0-9]*$'
    # The corners of a large polygon have equal weights, and all of the upper one is as far from the first point.
    awk 'BEGIN {
        for (k = 0; k < 400; k++) print "v", cos(3.14159265 * k / 100), sin(3.14159265 * k / 100), (k >= 200)
        for (k = 0; k < 200; k++) print "f", k + 1, (k + 1) % 200 + 1, (k + 1) % 200 + 201, k + 201
        printf "f"; for (k = 200; k > 0; k--) printf " %d", k; print ""
        printf "f"; for (k = 201; k <= 400; k++) printf " %d", k; print ""
    }' >prism.obj
    for isolate in 0 1; do
        works bake -q prism.obj -o prism.limn --scheme catmark --isolate $isolate
        works verify prism.limn --against prism.obj --tolerance 3e-7
    done
    refuses 1 'baked with --scheme none' verify flat.limn --against "$sail"
    verified torus.limn --against "$torus"
    verified --against "$sail" sail.limn
    verified --against "$sail" corner.limn
    verified cube.limn --against "$cube"
    verified several.limn --against "$cube" --mesh 2
    verified several.limn --against "$torus" --mesh=3 --tolerance 1e-3
    verified loose.limn --against loose.obj --repair=weld
    refuses 1 'loose.obj: non-manifold vertex' verify loose.limn --against loose.obj
    verified split.limn --against edge.obj --non-manifold split
    verified vertex.limn --against vertex.obj --non-manifold split
    verified winding.limn --against winding.obj --non-manifold split
    # Three pages of a book, with creases that end at its spine.
    awk '
        BEGIN {
            for (p = 0; p < 3; p++)
                for (w = 0; w < 3; w++)
                    for (v = 0; v < 6; v++)
                        if (p == 0 || w > 0) {
                            number[p, w, v] = ++count
                            print "v", 0.1 * v * v + w * cos(2 * p + 0.1 * v), w * sin(2 * p + 0.1 * v), v + 0.1 * w * p
                        } else number[p, w, v] = number[0, 0, v]
            for (p = 0; p < 3; p++)
                for (w = 0; w < 2; w++)
                    for (v = 0; v < 5; v++)
                        print "f", number[p, w, v], number[p, w + 1, v], number[p, w + 1, v + 1], number[p, w, v + 1]
            print "t crease 2/1/0", number[1, 1, 2] - 1, number[1, 0, 2] - 1, 10
            print "t crease 2/1/0", number[2, 1, 1] - 1, number[2, 1, 2] - 1, 1.5
            print "t crease 2/1/0", number[2, 1, 4] - 1, number[2, 1, 3] - 1, 0.4
            print "t corner 1/1/0", number[0, 0, 3] - 1, 2.3
        }
    ' >book.obj
    for options in '' '--boundary edge-and-corner' '--boundary none' '--creasing chaikin'; do
        # shellcheck disable=SC2086
        works bake -q book.obj -o book.limn --non-manifold split $options
        verified book.limn --against book.obj --non-manifold split
    done
    refuses 1 'edge.obj: non-manifold edge' verify split.limn --against edge.obj
    refuses 2 'cannot .weld. what is not' verify split.limn --against edge.obj --non-manifold weld
    refuses 1 'baked from something else' verify torus.limn --against "$sail"
    refuses 1 'baked from something else' verify several.limn --against "$cube" --mesh 1
    awk '/^v / && !done { $2 += 0.001; done = 1 } { print }' "$torus" >moved.obj
    refuses 1 'baked from something else' verify torus.limn --against moved.obj
    sed 's/^f \([0-9]*\) \([0-9]*\) \([0-9]*\)$/f \1 \3 \2/' "$torus" >turned.obj
    last="verify turned"
    run 1 verify torus.limn --against turned.obj
    says stderr ' '
    last="verify --tolerance 0"
    run 1 verify torus.limn --against "$torus" --tolerance 0
    says stdout 'largest '
    says stderr 'largest difference is above 0'
    refuses 1 'warren weights' verify warren.limn --against "$sail"
    run 0 bake -q "$sail" -o lomont.limn --creases lomont
    refuses 1 "Lomont's rules" verify lomont.limn --against "$sail"
    run 0 bake -q "$torus" -o lomont.limn --creases lomont
    run 0 verify lomont.limn --against "$torus"
    refuses 1 'there is no mesh 4; the file has 4' verify several.limn --against "$torus" --mesh 4
    refuses 1 'missing.obj: cannot be read' verify torus.limn --against missing.obj
    refuses 1 'edge.obj: non-manifold edge' verify torus.limn --against edge.obj
    refuses 1 'short.limn: the blob is shorter' verify short.limn --against "$torus"
    refuses 2 'no mesh' verify torus.limn
    refuses 2 'one .limn file' verify --against "$torus"
    refuses 2 'see limn verify --help' verify torus.limn --against "$torus" --frob
    for number in -1 x '' 4294967296; do
        refuses 2 'not the number of a mesh' verify torus.limn --against "$torus" "--mesh=$number"
    done
    for number in -1 x '' nan inf 1e-7x; do
        refuses 2 'not a tolerance' verify torus.limn --against "$torus" "--tolerance=$number"
    done
    refuses 2 'cannot repair' verify torus.limn --against "$torus" --repair=frob
fi

if [ -s failures.txt ]; then
    echo "$(grep -c '' failures.txt) failures; see $folder" >&2
    exit 1
fi
cd / && rm -rf "$folder"
