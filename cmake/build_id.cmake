# Writes OUTPUT, the definition of texture::buildId(), from the contents of SOURCES (a folder) and from SETTINGS; leaves
# it alone where it would stay the same. Run when the room is built: cmake -D... -P build_id.cmake
file(GLOB_RECURSE files RELATIVE "${SOURCES}" "${SOURCES}/*.h" "${SOURCES}/*.cpp")
list(SORT files)
set(text "${SETTINGS}")
foreach(file ${files})
  file(SHA256 "${SOURCES}/${file}" hash)
  string(APPEND text " ${file} ${hash}")
endforeach()
string(SHA256 id "${text}")
set(code "// Made by cmake/build_id.cmake.
#include \"texture/exemplar/build_id.h\"

std::string_view fluidtex::texture::buildId() {
  return \"${id}\";
}
")
if(EXISTS "${OUTPUT}")
  file(READ "${OUTPUT}" before)
endif()
if(NOT "${code}" STREQUAL "${before}")
  file(WRITE "${OUTPUT}" "${code}")
endif()
