# find_package(facetmill) finds this file where facetmill is installed. It gives the executable as the target
# facetmill::facetmill, and facetmill_add_assets.
include("${CMAKE_CURRENT_LIST_DIR}/facetmillTargets.cmake")

#[[
facetmill_add_assets(TARGET
                     PIPELINE pipeline            a YAML file, or the name of a built-in pipeline
                     INPUTS file...               the pipeline is run for each of them
                     [INPUT_PARAM name]           the param that takes the input (default: input)
                     [PARAMS name=value...]       other params, the same for all inputs; paths absolute
                     [OUTPUT_DIR folder]          default: the current binary directory
                     [BASE folder]                outputs keep the folders that their inputs have below it
                     [THREADS count]              of each run (default: all cores)
                     [DESTINATION folder])        where `install` puts the outputs

Adds the target TARGET, part of `all`, that brings the outputs of all inputs up to date. `facetmill plan` lists the
outputs of a run when CMake configures, and again when the pipeline file changes; the files that a run reads besides its
input (textures, buffers, baselines) are known from a depfile after the first run. The executable is also a dependency:
another release processes the assets again. For a pipeline that writes nothing (a check), a stamp file is written when it
passes. The outputs of all inputs are in the variable TARGET_OUTPUTS afterwards.

File names with ; [ ] " \ | : or $( are refused, because CMake or Make cannot handle them. For names with
# $ & ' * ? < > ^ ` or %, a stamp file takes the place of the outputs, and the dependencies are those that
`facetmill plan --inputs` lists when CMake configures.
]]
function(facetmill_add_assets target)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "PIPELINE;INPUT_PARAM;OUTPUT_DIR;BASE;THREADS;DESTINATION" "INPUTS;PARAMS")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "facetmill_add_assets(${target}): not known: ${arg_UNPARSED_ARGUMENTS}")
  endif()
  foreach(needed PIPELINE INPUTS)
    if(NOT arg_${needed})
      message(FATAL_ERROR "facetmill_add_assets(${target}): ${needed} is missing")
    endif()
  endforeach()
  foreach(given IN LISTS arg_INPUTS arg_PARAMS) # a misspelled keyword ends up in a list
    if(given MATCHES "^[A-Z_]+$" AND NOT EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/${given}")
      message(FATAL_ERROR "facetmill_add_assets(${target}): ${given} is neither a keyword nor a file")
    endif()
  endforeach()
  if(NOT arg_INPUT_PARAM)
    set(arg_INPUT_PARAM input)
  endif()
  if(NOT arg_OUTPUT_DIR)
    set(arg_OUTPUT_DIR .)
  endif()
  get_filename_component(output_dir "${arg_OUTPUT_DIR}" ABSOLUTE BASE_DIR "${CMAKE_CURRENT_BINARY_DIR}")
  get_target_property(facetmill facetmill::facetmill LOCATION)

  # A name that is no file is that of a ready pipeline.
  get_filename_component(pipeline "${arg_PIPELINE}" ABSOLUTE)
  set(depends "${facetmill}")
  if(EXISTS "${pipeline}")
    list(APPEND depends "${pipeline}")
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${pipeline}")
  else()
    set(pipeline "${arg_PIPELINE}")
  endif()
  set(options)
  foreach(param IN LISTS arg_PARAMS)
    list(APPEND options -D "${param}")
  endforeach()
  set(threads)
  if(arg_THREADS)
    set(threads --threads "${arg_THREADS}")
  endif()

  set(all)
  set(made_by_all)
  list(REMOVE_DUPLICATES arg_INPUTS)
  foreach(given IN LISTS arg_INPUTS)
    get_filename_component(input "${given}" ABSOLUTE)
    set(folder)
    if(arg_BASE)
      get_filename_component(base "${arg_BASE}" ABSOLUTE)
      file(RELATIVE_PATH folder "${base}" "${input}")
      if(folder MATCHES "^\\.\\./")
        message(FATAL_ERROR "facetmill_add_assets(${target}): ${given} is not below BASE ${arg_BASE}")
      endif()
      get_filename_component(folder "${folder}" DIRECTORY)
    endif()
    set(into "${output_dir}")
    if(folder)
      set(into "${output_dir}/${folder}")
    endif()
    set(run "${pipeline}" -D "${arg_INPUT_PARAM}=${input}" ${options} --output-dir "${into}")
    facetmill_planned(inputs outputs "${target}" "${given}" ${run})
    # The name must not depend on other inputs: it is in the command line, so a new one would run all again.
    string(SHA256 key "${input}")
    string(SUBSTRING "${key}" 0 16 key)
    set(stem "${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${target}.facetmill/${key}")
    set(stamp)
    set(odd "[#$&'*?<>^`%]")
    set(made "${outputs}")
    if(NOT outputs OR "${outputs}" MATCHES "${odd}")
      set(made "${stem}.made")
      set(stamp COMMAND ${CMAKE_COMMAND} -E touch "${made}")
    endif()
    list(GET made 0 first)
    # Ninja does not understand all names in a depfile.
    set(depfile DEPFILE "${stem}.d")
    set(write_depfile --depfile "${stem}.d" --depfile-target "${first}")
    if("${inputs}" MATCHES "${odd}")
      set(depfile DEPENDS ${inputs})
      set(write_depfile)
    endif()
    foreach(output IN LISTS outputs)
      if(output IN_LIST all)
        message(FATAL_ERROR "facetmill_add_assets(${target}): ${output} would be written for ${given} and for an input "
                            "before it. Name it after its input in the pipeline (\${${arg_INPUT_PARAM}.stem}), or say "
                            "BASE to keep the folders of the inputs.")
      endif()
      list(APPEND all "${output}")
    endforeach()
    list(APPEND made_by_all ${made})
    file(MAKE_DIRECTORY "${into}" "${CMAKE_CURRENT_BINARY_DIR}/CMakeFiles/${target}.facetmill")
    add_custom_command(OUTPUT ${made}
      COMMAND "${facetmill}" run ${run} ${threads} ${write_depfile} --quiet
      ${stamp}
      DEPENDS "${input}" ${depends}
      ${depfile}
      COMMENT "Processing ${given}"
      VERBATIM)
    if(arg_DESTINATION AND outputs)
      install(FILES ${outputs} DESTINATION "${arg_DESTINATION}/${folder}")
    endif()
  endforeach()
  add_custom_target(${target} ALL DEPENDS ${made_by_all})
  set(${target}_OUTPUTS ${all} PARENT_SCOPE)
endfunction()

# The files that a run reads and those that it writes, as absolute paths. The rest: the arguments of the run.
function(facetmill_planned reads writes target given)
  get_target_property(facetmill facetmill::facetmill LOCATION)
  execute_process(COMMAND "${facetmill}" plan ${ARGN} --inputs --outputs
    RESULT_VARIABLE failed OUTPUT_VARIABLE planned ERROR_VARIABLE said WORKING_DIRECTORY "${CMAKE_CURRENT_BINARY_DIR}")
  if(failed)
    message(FATAL_ERROR "facetmill_add_assets(${target}): ${given} cannot be planned:\n${said}")
  endif()
  if("${given}${planned}" MATCHES "[][;\"\\|:]|\\$\\(")
    message(FATAL_ERROR "facetmill_add_assets(${target}): ${given}: CMake or Make cannot work with ; [ ] \" \\ | : or $( "
                        "in names of files")
  endif()
  string(FIND "\n${planned}" "\n\n" between) # inputs, an empty line, outputs
  string(SUBSTRING "${planned}" 0 ${between} inputs)
  string(SUBSTRING "${planned}" ${between} -1 outputs)
  foreach(kind inputs outputs)
    string(STRIP "${${kind}}" ${kind})
    string(REPLACE "\n" ";" ${kind} "${${kind}}")
  endforeach()
  set(${reads} "${inputs}" PARENT_SCOPE)
  set(${writes} "${outputs}" PARENT_SCOPE)
endfunction()
