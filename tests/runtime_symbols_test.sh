#!/bin/sh
# SPDX-License-Identifier: MIT
# The optimised runtime calls nothing but mathematics and what moves memory: so it allocates nothing, waits for nothing
# and asks the system nothing, in any frame.
#
# usage: runtime_symbols_test.sh LIBRARY
# Exit status 77: there is no nm.
set -u
command -v nm >/dev/null || exit 77
allowed='^(limn|mem(cpy|move|set|cmp)$|str(cmp|len)$|(acos|sin|cos|tan|sqrt|exp2|fmod|fmin|fmax)f?$|_GLOBAL_OFFSET_TABLE_$|__stack_chk_fail$)'
nm -u "$1" | awk '$1 == "U" { print $2 }' | sort -u >runtime_symbols.txt
[ "$(wc -l <runtime_symbols.txt)" -gt 5 ] || exit 1
! grep -Ev "$allowed" runtime_symbols.txt
