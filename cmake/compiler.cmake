# Flags shared by every target, as one interface target. One -march for all units: mixing them breaks Eigen.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

find_program(CCACHE_PROGRAM ccache)
if(CCACHE_PROGRAM)
  # It keeps what is compiled with precompiled headers only where it may be lax about macros and dates.
  set(CMAKE_CXX_COMPILER_LAUNCHER
    ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${CCACHE_PROGRAM})
endif()

# What programs that link the installed library take over is what the code of headers, of which the linker keeps one copy,
# must have in common.
add_library(fluidtex_flags INTERFACE)
target_compile_features(fluidtex_flags INTERFACE cxx_std_20)
target_include_directories(fluidtex_flags INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}> $<INSTALL_INTERFACE:include/fluidtex>)
target_compile_options(fluidtex_flags INTERFACE
  "$<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow>"
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>>  # g++ 12 warns falsely of "text" + std::string
  -fno-math-errno -ffp-contract=off
  # The Python module is a shared library, and takes in only such code. No other library is to put its functions in the
  # place of ours, so they may be inlined as in a program.
  -fPIC $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-fno-semantic-interposition>>
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>>  # for ccache
  $<IF:$<BOOL:${FLUIDTEX_NATIVE}>,-march=native,-march=x86-64-v3>)

find_program(MOLD_PROGRAM mold)
if(MOLD_PROGRAM)
  target_link_options(fluidtex_flags INTERFACE $<BUILD_INTERFACE:-fuse-ld=mold>)
endif()

if(FLUIDTEX_SANITIZE)
  target_compile_options(fluidtex_flags INTERFACE -fsanitize=${FLUIDTEX_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(fluidtex_flags INTERFACE -fsanitize=${FLUIDTEX_SANITIZE})
  if(FLUIDTEX_SANITIZE MATCHES "undefined")
    # What a float holds and an integer does not is undefined too, and in no group of flags.
    target_compile_options(fluidtex_flags INTERFACE -fsanitize=float-cast-overflow)
    target_compile_options(fluidtex_flags INTERFACE -fno-sanitize-recover=all)  # else it is told, and nothing fails
    # On OpenVDB's templates these four take gcc minutes a file; what they would find, the address sanitizer sees.
    target_compile_options(fluidtex_flags INTERFACE -fno-sanitize=null,alignment,vptr,object-size)
  endif()
endif()

if(FLUIDTEX_FUZZ)
  if(NOT CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
    message(FATAL_ERROR "FLUIDTEX_FUZZ needs clang, whose libFuzzer it is: cmake --preset fuzz")
  endif()
  target_compile_options(fluidtex_flags INTERFACE -fsanitize=fuzzer-no-link)
  target_compile_definitions(fluidtex_flags INTERFACE _GLIBCXX_ASSERTIONS)
  target_link_options(fluidtex_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()
