// A dam break's surface, frame after frame from the last frame's points and mesh.
#include "sim/solver.h"
#include "tests/texture/mesh_quality.h"
#include "texture/prepare.h"
#include "transport/carry.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::texture;

TEST_CASE("a dam break's surface: even, near the level set and sound on every frame") {
  sim::Options options;
  options.resolution = 24;
  options.liquid = {{{sim::Box{sim::Vec3d(0.0), sim::Vec3d(0.4, 1.0, 0.5)}}}};
  sim::Solver solver(options);
  SurfaceMesh mesh;
  std::size_t triangles = 0, slim = 0;
  for (int number = 1; number <= 16; ++number) {
    INFO("frame " << number);
    const sim::Frame frame = solver.next();
    const FloatGrid& phi = *frame.surfacePhi;
    const double spacing = phi.voxelSize().x();
    Seeds seeds;
    if (number > 1) seeds = {transport::moved(mesh.positions, frame), mesh.positions, mesh.triangles, {}};
    mesh = prepareSurface(phi, spacing, seeds, 1, SurfaceOptions{}).levels[0];
    requireSound(mesh, phi);
    const Quality q = measure(mesh, phi);
    checkPromises(q);
    triangles += mesh.triangles.size();
    slim += std::size_t(std::lround(q.slim * double(mesh.triangles.size())));
    const IsoSurface iso = isoSurface(LevelSet(phi));
    CHECK(double(mesh.positions.size()) == Approx(area(iso.positions, iso.triangles)).epsilon(0.03));
  }
  CHECK(double(slim) <= 0.001 * double(triangles));
}
