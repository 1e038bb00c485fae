# Unity builds by room: the files of one folder are compiled together, in batches of at most FACETMILL_BATCH bytes, so
# that a build from nothing parses each header few times and a change recompiles a part of one room.
option(FACETMILL_UNITY "Compile the files of a room together" ON)
set(FACETMILL_BATCH 72000 CACHE STRING "Bytes of source in one batch of a unity build")

# rooms_in_batches(TARGET ROOT SOURCES...): ROOT/a/b/c.cpp is of the room a_b.
function(rooms_in_batches target root)
  if(NOT FACETMILL_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  foreach(source IN LISTS ARGN)
    cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${root} OUTPUT_VARIABLE name)
    cmake_path(GET name PARENT_PATH room)
    string(REPLACE "/" "_" room "${room}")
    file(SIZE ${source} bytes)
    math(EXPR filled_${room} "${filled_${room}} + 0 + ${bytes}")
    math(EXPR batch "${filled_${room}} / ${FACETMILL_BATCH}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room}_${batch})
  endforeach()
endfunction()
