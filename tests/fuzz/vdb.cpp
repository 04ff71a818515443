// Volumes: the first one of floats, the list of all, and those of the list by name.
#include "foreign/grid.h"
#include "pipeline/read_grid.h"
#include "tests/fuzz/reader.h"

using namespace fluidtex;

namespace {

std::string told(const openvdb::GridBase& grid) {
  return fuzz::magnitude(double(grid.activeVoxelCount())) +
         fuzz::magnitude(double(grid.baseTree().leafCount()));
}

std::string told(const foreign::GridHead& head) {
  return std::string(head.readable ? "r" : "-") + (head.half ? "h" : "-") + (head.vectors ? "v" : "-") +
         (head.transform ? "t" : "-") + head.gridClass;
}

template <class Grid>
std::string byName(const std::filesystem::path& file, const std::string& name) {
  openvdb::GridBase::Ptr grid;
  foreign::readGrid(file, name, std::is_same_v<Grid, openvdb::Vec3SGrid>, [&](std::istream& stream) {
    openvdb::io::Stream grids(stream, false);
    grid = grids.getGrids()->at(0);
  });
  // What comes back is of the type that was wanted, and can be used.
  if (!grid->isType<Grid>() || !grid->transform().isLinear()) std::abort();
  return told(*grid);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const bool once = (openvdb::initialize(), true);
  if (!once) return 1;
  const auto file = fuzz::written("a.vdb", data, size);
  fuzz::outcomeFromAfar<std::runtime_error>(
      [&] { return told(*pipeline::readGrid<openvdb::FloatGrid>(file)); });
  std::vector<foreign::GridHead> heads;
  fuzz::outcomeFromAfar<foreign::Unreadable>([&] {
    heads = foreign::listGrids(file);
    std::string words;
    for (const foreign::GridHead& head : heads) words += told(head) + ' ';
    return words;
  });
  constexpr std::size_t kMost = 3;  // each is a process
  for (std::size_t i = 0; i < std::min(kMost, heads.size()); ++i)
    fuzz::outcomeFromAfar<foreign::Unreadable>([&] {
      return heads[i].vectors ? byName<openvdb::Vec3SGrid>(file, heads[i].name)
                              : byName<openvdb::FloatGrid>(file, heads[i].name);
    });
  return 0;
}
