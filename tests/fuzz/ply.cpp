// The surface of a finished run.
#include "tools/formats/ply.h"
#include "tests/fuzz/reader.h"
#include "tools/base/errors.h"
#include "tools/formats/read_ply.h"

using namespace fluidtex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::written("0001.ply", data, size);
  return fuzz::outcomeOf<tools::UsageError>([&] { tools::readPly(file, 64, 64); });
}
