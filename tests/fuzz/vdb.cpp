// A volume of floats.
#include "pipeline/read_grid.h"
#include "tests/fuzz/reader.h"

using namespace fluidtex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bool once = (openvdb::initialize(), true);
  const auto file = fuzz::written("a.vdb", data, size);
  return fuzz::outcomeFromAfar<std::runtime_error>([&] {
    const openvdb::FloatGrid::Ptr grid = once ? pipeline::readGrid<openvdb::FloatGrid>(file) : nullptr;
    return fuzz::magnitude(double(grid->activeVoxelCount())) + fuzz::magnitude(grid->tree().leafCount());
  });
}
