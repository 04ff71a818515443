#include "caches/layouts/layout.h"
#include "tests/caches/layouts/folder_files.h"

#include <fmt/core.h>

using namespace fluidtex::caches;
using Catch::Matchers::Contains;
using Names = std::vector<std::string>;

namespace {

// Blender's names for frames 3 to 5.
void writeMantaflow(const fs::path& cache, bool mesh, bool resumable) {
  openvdb::GridCPtrVec grids{vectors("velocity", openvdb::GRID_STAGGERED)};
  if (resumable)
    for (const char* name : {"phi", "phi_obstacle"}) grids.push_back(numbers(name, openvdb::GRID_LEVEL_SET));
  for (int number = 3; number <= 5; ++number) {
    writeFile(cache / "config" / fmt::format("config_{:04}.uni", number));
    writeGrids(cache / "data" / fmt::format("fluid_data_{:04}.vdb", number), grids);
    if (mesh) writeFile(cache / "mesh" / fmt::format("fluid_mesh_{:04}.bobj.gz", number));
  }
}

void writeFlipFluids(const fs::path& bakefiles) {
  for (int number = 1; number <= 3; ++number) {
    for (const char* name : {"", "velocity", "blur", "foam"})
      writeFile(bakefiles / fmt::format("{}{:06}.bobj", name, number));
    writeFile(bakefiles / fmt::format("age{:06}.data", number));
    writeFile(bakefiles / fmt::format("bounds{:06}.bbox", number));
  }
}

Layout layoutAt(const fs::path& path) {
  Options options;
  options.path = path;
  return recognize(options);
}

std::string refused(const fs::path& path) {
  return refusal([&] { layoutAt(path); });
}

}  // namespace

TEST_CASE("known_folders: Blender's cache, from above, inside and below", "[caches]") {
  const Scratch scratch;
  const fs::path cache = scratch.path / "scene" / "cache_fluid";
  writeMantaflow(cache, true, true);
  writeFile(scratch.path / "scene" / "notes_1.txt");
  for (const fs::path& path :
       {cache, cache.parent_path(), cache / "mesh", cache / "data", cache / "config", cache / "",
        cache / "mesh" / "..", cache / "mesh" / "fluid_mesh_0003.bobj.gz",
        cache / "data" / "fluid_data_0004.vdb", cache / "mesh" / "fluid_mesh_####.bobj.gz"}) {
    INFO(path);
    const Layout layout = layoutAt(path);
    CHECK(layout.program == Program::mantaflow);
    CHECK(layout.surfaceKind == SurfaceKind::mesh);
    CHECK(layout.surface.pattern == cache / "mesh" / "fluid_mesh_####.bobj.gz");
    CHECK(layout.velocityKind == VelocityKind::grids);
    CHECK(layout.velocity.pattern == cache / "data" / "fluid_data_####.vdb");
    CHECK(layout.velocityNames == Names{"velocity"});
    CHECK(layout.onFaces);
    CHECK(layout.config.pattern == cache / "config" / "config_####.uni");
    CHECK(layout.first == 3);
    CHECK(layout.last == 5);
  }
}

TEST_CASE("known_folders: Blender's distances, where there is no mesh or they are asked for", "[caches]") {
  const Scratch scratch;
  writeMantaflow(scratch.path / "a", false, true);
  const Layout layout = layoutAt(scratch.path / "a");
  CHECK(layout.surfaceKind == SurfaceKind::mantaflow);
  CHECK(layout.surfaceName == "phi");
  CHECK(layout.surface.pattern == scratch.path / "a" / "data" / "fluid_data_####.vdb");
  writeMantaflow(scratch.path / "b", true, true);
  Options options;
  options.path = scratch.path / "b";
  options.surfaceName = "phi";
  CHECK(recognize(options).surfaceKind == SurfaceKind::mantaflow);
  options.surfaceName = "phi_obstacle";
  CHECK_THAT(refusal([&] { recognize(options); }), Contains("phi_obstacle") && Contains("phi"));
}

TEST_CASE("known_folders: older meshes of Blender, one sequence an object", "[caches]") {
  const Scratch scratch;
  writeMantaflow(scratch.path, false, true);
  for (int number = 3; number <= 5; ++number)
    writeFile(scratch.path / "mesh" / fmt::format("lMesh_{:04}.bobj.gz", number));
  CHECK(layoutAt(scratch.path).surface.pattern == scratch.path / "mesh" / "lMesh_####.bobj.gz");
  for (int number = 3; number <= 5; ++number)
    writeFile(scratch.path / "mesh" / fmt::format("lMesh_b_{:04}.bobj.gz", number));
  CHECK_THAT(refused(scratch.path), Contains("lMesh_####.bobj.gz") && Contains("lMesh_b_####.bobj.gz"));
}

TEST_CASE("known_folders: what Blender's cache can lack", "[caches]") {
  const Scratch scratch;
  writeMantaflow(scratch.path / "a", false, false);
  CHECK_THAT(refused(scratch.path / "a"), Contains("no surface") && Contains("tick Mesh"));
  writeMantaflow(scratch.path / "b", true, false);
  fs::remove_all(scratch.path / "b" / "data");
  CHECK_THAT(refused(scratch.path / "b"), Contains("no fluid_data_####.vdb"));
  writeMantaflow(scratch.path / "c", true, false);
  fs::remove_all(scratch.path / "c" / "config");
  fs::create_directory(scratch.path / "c" / "config");
  CHECK_THAT(refused(scratch.path / "c"), Contains("no config_####.uni"));
  fs::remove(scratch.path / "c" / "config");
  CHECK_THAT(refused(scratch.path / "c"), Contains("config"));
  writeMantaflow(scratch.path / "d", true, false);
  for (int number = 3; number <= 5; ++number)
    writeGrids(scratch.path / "d" / "data" / fmt::format("fluid_data_{:04}.vdb", number),
               {numbers("density")});
  CHECK_THAT(refused(scratch.path / "d"), Contains("no grid velocity"));
  writeMantaflow(scratch.path / "e", true, false);
  for (int number = 3; number <= 5; ++number)
    writeFile(scratch.path / "e" / "data" / fmt::format("fluid_data_{:04}.vdb", number), "damaged");
  CHECK_THAT(refused(scratch.path / "e"), Contains("fluid_data_0003.vdb: "));
}

TEST_CASE("known_folders: an empty first file says nothing of the grids", "[caches]") {
  const Scratch scratch;
  writeMantaflow(scratch.path, false, true);
  writeFile(scratch.path / "data" / "fluid_data_0003.vdb", "");
  CHECK(layoutAt(scratch.path).surfaceKind == SurfaceKind::mantaflow);
}

TEST_CASE("known_folders: frames that all of Blender's folders have", "[caches]") {
  const Scratch scratch;
  writeMantaflow(scratch.path, true, false);
  fs::remove(scratch.path / "config" / "config_0003.uni");
  fs::remove(scratch.path / "mesh" / "fluid_mesh_0005.bobj.gz");
  const Layout layout = layoutAt(scratch.path);
  CHECK(layout.first == 4);
  CHECK(layout.last == 4);
  CHECK(layout.frames() == 1);
  fs::remove(scratch.path / "config" / "config_0004.uni");
  CHECK_THAT(refused(scratch.path), Contains("config_####.uni") && Contains("5 to 5") && Contains("3 to 4"));
}

TEST_CASE("known_folders: several caches in one folder", "[caches]") {
  const Scratch scratch;
  writeMantaflow(scratch.path / "left", true, false);
  writeMantaflow(scratch.path / "right", true, false);
  CHECK_THAT(refused(scratch.path), Contains("left and right"));
  CHECK(layoutAt(scratch.path / "right").program == Program::mantaflow);
}

TEST_CASE("known_folders: FLIP Fluids, from above and inside", "[caches]") {
  const Scratch scratch;
  const fs::path files = scratch.path / "cache" / "bakefiles";
  writeFlipFluids(files);
  for (const fs::path& path : {files, files / "", scratch.path / "cache", files / "000002.bobj"}) {
    INFO(path);
    const Layout layout = layoutAt(path);
    CHECK(layout.program == Program::flipFluids);
    CHECK(layout.surfaceKind == SurfaceKind::mesh);
    CHECK(layout.velocityKind == VelocityKind::flipFluids);
    CHECK(layout.surface.pattern == files / "####.bobj");
    CHECK(layout.velocity.pattern == files / "velocity####.bobj");
    CHECK(layout.blur.pattern == files / "blur####.bobj");
    CHECK(layout.fields.empty());
    CHECK(layout.first == 1);
    CHECK(layout.last == 3);
  }
}

TEST_CASE("known_folders: what FLIP Fluids can lack", "[caches]") {
  const Scratch scratch;
  fs::create_directories(scratch.path / "a" / "bakefiles");
  CHECK_THAT(refused(scratch.path / "a"), Contains("holds no ######.bobj"));
  writeFile(scratch.path / "b" / "bakefiles" / "000001.bobj");
  CHECK(layoutAt(scratch.path / "b").velocityKind == VelocityKind::none);
}
