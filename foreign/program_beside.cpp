#include "foreign/program_beside.h"

#include <dlfcn.h>
#include <link.h>

#include <vector>

namespace fluidtex::foreign {
namespace fs = std::filesystem;
namespace {

// The shared library that this code is in; empty where it is in the program itself.
fs::path ownLibrary() {
  Dl_info info;
  void* map = nullptr;
  if (dladdr1(reinterpret_cast<void*>(&programBeside), &info, &map, RTLD_DL_LINKMAP) == 0) return {};
  return static_cast<const link_map*>(map)->l_name;
}

}  // namespace

fs::path programBeside(const std::string& name, const fs::path& built) {
  std::error_code ignored;
  std::vector<fs::path> places{fs::read_symlink("/proc/self/exe", ignored).parent_path() / name};
  if (const fs::path library = fs::absolute(ownLibrary(), ignored); library.has_filename()) {
    fs::path folder = library.parent_path();
    places.push_back(folder / name);
    for (; folder.has_relative_path(); folder = folder.parent_path())
      places.push_back(folder.parent_path() / "bin" / name);
  }
  if (fluidtexPrograms != nullptr) places.push_back(fs::path(fluidtexPrograms()) / name);
  for (const fs::path& place : places)
    if (fs::exists(place, ignored)) return place;
  return built;
}

}  // namespace fluidtex::foreign
