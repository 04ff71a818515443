// Geometry of other liquid programs: the first byte says of which kind the rest is.
#include "caches/formats/format_error.h"
#include "caches/formats/geometry_formats.h"
#include "tests/fuzz/reader.h"

using namespace fluidtex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const char* name = data[0] == 'b'   ? "a.bobj"
                     : data[0] == 'g' ? "a.bgeo"
                     : data[0] == 'k' ? "a.vtk"
                     : data[0] == 'p' ? "a.ply"
                                      : "a.vtp";
  return fuzz::outcomeOf<caches::FormatError>(
      [&] { caches::geometryOf(name, std::string(reinterpret_cast<const char*>(data) + 1, size - 1)); });
}
