#!/bin/sh
# SPDX-License-Identifier: MIT
# The pictures of light in docs/mathematics.md. The target docs-pictures runs it.
#   sh draw_light.sh LIMN LIMN_VIEW MESH.obj OUT_FOLDER
set -eu
limn=$1 view=$2 mesh=$3 out=$4
baked=$(mktemp)
trap 'rm -f "$baked"' EXIT
"$limn" bake -q --normals exact "$mesh" -o "$baked"
for how in base interpolated exact; do
    "$view" "$baked" --png "$out/light_$how.png" --light $how --level 4 --wireframe \
        --spot 0.3,2,2.2 --spot-target 0.35,0.2,0.8 --spot-cone 6 \
        --eye 1.3,1.7,2.1 --fov 32 --viewport 280x230
done
