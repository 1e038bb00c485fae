# Unity builds by room: the files of one folder are compiled together, in batches, so that a build from nothing parses
# each header few times and a change recompiles a part of one room. Rooms that would fill less than half a batch are
# compiled together with those beside them.
option(FACETMILL_UNITY "Compile the files of a room together" ON)

# rooms_in_batches(TARGET ROOT SIZE SOURCES...): batches of about SIZE bytes of source. ROOT/a/b/c.cpp is of the room a_b,
# which stands beside the room of ROOT/a/d/e.cpp.
function(rooms_in_batches target root size)
  if(NOT FACETMILL_UNITY)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  foreach(source IN LISTS ARGN)
    room_of(${source} ${root})
    math(EXPR bytes_of_${room} "0${bytes_of_${room}} + ${bytes}")
  endforeach()
  set(rooms "")
  foreach(source IN LISTS ARGN)
    room_of(${source} ${root})
    math(EXPR filled "2 * ${bytes_of_${room}}")
    if(filled LESS size)
      set(room ${outer}_small)
    endif()
    list(APPEND rooms ${room})
    math(EXPR sum_of_${room} "0${sum_of_${room}} + ${bytes}")
  endforeach()
  # As many batches as come nearest to the size asked for, of one size.
  foreach(source room IN ZIP_LISTS ARGN rooms)
    file(SIZE ${source} bytes)
    math(EXPR batches "(${sum_of_${room}} + ${size} / 2) / ${size}")
    math(EXPR middle "0${filled_${room}} + ${bytes} / 2")
    math(EXPR batch "${middle} * ${batches} / ${sum_of_${room}}")
    math(EXPR filled_${room} "0${filled_${room}} + ${bytes}")
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${room}_${batch})
  endforeach()
endfunction()

# Sets room, outer (the folder that the room stands in) and bytes of a source.
function(room_of source root)
  cmake_path(RELATIVE_PATH source BASE_DIRECTORY ${root} OUTPUT_VARIABLE name)
  cmake_path(GET name PARENT_PATH folder)
  cmake_path(GET folder PARENT_PATH parent)
  string(REPLACE "/" "_" room "${folder}")
  string(REPLACE "/" "_" outer "${parent}")
  file(SIZE ${source} bytes)
  foreach(name room outer bytes)
    set(${name} "${${name}}" PARENT_SCOPE)
  endforeach()
endfunction()
