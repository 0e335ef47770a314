# The committed files must be what their generator writes.
foreach(domain triangle quad)
    set(committed_file ${RUNTIME}/domain_${domain}.c)
    execute_process(COMMAND ${GENERATOR} ${domain} OUTPUT_VARIABLE generated COMMAND_ERROR_IS_FATAL ANY)
    file(READ ${committed_file} committed)
    if(NOT generated STREQUAL committed)
        message(FATAL_ERROR "${committed_file} is not what ${GENERATOR} ${domain} writes")
    endif()
endforeach()
