# What the program prints of itself for man and shells, at their places. Run when it is installed, with `program` and
# `share` set.
function(install_printed file)
  set(file ${share}/${file})
  get_filename_component(folder ${file} DIRECTORY)
  file(MAKE_DIRECTORY ${folder})
  message(STATUS "Installing: ${file}")
  execute_process(COMMAND ${program} ${ARGN} OUTPUT_FILE ${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()

install_printed(man/man1/fluidtex.1 man)
install_printed(bash-completion/completions/fluidtex completion bash)
install_printed(zsh/site-functions/_fluidtex completion zsh)
install_printed(fish/vendor_completions.d/fluidtex.fish completion fish)
