#include "foreign/grid.h"

#include "foreign/grid_heads.h"

namespace fluidtex::foreign {
namespace {

std::string allOf(Wanted wanted, const std::filesystem::path& file, const std::string& part) {
  std::string bytes;
  ask(
      wanted, file, [&](std::string_view piece) { bytes += piece; }, part);
  return bytes;
}

Wanted named(bool vectors) {
  return vectors ? Wanted::named_vectors : Wanted::named_floats;
}

}  // namespace

std::vector<GridHead> listGrids(const std::filesystem::path& file) {
  return unpacked(allOf(Wanted::grids, file, ""));
}

std::string readGrid(const std::filesystem::path& file, const std::string& name, bool vectors) {
  return allOf(named(vectors), file, name);
}

void readGrid(const std::filesystem::path& file, const std::string& name, bool vectors,
              const std::function<void(std::istream&)>& parse) {
  askForStream(named(vectors), file, parse, name);
}

std::string readGrid(const std::filesystem::path& file, bool vectors) {
  return allOf(vectors ? Wanted::vectors : Wanted::floats, file, "");
}

}  // namespace fluidtex::foreign
