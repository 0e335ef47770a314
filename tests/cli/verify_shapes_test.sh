#!/bin/sh
# SPDX-License-Identifier: MIT
# limn verify, of shapes that take OpenSubdiv long: very large polygons, and sheets with creases.
#
# usage: see cli.sh
. "$(dirname "$0")/cli.sh"
works bake -q "$torus" -o torus.limn
skip_without_opensubdiv

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

finish
