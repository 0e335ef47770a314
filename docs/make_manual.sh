#!/bin/sh
# SPDX-License-Identifier: MIT
# The manual page of a program, or of one of its commands, from what it says with --help.
#   sh make_manual.sh HELP2MAN PROGRAM COMMAND OUT.1 SEE_ALSO...
# COMMAND "" stands for the program itself. The summary is the line of the program's help about the command, or the
# first sentence of the help.
set -eu
help2man=$1 program=$2 command=$3 out=$4
shift 4
name=$(basename "$program")
version=$("$program" --version)
version=${version#* }
date=$(date -u -d "@${SOURCE_DATE_EPOCH:-$(date +%s)}" +%Y-%m-%d)
if [ -n "$command" ]; then
    summary=$("$program" --help | sed -n "s/^  $command  *//p")
else
    summary=$("$program" --help | awk '/^$/ { getline; sub(/[.;]( .*)?$/, ""); print tolower(substr($0, 1, 1)) substr($0, 2); exit }')
fi
{
    echo '[see also]'
    for page in "$@"; do echo ".BR $page (1)"; done | sed '$!s/$/,/'
} >"$out.include"
"$help2man" --no-info --include="$out.include" --source="Limn $version" --name="$summary" \
    --version-string="$name${command:+-$command} $version" "$program${command:+ $command}" |
    sed -e "/^\.TH/s/\"[^\"]*\"/\"$date\"/2" -e "s/^\\\\fI$command /\\\\fB$command\\\\fR \\\\fI/" >"$out"
rm "$out.include"
