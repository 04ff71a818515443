# Installs the build, moves what was installed, since its place may not matter, and uses it: the programs beside each
# other, and the library by an example, whose mesh is checked.
#   cmake -DBUILD=FOLDER -DSOURCE=FOLDER -DWORK=FOLDER -DPYTHON=PROGRAM -P installed.cmake
cmake_minimum_required(VERSION 3.25)

function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ECHO STDOUT COMMAND_ERROR_IS_FATAL ANY)
endfunction()

file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}/out")
set(ENV{XDG_CACHE_HOME} "${WORK}/cache")
run(${CMAKE_COMMAND} --install "${BUILD}" --prefix "${WORK}/first")
set(prefix "${WORK}/a place & more")
file(RENAME "${WORK}/first" "${prefix}")

execute_process(COMMAND "${prefix}/bin/fluidtex" doctor OUTPUT_VARIABLE doctor COMMAND_ERROR_IS_FATAL ANY)
message("${doctor}")
string(FIND "${doctor}" "${prefix}/share/fluidtex/blender\n" scripts)
if(scripts EQUAL -1)
  message(FATAL_ERROR "What Blender runs is not taken from where it was installed.")
endif()
run("${prefix}/bin/fluidtex" check "${prefix}/share/fluidtex/scenes/dam_break.toml")
foreach(file man/man1/fluidtex.1 bash-completion/completions/fluidtex zsh/site-functions/_fluidtex
    fish/vendor_completions.d/fluidtex.fish)
  file(SIZE "${prefix}/share/${file}" size)
  if(size LESS 500)
    message(FATAL_ERROR "${file} has ${size} bytes.")
  endif()
endforeach()

run(${CMAKE_COMMAND} -S "${SOURCE}/examples" -B "${WORK}/examples" -G Ninja "-DCMAKE_PREFIX_PATH=${prefix}")
run(${CMAKE_COMMAND} --build "${WORK}/examples")
# The reader that it starts is the one that was installed: this one leaves a trace.
file(RENAME "${prefix}/bin/fluidtex_reader" "${prefix}/bin/reader")
file(WRITE "${prefix}/bin/fluidtex_reader" "#!/bin/sh\ntouch '${WORK}/asked'\nexec '${prefix}/bin/reader'\n")
file(CHMOD "${prefix}/bin/fluidtex_reader" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
run("${WORK}/examples/texture_a_surface" "${prefix}/share/fluidtex/scenes/exemplars/green_scales.png" 3 "${WORK}/out")
if(NOT EXISTS "${WORK}/asked")
  message(FATAL_ERROR "The example has asked another fluidtex_reader than the installed one.")
endif()
run("${PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/check_drop.py" "${WORK}/out")
file(REMOVE_RECURSE "${WORK}")
