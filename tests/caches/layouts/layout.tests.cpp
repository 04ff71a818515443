#include "caches/layouts/layout.h"

#include <catch2/catch.hpp>

using namespace fluidtex::caches;

namespace {

NumberedFiles sequence(const std::string& pattern) {
  return {std::filesystem::path("folder") / pattern, {{3, "folder/a"}, {7, "folder/b"}}};
}

Layout ofMeshes() {
  Layout layout;
  layout.surface = sequence("w####.ply");
  layout.first = 3;
  layout.last = 7;
  return layout;
}

}  // namespace

TEST_CASE("layout: a field's numbers have names of letters, digits and _", "[caches]") {
  using Words = std::vector<std::string>;
  CHECK(scalarNames({"heat"}) == Words{"heat"});
  CHECK(scalarNames({"Heat 2.C-a"}) == Words{"Heat_2_C_a"});
  CHECK(scalarNames({"2age"}) == Words{"_2age"});
  CHECK(scalarNames({""}) == Words{"_"});
  CHECK(scalarNames({"\xc3\xa9t"}) == Words{"__t"});
  CHECK(scalarNames({"Cd", true}) == Words{"Cd_x", "Cd_y", "Cd_z"});
  CHECK(scalarNames({"1.0", true, true}) == Words{"_1_0_x", "_1_0_y", "_1_0_z"});
}

TEST_CASE("layout: frames are those from the first to the last", "[caches]") {
  CHECK(Layout{}.frames() == 0);
  CHECK(ofMeshes().frames() == 5);
}

TEST_CASE("layout: what was taken for what, a line each", "[caches]") {
  Layout layout = ofMeshes();
  CHECK(describe(layout) == std::vector<std::string>{"cache     files of one a frame, frames 3 to 7",
                                                     "surface   w####.ply, meshes",
                                                     "velocity  none: the files hold none that is known"});
  layout.velocityKind = VelocityKind::attribute;
  layout.velocityNames = {"v"};
  layout.surfaceKind = SurfaceKind::particles;
  layout.fields = {{"heat"}, {"Cd", true}};
  CHECK(describe(layout) == std::vector<std::string>{"cache     files of one a frame, frames 3 to 7",
                                                     "surface   w####.ply, particles",
                                                     "velocity  attribute v of these",
                                                     "further   heat, Cd_x, Cd_y, Cd_z"});
}

TEST_CASE("layout: of grids their names are said, of programs where the unit is from", "[caches]") {
  Layout layout = ofMeshes();
  layout.surfaceKind = SurfaceKind::fog;
  layout.surfaceName = "density";
  layout.velocityKind = VelocityKind::grids;
  layout.velocity = sequence("v####.vdb");
  layout.velocityNames = {"vel"};
  layout.onFaces = true;
  CHECK(describe(layout)[1] == "surface   w####.ply, densities, grid density");
  CHECK(describe(layout)[2] == "velocity  v####.vdb, grid vel, at faces");
  layout.surfaceKind = SurfaceKind::levelSet;
  layout.velocityNames = {"u", "v", "w"};
  layout.onFaces = false;
  CHECK(describe(layout)[1] == "surface   w####.ply, level sets, grid density");
  CHECK(describe(layout)[2] == "velocity  v####.vdb, grids u, v, w");
  layout.program = Program::mantaflow;
  layout.surfaceKind = SurfaceKind::mantaflow;
  CHECK(describe(layout)[0] == "cache     Blender's liquid (mantaflow), frames 3 to 7");
  CHECK(describe(layout)[1] == "surface   w####.ply, mantaflow's distances in voxels, grid density");
  layout.program = Program::flipFluids;
  layout.velocityKind = VelocityKind::flipFluids;
  CHECK(describe(layout)[0] == "cache     FLIP Fluids, frames 3 to 7");
  CHECK(describe(layout)[2] == "velocity  v####.vdb, by files.velocity_scale");
  layout.blur = sequence("blur####.bobj");
  CHECK(describe(layout)[2] == "velocity  v####.vdb, its unit from blur####.bobj");
}
