#include "tools/frames/onto_mesh.h"

#include "sim/meshes/read_mesh.h"
#include "tests/tools/balls.h"
#include "tests/tools/formats/sample_surface.h"
#include "tools/formats/read_ply.h"

#include <catch2/catch.hpp>

#include <algorithm>

namespace fs = std::filesystem;
using namespace fluidtex;

TEST_CASE("onto mesh: the file of the frame, placed, with its vertices in order and polygons as fans",
          "[tools]") {
  const Scratch scratch;
  std::ofstream(scratch.path / "m_05.obj") << "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0.5 2 0\nv 0 1 0\nf 1 2 3 4 5\n";
  std::ofstream(scratch.path / "m_06.obj") << "v 0 0 0\nv 0 0 7\nv 1 0 0\nf 3 2 1\n";
  sim::MeshSequence meshes;
  meshes.files = scratch.path / "m_%02d.obj";
  meshes.first = 5;
  meshes.place.scale = 2.0;
  meshes.place.translate = sim::Vec3d(10.0, 0.0, 0.0);
  const texture::TexturedSurface first = tools::ontoMesh({}, meshes, 1, 4),
                                 second = tools::ontoMesh({}, meshes, 2, 4);
  CHECK(first.positions ==
        std::vector<texture::Vec3f>{{10, 0, 0}, {12, 0, 0}, {12, 2, 0}, {11, 4, 0}, {10, 2, 0}});
  CHECK(first.triangles == std::vector<texture::Vec3I>{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}});
  CHECK(second.positions == std::vector<texture::Vec3f>{{10, 0, 0}, {10, 0, 14}, {12, 0, 0}});
  CHECK(second.triangles == std::vector<texture::Vec3I>{{2, 1, 0}});
  CHECK_THROWS_AS(tools::ontoMesh({}, meshes, 3, 4), sim::MeshError);
}

TEST_CASE("onto mesh: the surface's values come along, and a mesh's own attributes stay its own", "[tools]") {
  const texture::TexturedSurface surface = sampleSurface();
  caches::CachedMesh mesh;
  mesh.surface.points.assign(surface.positions.begin(), surface.positions.end());
  mesh.surface.triangles.assign(surface.triangles.begin(), surface.triangles.end());
  mesh.attributes["heat"] = {1.0f, 2.0f, 3.0f, 4.0f};
  mesh.attributes["height"] = {5.0f, 6.0f, 7.0f, 8.0f};
  const texture::TexturedSurface onto = tools::ontoMesh(surface, mesh, 1);
  CHECK(onto.positions == surface.positions);
  CHECK(onto.triangles == surface.triangles);
  CHECK(onto.color == surface.color);
  CHECK(onto.age == surface.age);
  CHECK(onto.maps.at("heat") == mesh.attributes["heat"]);
  CHECK(onto.maps.at("height") == mesh.attributes["height"]);
}

TEST_CASE("caches: the mesh of a frame gets the texture too, vertex for vertex, with its attributes",
          "[tools]") {
  const Scratch scratch;
  const fs::path cache = scratch.path / "balls", out = scratch.path / "out", none = scratch.path / "none";
  fs::create_directory(cache);
  writeBalls(cache, 2, 1.2, 1.2);
  const Finished done = textured(cache, out);
  CHECK(done.out.find("further   heat") != std::string::npos);
  const auto own = tools::readPly(out / "surface/0002.ply", 64, 64),
             onto = tools::readPly(out / "onto/0002.ply", 64, 64);
  REQUIRE(onto.positions.size() == 25 * 48);  // as in the file, doubled points too
  for (const auto* surface : {&own, &onto})
    for (std::size_t v = 0; v < surface->positions.size(); ++v) {
      const double heat = 400.0 + 500.0 * double(surface->positions[v].z());
      CHECK(std::abs(double(surface->maps.at("heat")[v]) - heat) < (surface == &onto ? 0.1 : 5.0));
      CHECK(surface->velocity[v].x() == Approx(1.2).margin(0.01));
    }
  CHECK(onto.positions[0].z() == Approx(0.2));
  CHECK(onto.positions[0].x() == Approx(1.2 / 24.0).margin(1e-5));
  const auto trusted =
      std::count_if(onto.trust.begin(), onto.trust.end(), [](float trust) { return trust > 0.5f; });
  CHECK(double(trusted) > 0.95 * double(onto.trust.size()));

  std::vector<std::string> without = texturing(cache, none);
  without.insert(without.end(), {"--set", "files.onto=false"});
  REQUIRE(runProgram(without).exitCode == 0);
  CHECK_FALSE(fs::exists(none / "onto"));
}
