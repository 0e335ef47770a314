# The examples in the public headers are compiled: the indented lines of a header's first comment become the body of a
# function, behind `declarations`.
function(limn_example_source header declarations output)
    file(READ ${PROJECT_SOURCE_DIR}/include/limn/${header} text)
    string(REGEX MATCH "\n \\*     [^\n]*(\n \\*     [^\n]*)*" example "${text}")
    string(REPLACE "\n \*     " "\n    " example "${example}")
    if(example STREQUAL "")
        message(FATAL_ERROR "${header} has no example")
    endif()
    string(MAKE_C_IDENTIFIER "${header}" name)
    file(CONFIGURE OUTPUT ${output} CONTENT
"#include \"limn/${header}\"\n#include <stdio.h>\n#include <stdlib.h>\n${declarations}
int main(void) {\n    ${example}\n    return 0;\n}\n" @ONLY)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/include/limn/${header})
endfunction()
