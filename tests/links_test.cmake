# SPDX-License-Identifier: MIT
# Every link from a page of the documentation to another, or to a file, must lead to something.
#   cmake -DSOURCE_DIR=<the repository> -P links_test.cmake
cmake_minimum_required(VERSION 3.25)

# A page without what CMake takes for a list or for the end of one.
function(read_page path result)
    file(READ "${path}" text)
    string(REPLACE "](" "\n@link " text "${text}")
    string(REGEX REPLACE "[][;\\]" "" text "${text}")
    set(${result} "\n${text}" PARENT_SCOPE)
endfunction()

# The anchors of a page's headings, as GitHub makes them.
function(find_anchors path result)
    read_page("${path}" text)
    string(TOLOWER "${text}" text)
    string(REGEX MATCHALL "\n#+ [^\n]*" headings "${text}")
    list(TRANSFORM headings REPLACE "\n#+ " "")
    list(TRANSFORM headings REPLACE "[^-a-z0-9_ ]" "")
    list(TRANSFORM headings REPLACE " " "-")
    set(${result} "${headings}" PARENT_SCOPE)
endfunction()

function(check_link page link)
    string(REGEX MATCH "^([^#]*)#?(.*)$" _ "${link}")
    set(file "${CMAKE_MATCH_1}")
    set(anchor "${CMAKE_MATCH_2}")
    cmake_path(GET page PARENT_PATH folder)
    set(target "${page}")
    if(file)
        set(target "${folder}/${file}")
    endif()
    if(NOT EXISTS "${target}")
        message(SEND_ERROR "${page}: there is no ${link}")
    elseif(anchor)
        find_anchors("${target}" anchors)
        if(NOT anchor IN_LIST anchors)
            message(SEND_ERROR "${page}: ${link} has no such heading")
        endif()
    endif()
endfunction()

file(GLOB pages "${SOURCE_DIR}/*.md" "${SOURCE_DIR}/docs/*.md")
foreach(page IN LISTS pages)
    read_page("${page}" text)
    string(REGEX MATCHALL "\n@link [^)]*" links "${text}")
    list(TRANSFORM links REPLACE "\n@link " "")
    foreach(link IN LISTS links)
        if(NOT link MATCHES "^https?:|\\.html$") # Doxygen makes .html
            check_link("${page}" "${link}")
        endif()
    endforeach()
endforeach()
