// Compiled into what links the installed library: tells it where fluidtex_reader lies. FLUIDTEX_PROGRAMS is
// defined by fluidtexConfig.cmake.
extern "C" [[gnu::weak]] const char* fluidtexPrograms() {
  return FLUIDTEX_PROGRAMS;
}
