# The meshes in assets/ are what their generator writes, byte for byte.
#
#   cmake -DGENERATOR=<generate_meshes> -DASSETS=<assets/> -DWORK=<a folder of its own> -P assets_test.cmake

foreach(argument GENERATOR ASSETS WORK)
    if(NOT ${argument})
        message(FATAL_ERROR "-D${argument}=... is missing")
    endif()
endforeach()

file(MAKE_DIRECTORY ${WORK})
file(GLOB stale ${WORK}/*.obj ${WORK}/*.off ${WORK}/*.gltf ${WORK}/*.part)
if(stale)
    file(REMOVE ${stale})
endif()
execute_process(COMMAND ${GENERATOR} ${WORK} RESULT_VARIABLE result)
if(NOT result EQUAL 0)
    message(FATAL_ERROR "${GENERATOR} failed: ${result}")
endif()

file(GLOB committed RELATIVE ${ASSETS} ${ASSETS}/*.obj ${ASSETS}/*.off ${ASSETS}/*.gltf)
file(GLOB generated RELATIVE ${WORK} ${WORK}/*)
if(NOT committed STREQUAL generated)
    message(FATAL_ERROR "committed: ${committed}\ngenerated: ${generated}")
endif()
foreach(name IN LISTS generated)
    file(SHA256 ${ASSETS}/${name} committed_hash)
    file(SHA256 ${WORK}/${name} generated_hash)
    if(NOT committed_hash STREQUAL generated_hash)
        message(FATAL_ERROR "${name} differs from what the generator writes: build generate-assets and commit")
    endif()
endforeach()

# A folder that is not there is an error, not a silence.
execute_process(COMMAND ${GENERATOR} ${WORK}/absent RESULT_VARIABLE result ERROR_QUIET OUTPUT_QUIET)
if(result EQUAL 0)
    message(FATAL_ERROR "writing into a folder that is not there succeeded")
endif()
message(STATUS "${generated}: as generated")
