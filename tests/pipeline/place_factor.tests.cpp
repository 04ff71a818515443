#include "pipeline/place_factor.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::pipeline;
using texture::FactorBy;
using texture::Vec3f;

namespace {

scenes::Scene sceneWith(FactorBy by, const std::vector<texture::CurvePoint>& points) {
  scenes::Scene scene;
  scene.texture.scale.by = by;
  scene.texture.scale.points = points;
  return scene;
}

}  // namespace

TEST_CASE("place factor: by nothing, by height, by the distance from the nearest shape, by temperature") {
  const sim::Frame frame;
  CHECK_FALSE(factorIn(textureScale(sceneWith(FactorBy::none, {})), frame));

  const PlaceFactor height = textureScale(sceneWith(FactorBy::height, {{0.0, 1.0}, {2.0, 3.0}}));
  CHECK(factorIn(height, frame)({Vec3f(9, 9, 0.5f), Vec3f(9, 9, 5)}) == std::vector<float>{1.5f, 3.0f});

  scenes::Scene scene = sceneWith(FactorBy::distance, {{0.0, 1.0}, {1.0, 2.0}});
  for (const double x : {0.0, 4.0}) scene.scaleFrom.push_back({sim::Sphere{sim::Vec3d(x, 0, 0), 0.5}});
  const PlaceFactor distance = textureScale(scene);
  const std::vector<float> factors =
      factorIn(distance, frame)({Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(3.25f, 0, 0)});
  CHECK(factors[0] == 1.0f);
  CHECK(factors[1] == Approx(1.5f));
  CHECK(factors[2] == Approx(1.25f));

  // Renewal has a curve and shapes of its own.
  CHECK_FALSE(factorIn(textureRenewal(scene), frame));
  scene.texture.renewal.by = FactorBy::distance;
  scene.texture.renewal.points = {{0.0, 0.0}, {1.0, 4.0}};
  scene.renewalFrom.push_back({sim::Sphere{sim::Vec3d(10, 0, 0), 0.5}});
  const PlaceFactor renewal = textureRenewal(scene);
  CHECK(factorIn(renewal, frame)({Vec3f(10, 0, 0), Vec3f(0, 0, 0)}) == std::vector<float>{0.0f, 4.0f});

  sim::Frame hot;
  auto grid = sim::FloatGrid::create(300.0f);
  grid->fill(openvdb::CoordBBox(openvdb::Coord(0), openvdb::Coord(3)), 500.0f);
  hot.fields["temperature"] = grid;
  const PlaceFactor heat = textureScale(sceneWith(FactorBy::temperature, {{300.0, 1.0}, {700.0, 3.0}}));
  CHECK(factorIn(heat, hot)({Vec3f(1, 1, 1), Vec3f(50, 0, 0)}) == std::vector<float>{2.0f, 1.0f});
}

TEST_CASE("place factor: from a painted volume, a file without one is refused") {
  const Scratch folder;
  const std::filesystem::path file = folder.path / "paint.vdb";
  openvdb::initialize();
  auto grid = openvdb::FloatGrid::create(1.0f);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
  grid->tree().setValue(openvdb::Coord(2, 0, 0), 2.0f);
  openvdb::io::File(file.string()).write({grid});
  scenes::Scene scene = sceneWith(FactorBy::field, {{1.0, 1.0}, {2.0, 4.0}});
  scene.texture.scale.field = file;
  const PlaceFactor painted = textureScale(scene);
  const std::vector<float> factors =
      factorIn(painted, {})({Vec3f(1, 0, 0), Vec3f(1.25f, 0, 0), Vec3f(9, 0, 0)});
  CHECK(factors[0] == Approx(4.0f));
  CHECK(factors[1] == Approx(2.5f));
  CHECK(factors[2] == Approx(1.0f));

  openvdb::io::File(file.string()).write({openvdb::Vec3SGrid::create()});
  CHECK_THROWS_WITH(textureScale(scene), Catch::Contains("paint.vdb: holds no grid of floats"));
}
