#include "caches/layouts/programs.h"

#include "foreign/grid.h"

#include <algorithm>

namespace fluidtex::caches {
namespace fs = std::filesystem;
namespace {

// The sequence whose names begin so; empty where there is none. Of several (one an object) an error.
NumberedFiles named(const fs::path& folder, const std::vector<std::string>& beginnings,
                    const std::string& ending) {
  std::error_code unknown;
  if (!fs::is_directory(folder, unknown)) return {};
  NumberedFiles found;
  for (const std::string& beginning : beginnings) {
    for (NumberedFiles& files : sequencesIn(folder)) {
      const std::string name = files.pattern.filename().string();
      if (!name.starts_with(beginning) || !name.ends_with(ending)) continue;
      if (!found.empty())
        throw LayoutError(folder.string() + ": holds several sequences, " +
                          found.pattern.filename().string() + " and " + name + "; leave one of them");
      found = std::move(files);
    }
    if (!found.empty()) break;
  }
  return found;
}

// Without its clock it still is one, as its volumes tell.
bool isCache(const fs::path& folder) {
  std::error_code unknown;
  if (fs::is_directory(folder / "config", unknown))
    return fs::is_directory(folder / "data", unknown) || fs::is_directory(folder / "mesh", unknown);
  return !named(folder / "data", {"fluid_data_"}, ".vdb").empty();
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

// The first file that holds anything.
const fs::path& sampleOf(const NumberedFiles& files) {
  for (const auto& [number, file] : files.byNumber) {
    std::error_code unknown;
    if (fs::file_size(file, unknown) > 0 && !unknown) return file;
  }
  return files.byNumber.begin()->second;
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
  const fs::path& sample = sampleOf(layout.velocity);
  std::vector<foreign::GridHead> grids;
  try {
    grids = foreign::listGrids(sample);
  } catch (const foreign::Unreadable& error) {
    throw LayoutError(sample.string() + ": " + error.what());
  }
  if (!has(grids, "velocity"))
    throw LayoutError(sample.string() + ": holds no grid velocity, so it is not a liquid's; bake a liquid");
  layout.velocityKind = VelocityKind::grids;
  layout.velocityNames = {"velocity"};
  layout.onFaces = true;
  if (!options.surfaceName.empty() && options.surfaceName != "phi")
    throw LayoutError("files.surface_name: the surface of Blender's liquid is its mesh, or phi, not \"" +
                      options.surfaceName + "\"");
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
  }
  if (layout.surface.empty())
    throw LayoutError(files.string() + ": holds no ######.bobj, the surface's meshes; bake the simulation");
  if (!layout.velocity.empty()) layout.velocityKind = VelocityKind::flipFluids;
  return layout;
}

}  // namespace fluidtex::caches
