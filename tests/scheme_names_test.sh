#!/bin/sh
# SPDX-License-Identifier: MIT
# The runtime knows tables, not where they come from: its sources name no subdivision scheme, nor any rule of one. Only
# the baker does.
#
#   sh scheme_names_test.sh SOURCE_FOLDER
set -eu
cd "$1"

# Prints the lines of FILE... that name a scheme. "Loop" only as a name, or in names: loops over rows are none, nor is a
# clip that starts again.
names() {
    {
        grep -rniE 'catmull|catmark|clark|butterfly|zorin|warren|lomont|chaikin|doo-?sabin|sqrt-?3|bilinear|opensubdiv' "$@" || true
        grep -rnE '(^|[^A-Za-z])Loop([^A-Za-z]|$)|LOOP|loop_|_loop' "$@" || true
    } | grep -v -e '(Lomont, "Fast$' -e LIMN_WRAP_LOOP | sort -u # Lomont published the inverse square root
}

found=$(names runtime simd include/limn/limn.h include/limn/format.h)
[ -z "$found" ] || {
    echo "$found" >&2
    exit 1
}
for name in Loop Warren Lomont Chaikin OpenSubdiv loop_; do # it would find them
    names baker include/limn/bake.h | grep -q "$name" || {
        echo "scheme_names_test.sh: $name is not found where it is" >&2
        exit 1
    }
done
