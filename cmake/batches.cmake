# Most of what a small file takes to compile are headers, and templates that its neighbours instantiate too: the sources
# of a folder are compiled a few at a time as one. So names in them are unique within their folder, unnamed namespaces
# included. Large batches are built sooner from nothing; 6 is the most that keeps a change of one source below 15 s, as
# preset develop has it. Editors and tools that go by file want 1 (presets debug and fuzz).
set(FLUIDTEX_BATCH 24 CACHE STRING "How many sources of a folder are compiled as one file, at most")

# fluidtex_in_batches(TARGET [ALONE SOURCES...]): in the order in which the target names them. ALONE: sources that are
# compiled alone, because they take long or use a name for themselves that others in their folder have.
function(fluidtex_in_batches target)
  cmake_parse_arguments(batch "" "" "ALONE" ${ARGN})
  if(FLUIDTEX_BATCH LESS 2)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  get_target_property(sources ${target} SOURCES)
  list(FILTER sources INCLUDE REGEX "^[^$]*\\.cpp$")
  if(batch_ALONE)
    list(REMOVE_ITEM sources ${batch_ALONE})
  endif()
  set(folders)
  foreach(source ${sources})
    cmake_path(GET source PARENT_PATH folder)
    string(MAKE_C_IDENTIFIER "in_${folder}" folder)
    list(APPEND folders ${folder})
    list(APPEND ${folder} ${source})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(folder ${folders})
    list(LENGTH ${folder} count)
    math(EXPR batches "(${count} + ${FLUIDTEX_BATCH} - 1) / ${FLUIDTEX_BATCH}")
    set(number 0)
    foreach(source ${${folder}})
      math(EXPR batch "${number} * ${batches} / ${count}")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${folder}_${batch})
      math(EXPR number "${number} + 1")
    endforeach()
  endforeach()
endfunction()
