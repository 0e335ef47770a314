# Settings that every target of the project shares. Nothing here is global.

add_library(limn_warnings INTERFACE)
target_compile_options(limn_warnings INTERFACE
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion
    $<$<COMPILE_LANGUAGE:C>:-Wstrict-prototypes -Wmissing-prototypes -Wvla>
    $<$<BOOL:${LIMN_WERROR}>:-Werror>)

# limn_target(<target>): the language level, the warnings, and arithmetic without fused or reordered operations, on
# which the reproducible results depend.
function(limn_target target)
    set_target_properties(${target} PROPERTIES
        C_STANDARD 11 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF
        CXX_STANDARD 17 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
    target_compile_options(${target} PRIVATE -ffp-contract=off -fno-fast-math)
    target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:limn_warnings>)
endfunction()
