#include "caches/liquid/placement.h"

#include <catch2/catch.hpp>

using namespace fluidtex::caches;

namespace {

void checkNear(const Vec3d& got, const Vec3d& wanted) {
  INFO(got << " for " << wanted);
  CHECK((got - wanted).length() < 1e-12 * (1.0 + wanted.length()));
}

}  // namespace

TEST_CASE("placement: as in the file where nothing is said", "[caches]") {
  checkNear(worldFromFile({}).transform(Vec3d(1, 2, 3)), Vec3d(1, 2, 3));
  checkNear(velocityFromFile({}).transform(Vec3d(1, 2, 3)), Vec3d(1, 2, 3));
}

TEST_CASE("placement: Y up becomes Z up, and right-handed stays so", "[caches]") {
  Options options;
  options.up = UpAxis::y;
  const openvdb::Mat4d world = worldFromFile(options);
  checkNear(world.transform(Vec3d(0, 1, 0)), Vec3d(0, 0, 1));
  checkNear(world.transform(Vec3d(1, 0, 0)), Vec3d(1, 0, 0));
  checkNear(world.transform(Vec3d(0, 0, 1)), Vec3d(0, -1, 0));
  CHECK(world.getMat3().det() == Approx(1.0));
}

TEST_CASE("placement: turned about x, then y, then z, against the clock seen from the axis' end",
          "[caches]") {
  Options options;
  options.turn = Vec3d(90, 0, 0);
  checkNear(worldFromFile(options).transform(Vec3d(0, 1, 0)), Vec3d(0, 0, 1));
  options.turn = Vec3d(0, 90, 0);
  checkNear(worldFromFile(options).transform(Vec3d(0, 0, 1)), Vec3d(1, 0, 0));
  options.turn = Vec3d(0, 0, 90);
  checkNear(worldFromFile(options).transform(Vec3d(1, 0, 0)), Vec3d(0, 1, 0));
  options.turn = Vec3d(90, 90, 0);  // y to z, and z to x
  checkNear(worldFromFile(options).transform(Vec3d(0, 1, 0)), Vec3d(1, 0, 0));
  options.turn = Vec3d(0, 90, 90);  // z to x, and x to y
  checkNear(worldFromFile(options).transform(Vec3d(0, 0, 1)), Vec3d(0, 1, 0));
}

TEST_CASE("placement: upright first, then turned, enlarged and moved", "[caches]") {
  Options options;
  options.up = UpAxis::y;
  options.turn = Vec3d(0, 90, 0);
  options.unit = 0.001;
  options.scale = 3.0;
  options.move = Vec3d(10, 20, 30);
  options.velocityScale = 24.0;
  // The file's y is up, and turned onto x.
  checkNear(worldFromFile(options).transform(Vec3d(0, 2000, 0)), Vec3d(16, 20, 30));
  checkNear(velocityFromFile(options).transform(Vec3d(0, 1000, 0)), Vec3d(72, 0, 0));
}
