#!/bin/sh
# SPDX-License-Identifier: MIT
# Manual pages are well-formed, and help2man found in --help what it looks for.
#   sh manuals_test.sh MANDOC PAGE...
set -eu
mandoc=$1
shift
"$mandoc" -T lint -W warning "$@"
for page in "$@"; do
    name=$(basename "$page" .1)
    grep -q "^$name .- [A-Za-z]..*" "$page" || { echo "$page: no summary"; exit 1; }
    for section in SYNOPSIS DESCRIPTION 'SEE ALSO'; do
        grep -qx "\.SH \"*$section\"*" "$page" || { echo "$page: no $section"; exit 1; }
    done
    if grep -iE '^(usage|options|examples):' "$page"; then echo "$page: not a section"; exit 1; fi
done
