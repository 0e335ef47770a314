#!/bin/sh
# SPDX-License-Identifier: MIT
# The pictures of docs/weights.md. The target docs-pictures runs it.
#   sh draw_weights.sh LIMN LIMN_VIEW MESH.obj OUT_FOLDER
set -eu
limn=$1 view=$2 mesh=$3 out=$4
baked=$(mktemp)
trap 'rm -f "$baked"' EXIT
for weights in loop warren; do
    "$limn" bake -q "$mesh" -o "$baked" --weights $weights
    for level in 0 1 2 3 4; do
        "$view" "$baked" --png "$out/weights_${weights}_$level.png" --level $level --shade flat \
            --eye 1.3,1.7,2.1 --fov 38 --viewport 240x200
    done
done
