# SPDX-License-Identifier: MIT
# Doxygen reads the public headers through this: the comment at the head of a file is about the file, a section is a
# group, and the lines `name  what it is` at the end of a comment are parameters. Lines keep their numbers.

FNR == 1 { in_group = in_title = in_table = 0 }
FNR == 2 && $0 == "/*" { $0 = "/** @file" }

# A section: a rule, its title, and what more is said of it.
/^\/\/ ----/ {
    if (in_group) print "/** @} */"; else print ""
    in_group = in_title = 1
    next
}
in_title == 1 {
    title = substr($0, 4)
    id = tolower(title)
    gsub(/ /, "_", id)
    print "/** @defgroup " id " " title
    in_title = 2
    next
}
in_title == 2 {
    in_title = /^\/\// ? 2 : 0
    print in_title ? substr($0, 4) : "@{ */"
    next
}

/^\/\/\/$/ { in_table = 1 }
!/^\/\/\// { in_table = 0 }
in_table && /^\/\/\/ [a-z_]+(, ?[a-z_]+)*  +[^ ]/ {
    match($0, /^\/\/\/ [a-z_]+(, ?[a-z_]+)*/)
    names = substr($0, 5, RLENGTH - 4)
    text = substr($0, RLENGTH + 1)
    gsub(/ /, "", names)
    direction = sub(/^ *out[:,]/, "", text) ? "[out]" : ""
    $0 = "/// @param" direction " " names " " text
}
{ print }

END { if (in_group) print "/** @} */" }
