#!/bin/sh
# SPDX-License-Identifier: MIT
# Characters from glTF: two meshes, a skeleton, a clip and a material.
#
# usage: see cli.sh
. "$(dirname "$0")/cli.sh"

cp "$corpus/gltf/character.glb" character.glb
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

# A moment of a clip. Names of clips are made different.
notes "there is a clip 'animation 0' already: this one is 'animation 0 2'" bake "$corpus/gltf/character.gltf" "$corpus/gltf/character.gltf" -o two.limn
works export two.limn --level 1 -o later.obj --clip 'animation 0 2'
works bake -q "$corpus/gltf/character.gltf" -o character.limn
works export character.limn --level 1 -o bind.obj
works export character.limn --level 1 -o start.obj --clip 'animation 0'
works export character.limn --level 1 -o later.obj --clip 'animation 0' --time 0.5
cmp -s bind.obj later.obj && fail "export --clip: nothing moves"
cmp -s start.obj later.obj && fail "export --time: nothing moves"
refuses 1 "clip 'walk': the file has animation 0" export character.limn --level 1 -o new.obj --clip walk

# Channels count, of which this one has most of the classes.
notes 'imp: isolated: 0\.1[0-9] times the bytes' bake "$assets/imp.gltf" -o imp.limn --isolate auto
finish
