#!/bin/sh
# SPDX-License-Identifier: MIT
# The optimised runtime calls nothing but mathematics and what moves memory: so it allocates nothing, prints nothing, asks
# neither the locale nor the system, and waits for nothing, in any frame. And it has no variables: it keeps no state.
#
# usage: runtime_symbols_test.sh LIBRARY
# Exit status 77: there is no nm or no size.
set -u
command -v nm >/dev/null && command -v size >/dev/null || exit 77
allowed='^(limn|mem(cpy|move|set|cmp)$|str(cmp|len)$|(acos|sin|cos|tan|sqrt|fmod|fmin|fmax)f?$|_GLOBAL_OFFSET_TABLE_$|__stack_chk_fail$)'
nm -u "$1" | awk '$1 == "U" { print $2 }' | sort -u >runtime_symbols.txt
[ "$(wc -l <runtime_symbols.txt)" -gt 5 ] || exit 1
! grep -Ev "$allowed" runtime_symbols.txt || exit 1
# Sections that stay writable; .data.rel.ro has constants with addresses in them.
size -A "$1" | awk '$1 ~ /^\.t?(data|bss)/ && $1 !~ /^\.data\.rel\.ro/ { sections++; bytes += $2 }
    END { if (bytes) print bytes " bytes of variables"; exit sections == 0 || bytes > 0 }'
