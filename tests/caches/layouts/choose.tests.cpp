#include "caches/formats/format_error.h"
#include "caches/layouts/programs.h"
#include "tests/caches/layouts/folder_files.h"

using namespace fluidtex::caches;
using Catch::Matchers::Contains;
using Names = std::vector<std::string>;

namespace {

GridChoice choiceOf(const openvdb::GridCPtrVec& grids, const Options& options = {}) {
  const Scratch scratch;
  writeGrids(scratch.path / "a.vdb", grids);
  return chooseGrids(scratch.path / "a.vdb", options);
}

Options named(const std::string& surface, const std::string& velocity) {
  Options options;
  options.surfaceName = surface;
  options.velocityName = velocity;
  return options;
}

AttributeChoice attributesOf(const std::string& bytes, const Options& options = {}) {
  const Scratch scratch;
  writeFile(scratch.path / "a.ply", bytes);
  return chooseAttributes(scratch.path / "a.ply", options);
}

}  // namespace

TEST_CASE("choose: surface and velocity by their usual names", "[caches]") {
  const GridChoice choice = choiceOf({numbers("pressure"), numbers("surface", openvdb::GRID_LEVEL_SET),
                                      vectors("rest"), vectors("vel", openvdb::GRID_STAGGERED)});
  CHECK(choice.surface == "surface");
  CHECK_FALSE(choice.fog);
  CHECK(choice.velocity == Names{"vel"});
  CHECK(choice.onFaces);
  CHECK(choice.scalars == Names{"pressure"});
}

TEST_CASE("choose: names in other letters, and of a class that says nothing", "[caches]") {
  const GridChoice choice = choiceOf({numbers("other"), numbers("Phi"), vectors("Velocity")});
  CHECK(choice.surface == "Phi");
  CHECK(choice.velocity == Names{"Velocity"});
  CHECK_FALSE(choice.onFaces);
}

TEST_CASE("choose: a level set of any name, any vectors", "[caches]") {
  const GridChoice choice =
      choiceOf({numbers("temperature"), numbers("wave", openvdb::GRID_LEVEL_SET), vectors("motion")});
  CHECK(choice.surface == "wave");
  CHECK(choice.velocity == Names{"motion"});
  CHECK(choice.scalars == Names{"temperature"});
}

TEST_CASE("choose: velocities in three grids of numbers", "[caches]") {
  const std::vector<Names> names{
      {"vel.x", "vel.y", "vel.z"}, {"velx", "vely", "velz"}, {"v_x", "v_y", "v_z"}, {"u", "v", "w"}};
  for (const Names& three : names) {
    INFO(three[0]);
    const GridChoice choice =
        choiceOf({numbers("sdf"), numbers(three[2]), numbers(three[0]), numbers(three[1])});
    CHECK(choice.surface == "sdf");
    CHECK(choice.velocity == three);
    CHECK_FALSE(choice.onFaces);
    CHECK(choice.scalars.empty());
  }
  // Three that are named as velocities say more than vectors that are not.
  CHECK(choiceOf({numbers("sdf"), vectors("force"), numbers("vel.x"), numbers("vel.y"), numbers("vel.z")})
            .velocity == Names{"vel.x", "vel.y", "vel.z"});
  CHECK(choiceOf({numbers("sdf"), numbers("vel.x"), numbers("vel.y")}).velocity.empty());
}

TEST_CASE("choose: densities where there are no distances", "[caches]") {
  const GridChoice choice =
      choiceOf({numbers("heat"), numbers("density", openvdb::GRID_FOG_VOLUME), vectors("v")});
  CHECK(choice.surface == "density");
  CHECK(choice.fog);
  const GridChoice unnamed = choiceOf({numbers("heat"), numbers("smoke", openvdb::GRID_FOG_VOLUME)});
  CHECK(unnamed.surface == "smoke");
  CHECK(unnamed.fog);
  CHECK(unnamed.velocity.empty());
  // A density that is called a surface is one.
  CHECK(choiceOf({numbers("surface", openvdb::GRID_FOG_VOLUME)}).fog);
}

TEST_CASE("choose: nothing that fits", "[caches]") {
  const GridChoice choice = choiceOf({numbers("heat"), openvdb::Int32Grid::create()});
  CHECK(choice.surface.empty());
  CHECK(choice.velocity.empty());
  CHECK(choiceOf({}).surface.empty());
}

TEST_CASE("choose: names that are given", "[caches]") {
  const openvdb::GridCPtrVec grids{numbers("surface", openvdb::GRID_LEVEL_SET),
                                   numbers("mine"),
                                   vectors("vel"),
                                   vectors("own", openvdb::GRID_STAGGERED),
                                   numbers("a"),
                                   numbers("b"),
                                   numbers("c")};
  const GridChoice choice = choiceOf(grids, named("mine", "own"));
  CHECK(choice.surface == "mine");
  CHECK(choice.velocity == Names{"own"});
  CHECK(choice.onFaces);
  CHECK(choice.scalars == Names{"surface", "a", "b", "c"});
  CHECK(choiceOf(grids, named("", "a,b,c")).velocity == Names{"a", "b", "c"});
  CHECK(choiceOf(grids, named("", "a, b, c")).velocity == Names{"a", "b", "c"});
  Options dense = named("mine", "");
  dense.iso = 0.5;
  CHECK(choiceOf(grids, dense).fog);
}

TEST_CASE("choose: given names that do not fit, with those that are there", "[caches]") {
  const openvdb::GridCPtrVec grids{numbers("surface", openvdb::GRID_LEVEL_SET), vectors("vel")};
  const auto refused = [&](const std::string& surface, const std::string& velocity) {
    return refusal([&] { choiceOf(grids, named(surface, velocity)); });
  };
  CHECK_THAT(refused("vel", ""), Contains("a.vdb") && Contains("surface, vel"));
  CHECK_THAT(refused("sdf", ""), Contains("\"sdf\"") && Contains("surface, vel"));
  CHECK_THAT(refused("", "velocity"),
             Contains("no grid of vectors named \"velocity\"") && Contains("surface, vel"));
  CHECK_THAT(refused("", "vel,vel,vel"), Contains("no grid of numbers named \"vel\""));
  CHECK_THAT(refused("", "a,b"), Contains("names 2 grids"));
}

TEST_CASE("choose: a file that cannot be read", "[caches]") {
  const Scratch scratch;
  writeFile(scratch.path / "a.vdb", "no grids");
  writeFile(scratch.path / "b.vdb", "");
  CHECK_THAT(refusal([&] { chooseGrids(scratch.path / "a.vdb", {}); }), Contains("a.vdb: "));
  CHECK_THAT(refusal([&] { chooseGrids(scratch.path / "b.vdb", {}); }), Contains("b.vdb: "));
}

TEST_CASE("choose: velocities at the points of a mesh", "[caches]") {
  const AttributeChoice choice = attributesOf(plyBytes(true, {"vx", "vy", "vz", "age"}));
  CHECK(choice.triangles);
  CHECK(choice.velocity == "v");
  CHECK(choice.scalars == Names{"age"});
  CHECK(attributesOf(plyBytes(true, {"velocity_x", "velocity_y", "velocity_z"})).velocity == "velocity");
  CHECK(attributesOf(plyBytes(true, {"Vel.x", "Vel.y", "Vel.z"})).velocity == "Vel");
  const AttributeChoice normals = attributesOf(plyBytes(false, {"nx", "ny", "nz"}));
  CHECK_FALSE(normals.triangles);
  CHECK(normals.velocity.empty());
  CHECK(attributesOf(plyBytes(false, {"nx", "ny", "nz"}), named("", "n")).velocity == "n");
}

TEST_CASE("choose: an attribute that is given and missing", "[caches]") {
  CHECK_THAT(refusal([&] {
               attributesOf(plyBytes(true, {"vx", "vy", "vz", "age"}), named("", "age"));
             }),
             Contains("no attribute of vectors \"age\"") && Contains("there are: v"));
  CHECK_THAT(refusal([&] { attributesOf(plyBytes(true), named("", "v")); }), Contains("there are: none"));
  CHECK_THROWS_AS(attributesOf("no mesh"), FormatError);
}
