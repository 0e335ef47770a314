#!/bin/sh
# SPDX-License-Identifier: MIT
# A library exports the functions of its list, and what is shared between its files as limni_…; no other name may clash
# with a program's. Templates of C++, which are weak, do not count.
#
# usage: symbols_test.sh LIBRARY LIST
# Exit status 77: there is no nm.
set -u
command -v nm >/dev/null || exit 77
list=$2
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

nm -g --defined-only "$1" | awk 'NF == 3 && $2 ~ /^[A-TX-Z]$/ && $3 !~ /^limni_/ { print $3 }' | LC_ALL=C sort >"$work/exported"
grep '^limn' "$list" | LC_ALL=C sort | diff - "$work/exported" && exit 0
echo "$1 does not export what $list says (<: only in the list; >: only in the library)" >&2
exit 1
