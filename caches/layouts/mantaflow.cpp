#include "caches/layouts/programs.h"

#include "foreign/grid.h"

#include <algorithm>

namespace fluidtex::caches {
namespace fs = std::filesystem;
namespace {

bool isCache(const fs::path& folder) {
  std::error_code unknown;
  return fs::is_directory(folder / "config", unknown) &&
         (fs::is_directory(folder / "data", unknown) || fs::is_directory(folder / "mesh", unknown));
}

// The cache that a folder is, is part of, or holds.
std::optional<fs::path> cacheAt(const fs::path& folder) {
  if (isCache(folder)) return folder;
  const std::string name = folder.filename().string();
  if ((name == "config" || name == "data" || name == "mesh") && isCache(folder.parent_path()))
    return folder.parent_path();
  std::vector<fs::path> inside;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (isCache(entry->path())) inside.push_back(entry->path());
  if (inside.size() > 1) {
    std::sort(inside.begin(), inside.end());
    throw LayoutError(folder.string() + ": holds several caches, such as " + inside[0].filename().string() +
                      " and " + inside[1].filename().string() + "; name one of them");
  }
  if (inside.empty()) return std::nullopt;
  return inside.front();
}

// The sequence whose names begin so; empty where there is none. Of several (one an object) an error.
NumberedFiles named(const fs::path& folder, const std::vector<std::string>& beginnings,
                    const std::string& ending) {
  std::error_code unknown;
  if (!fs::is_directory(folder, unknown)) return {};
  for (const std::string& beginning : beginnings)
    for (NumberedFiles& files : sequencesIn(folder)) {
      const std::string name = files.pattern.filename().string();
      if (name.starts_with(beginning) && name.ends_with(ending)) return std::move(files);
    }
  return {};
}

bool has(const std::vector<foreign::GridHead>& grids, const std::string& name) {
  return std::any_of(grids.begin(), grids.end(), [&](const auto& grid) { return grid.name == name; });
}

}  // namespace

std::optional<Layout> mantaflowCache(const fs::path& folder, const Options& options) {
  const std::optional<fs::path> cache = cacheAt(folder);
  if (!cache) return std::nullopt;
  Layout layout;
  layout.program = Program::mantaflow;
  layout.config = named(*cache / "config", {"config_"}, ".uni");
  layout.velocity = named(*cache / "data", {"fluid_data_"}, ".vdb");
  if (layout.config.empty())
    throw LayoutError(cache->string() + ": its folder config holds no config_####.uni; bake the data again");
  if (layout.velocity.empty())
    throw LayoutError(
        cache->string() +
        ": its folder data holds no fluid_data_####.vdb, and so no velocities; bake the data again "
        "with OpenVDB as the format of the volumes");
  const fs::path& sample = layout.velocity.byNumber.rbegin()->second;
  std::vector<foreign::GridHead> grids;
  try {
    grids = foreign::listGrids(layout.velocity.byNumber.begin()->second);
  } catch (const foreign::Unreadable& error) {
    throw LayoutError(layout.velocity.byNumber.begin()->second.string() + ": " + error.what());
  }
  if (!has(grids, "velocity"))
    throw LayoutError(sample.string() + ": holds no grid velocity, so it is not a liquid's; bake a liquid");
  layout.velocityKind = VelocityKind::grids;
  layout.velocityNames = {"velocity"};
  layout.onFaces = true;
  layout.surface = named(*cache / "mesh", {"fluid_mesh_", "lMesh_"}, ".bobj.gz");
  if (!layout.surface.empty() && options.surfaceName.empty()) {
    layout.surfaceKind = SurfaceKind::mesh;
  } else if (has(grids, "phi")) {
    layout.surfaceKind = SurfaceKind::mantaflow;
    layout.surfaceName = "phi";
    layout.surface = layout.velocity;
  } else {
    throw LayoutError(
        cache->string() +
        ": holds velocities but no surface; tick Mesh in the domain's settings and bake it, or make "
        "the cache resumable before the data is baked");
  }
  return layout;
}

std::optional<Layout> flipFluidsCache(const fs::path& folder) {
  std::error_code unknown;
  fs::path files = folder;
  if (fs::is_directory(folder / "bakefiles", unknown))
    files = folder / "bakefiles";
  else if (folder.filename() != "bakefiles")
    return std::nullopt;
  Layout layout;
  layout.program = Program::flipFluids;
  for (NumberedFiles& sequence : sequencesIn(files)) {
    const std::string name = sequence.pattern.filename().string();
    if (name == "####.bobj")
      layout.surface = std::move(sequence);
    else if (name == "velocity####.bobj")
      layout.velocity = std::move(sequence);
    else if (name == "blur####.bobj")
      layout.blur = std::move(sequence);
    else if (name.ends_with("####.data"))
      layout.scalars.push_back(name.substr(0, name.size() - std::string("####.data").size()));
  }
  if (layout.surface.empty())
    throw LayoutError(files.string() + ": holds no ######.bobj, the surface's meshes; bake the simulation");
  if (!layout.velocity.empty()) layout.velocityKind = VelocityKind::flipFluids;
  return layout;
}

}  // namespace fluidtex::caches
