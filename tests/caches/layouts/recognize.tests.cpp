#include "caches/layouts/layout.h"
#include "tests/caches/layouts/folder_files.h"

#include <fmt/core.h>

using namespace fluidtex::caches;
using Catch::Matchers::Contains;
using Names = std::vector<std::string>;

namespace {

openvdb::GridCPtrVec surfaceAndVelocity() {
  return {numbers("surface", openvdb::GRID_LEVEL_SET), vectors("vel", openvdb::GRID_STAGGERED),
          numbers("heat")};
}

Options at(const fs::path& path) {
  Options options;
  options.path = path;
  return options;
}

std::string refused(const Options& options) {
  return refusal([&] { recognize(options); });
}

std::string described(const Options& options) {
  std::string text;
  for (const std::string& line : describe(recognize(options))) text += line + "\n";
  return text;
}

}  // namespace

TEST_CASE("recognize: OpenVDB files, by folder, file or pattern", "[caches]") {
  const Scratch scratch;
  for (const int number : {9, 10, 11})
    writeGrids(scratch.path / fmt::format("w{}.vdb", number), surfaceAndVelocity());
  for (const char* path : {"", "w9.vdb", "w####.vdb", "w%d.vdb"}) {
    INFO(path);
    const Layout layout = recognize(at(scratch.path / path));
    CHECK(layout.program == Program::unknown);
    CHECK(layout.surfaceKind == SurfaceKind::levelSet);
    CHECK(layout.surfaceName == "surface");
    CHECK(layout.velocityKind == VelocityKind::grids);
    CHECK(layout.velocityNames == Names{"vel"});
    CHECK(layout.onFaces);
    CHECK(layout.fields == std::vector<Field>{{"heat"}});
    CHECK(layout.first == 9);
    CHECK(layout.last == 11);
  }
  CHECK_THAT(described(at(scratch.path)), Contains("frames 9 to 11") &&
                                              Contains("w####.vdb, level sets, grid surface") &&
                                              Contains("grid vel, at faces") && Contains("further   heat"));
}

TEST_CASE("recognize: endings in capitals", "[caches]") {
  const Scratch scratch;
  writeGrids(scratch.path / "w1.VDB", surfaceAndVelocity());
  CHECK(recognize(at(scratch.path)).surfaceKind == SurfaceKind::levelSet);
  writeFile(scratch.path / "m" / "w1.PLY", plyBytes(true));
  CHECK(recognize(at(scratch.path / "m")).surfaceKind == SurfaceKind::mesh);
}

TEST_CASE("recognize: meshes and particles with velocities of their own", "[caches]") {
  const Scratch scratch;
  for (const int number : {1, 2}) {
    writeFile(scratch.path / fmt::format("mesh_{}.ply", number), plyBytes(true, {"vx", "vy", "vz", "age"}));
    writeFile(scratch.path / fmt::format("drops_{}.ply", number), plyBytes(false, {"vx", "vy", "vz"}));
  }
  const Layout mesh = recognize(at(scratch.path / "mesh_1.ply"));
  CHECK(mesh.surfaceKind == SurfaceKind::mesh);
  CHECK(mesh.velocityKind == VelocityKind::attribute);
  CHECK(mesh.velocityNames == Names{"v"});
  CHECK(mesh.fields == std::vector<Field>{{"age"}});
  const Layout drops = recognize(at(scratch.path / "drops_1.ply"));
  CHECK(drops.surfaceKind == SurfaceKind::particles);
  CHECK(drops.velocityKind == VelocityKind::attribute);
  CHECK_THAT(refused(at(scratch.path)), Contains("several sequences of meshes or particles") &&
                                            Contains("drops_####.ply, mesh_####.ply"));
  writeFile(scratch.path / "mesh_3.ply", plyBytes(true));
  CHECK(recognize(at(scratch.path)).surface.pattern == scratch.path / "mesh_####.ply");
}

TEST_CASE("recognize: frames without liquid say nothing of the others", "[caches]") {
  const Scratch scratch;
  const std::string none =
      "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
      "property float z\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n";
  writeFile(scratch.path / "a_1.ply", "");
  writeFile(scratch.path / "a_2.ply", none);
  writeFile(scratch.path / "a_3.ply", plyBytes(true, {"vx", "vy", "vz"}));
  const Layout layout = recognize(at(scratch.path));
  CHECK(layout.surfaceKind == SurfaceKind::mesh);
  CHECK(layout.velocityNames == Names{"v"});
  CHECK(layout.first == 1);
  writeGrids(scratch.path / "b" / "b_1.vdb", {});
  writeGrids(scratch.path / "b" / "b_2.vdb", surfaceAndVelocity());
  CHECK(recognize(at(scratch.path / "b")).surfaceName == "surface");
}

TEST_CASE("recognize: velocities in files of their own", "[caches]") {
  const Scratch scratch;
  for (int number = 1; number <= 4; ++number)
    writeFile(scratch.path / fmt::format("mesh_{}.ply", number), plyBytes(true));
  for (int number = 3; number <= 6; ++number)
    writeGrids(scratch.path / fmt::format("grids_{}.vdb", number), {numbers("heat"), vectors("vel")});
  const Layout beside = recognize(at(scratch.path));
  CHECK(beside.surface.pattern == scratch.path / "mesh_####.ply");
  CHECK(beside.velocity.pattern == scratch.path / "grids_####.vdb");
  CHECK(beside.velocityKind == VelocityKind::grids);
  CHECK(beside.first == 3);
  CHECK(beside.last == 4);
  Options named = at(scratch.path / "mesh_1.ply");
  CHECK(recognize(named).velocityKind == VelocityKind::none);
  named.velocity = scratch.path / "grids_####.vdb";
  CHECK(recognize(named).velocityNames == Names{"vel"});
  named.velocityName = "vel";
  CHECK(recognize(named).first == 3);
  named.velocityName = "heat";
  CHECK_THAT(refused(named), Contains("no grid of vectors named \"heat\""));
  named.velocityName.clear();
  named.velocity = scratch.path / "mesh_1.ply";
  CHECK_THAT(refused(named), Contains("mesh_1.ply"));
}

TEST_CASE("recognize: no frame in common", "[caches]") {
  const Scratch scratch;
  writeFile(scratch.path / "mesh_2.ply", plyBytes(true));
  writeGrids(scratch.path / "grids_3.vdb", {vectors("vel")});
  CHECK_THAT(refused(at(scratch.path)), Contains("no number in common (2 to 2, 3 to 3)"));
}

TEST_CASE("recognize: the first frame is one that is there", "[caches]") {
  const Scratch scratch;
  for (const int number : {3, 4, 6})
    writeFile(scratch.path / fmt::format("a_{}.ply", number), plyBytes(true));
  Options options = at(scratch.path);
  options.first = 4;
  CHECK(recognize(options).first == 4);
  CHECK(recognize(options).last == 6);
  options.first = 5;
  CHECK_THAT(refused(options), Contains("files.first: there is no frame 5"));
  options.first = 7;
  CHECK_THAT(refused(options), Contains("there is no frame 7; there are 3 to 6"));
}

TEST_CASE("recognize: nothing that can be a liquid", "[caches]") {
  const Scratch scratch;
  CHECK_THAT(refused(at(scratch.path)), Contains("nothing that can be read as a liquid"));
  CHECK_THAT(refused(at(scratch.path / "none")), Contains("no such file"));
  writeGrids(scratch.path / "a_1.vdb", {numbers("heat")});
  CHECK_THAT(refused(at(scratch.path)), Contains("a_1.vdb") && Contains("files.surface_name"));
  writeFile(scratch.path / "b" / "pictures_1.png");
  CHECK_THAT(refused(at(scratch.path / "b")), Contains("nothing that can be read"));
  writeFile(scratch.path / "c_1.bgeo.sc");
  CHECK_THROWS_WITH(recognize(at(scratch.path / "c_1.bgeo.sc")), Contains("c_1.bgeo.sc"));
}

TEST_CASE("recognize: other files of one number are no matter", "[caches]") {
  const Scratch scratch;
  for (const char* name : {"shot_1.png", "shot_01.png"}) writeFile(scratch.path / name);
  writeFile(scratch.path / "a_1.ply", plyBytes(true));
  CHECK(recognize(at(scratch.path)).surface.pattern == scratch.path / "a_####.ply");
  writeFile(scratch.path / "a_01.ply", plyBytes(true));
  CHECK_THAT(refused(at(scratch.path)), Contains("both number 1"));
}
