#include "caches/liquid/further_fields.h"

#include "caches/liquid/read_frame.h"
#include "tests/caches/liquid/ball_with_fields.h"
#include "tests/scratch.h"

#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/SignedFloodFill.h>

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::caches;
namespace fs = std::filesystem;

namespace {

double valueAt(const LiquidFrame& frame, const std::string& name, const Vec3d& x) {
  const sim::FloatGrid& grid = *frame.fields.at(name);
  return openvdb::tools::BoxSampler::sample(grid.tree(), grid.worldToIndex(x));
}

// Largest difference of heat on the surface from heatAt(), and of the vectors' second number from `factor` y.
struct Differences {
  double heat = 0.0, vector = 0.0;
};

Differences differences(const LiquidFrame& frame) {
  Differences most;
  for (const openvdb::Vec3f& point : frame.surface.points) {
    const Vec3d x(point);
    most.heat = std::max(most.heat, std::abs(valueAt(frame, "heat", x) - heatAt(x)));
    most.vector = std::max(most.vector, std::abs(valueAt(frame, "Cd_y", x) - x[1]));
  }
  return most;
}

}  // namespace

TEST_CASE("further fields: attributes of a mesh on its surface, whatever is no number left out", "[caches]") {
  const Scratch scratch;
  const auto [points, triangles] = writeBall(scratch.path / "a_1.ply", 4);
  const LiquidFrame frame = readFrame(cacheAt(scratch.path), 1);
  CHECK(frame.fields.size() == 4);
  CHECK(differences(frame).heat < 1.0);
  CHECK(differences(frame).vector < 0.02);
  CHECK(valueAt(frame, "Cd_z", points.front()) == Approx(1.0));

  writeBytes(scratch.path / "b" / "a_1.ply", plyWithFields(points, triangles, 7));
  const LiquidFrame holed = readFrame(cacheAt(scratch.path / "b"), 1);
  for (auto value = holed.fields.at("heat")->cbeginValueOn(); value; ++value) CHECK(std::isfinite(*value));
}

TEST_CASE("further fields: attributes of particles are interpolated between them", "[caches]") {
  const Scratch scratch;
  std::vector<Vec3d> points = latticeIn({}, 0.03);
  const std::size_t noNumber = points.size() / 2;
  writeBytes(scratch.path / "a_1.ply", plyWithFields(points, {}, noNumber));
  const LiquidFrame frame = readFrame(cacheAt(scratch.path), 1);
  CHECK(differences(frame).heat < 1.0);
  CHECK(differences(frame).vector < 0.02);
}

TEST_CASE("further fields: grids beside the surface's, in the place that the options give", "[caches]") {
  openvdb::initialize();
  const Scratch scratch;
  const double h = 0.03;
  const auto transform = openvdb::math::Transform::createLinearTransform(h);
  const Ball ball;
  const auto phi = openvdb::FloatGrid::create(float(3.0 * h));
  const auto heat = openvdb::FloatGrid::create(0.0f);
  const auto color = openvdb::Vec3SGrid::create();
  for (openvdb::CoordBBox::Iterator<true> c =
           openvdb::CoordBBox(openvdb::Coord(0), openvdb::Coord(34)).begin();
       c; ++c) {
    const Vec3d x = transform->indexToWorld(*c);
    const double distance = ball.distance(x);
    if (std::abs(distance) < 3.0 * h) phi->tree().setValue(*c, float(distance));
    if (distance < 0.0) {  // known inside only
      heat->tree().setValue(*c, float(heatAt(x)));
      color->tree().setValue(*c, openvdb::Vec3f(x));
    }
  }
  openvdb::tools::signedFloodFill(phi->tree());
  phi->setName("surface");
  heat->setName("heat");
  color->setName("Cd");
  color->insertMeta("class", openvdb::StringMetadata("staggered"));
  const auto velocity = color->deepCopy();
  velocity->setName("vel");
  for (const auto& grid : {openvdb::GridBase::Ptr(phi), openvdb::GridBase::Ptr(heat),
                           openvdb::GridBase::Ptr(color), openvdb::GridBase::Ptr(velocity)})
    grid->setTransform(transform->copy());
  fs::create_directories(scratch.path);
  openvdb::io::File((scratch.path / "w_1.vdb").string()).write({phi, heat, color, velocity});

  const LiquidFrame here = readFrame(cacheAt(scratch.path), 1);
  CHECK(differences(here).heat < 2.5);
  CHECK(differences(here).vector < 0.05);
  Options moved;
  moved.move = Vec3d(1.0, 2.0, 3.0);
  const LiquidFrame there = readFrame(cacheAt(scratch.path, moved), 1);
  const Vec3d x = ball.center + Vec3d(0.1, 0.0, 0.0);
  CHECK(valueAt(there, "heat", x + moved.move) == Approx(heatAt(x)).margin(0.01));
}
