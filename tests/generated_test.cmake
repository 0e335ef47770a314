# The committed file must be what its generator writes.
execute_process(COMMAND ${GENERATOR} OUTPUT_VARIABLE generated COMMAND_ERROR_IS_FATAL ANY)
file(READ ${COMMITTED} committed)
if(NOT generated STREQUAL committed)
    message(FATAL_ERROR "${COMMITTED} is not what ${GENERATOR} writes")
endif()
