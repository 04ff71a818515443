// The surface that a run goes on from.
#include "tools/run_folder/state.h"
#include "tests/fuzz/reader.h"

using namespace fluidtex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto file = fuzz::written("surface.bin", data, size);
  return fuzz::outcomeOf<std::runtime_error>([&] { tools::readSurface(file); });
}
