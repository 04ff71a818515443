#include "sim/mesh_place.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;

namespace {

bool isNear(const Vec3d& a, const Vec3d& b) {
  return (a - b).length() < 1e-12;
}

}  // namespace

TEST_CASE("mesh place: z up and no rotation leave a mesh as it is") {
  const auto matrix = rotationOf(UpAxis::z, Vec3d(0.0));
  CHECK(matrix == openvdb::Mat3d::identity());
}

TEST_CASE("mesh place: of files with y up, y becomes z and z becomes -y") {
  const auto matrix = rotationOf(UpAxis::y, Vec3d(0.0));
  CHECK(isNear(matrix.transform(Vec3d(1.0, 2.0, 3.0)), Vec3d(1.0, -3.0, 2.0)));
}

TEST_CASE("mesh place: turned anticlockwise for those whom the axis points at, about x, then y, then z") {
  CHECK(isNear(rotationOf(UpAxis::z, Vec3d(90.0, 0.0, 0.0)).transform(Vec3d(0.0, 1.0, 0.0)),
               Vec3d(0.0, 0.0, 1.0)));
  CHECK(isNear(rotationOf(UpAxis::z, Vec3d(0.0, 90.0, 0.0)).transform(Vec3d(0.0, 0.0, 1.0)),
               Vec3d(1.0, 0.0, 0.0)));
  CHECK(isNear(rotationOf(UpAxis::z, Vec3d(0.0, 0.0, 90.0)).transform(Vec3d(1.0, 0.0, 0.0)),
               Vec3d(0.0, 1.0, 0.0)));
  // y to z to x to y; about z first, it would end at -x.
  CHECK(isNear(rotationOf(UpAxis::z, Vec3d(90.0)).transform(Vec3d(0.0, 1.0, 0.0)), Vec3d(0.0, 1.0, 0.0)));
  // The file's up axis comes first.
  CHECK(isNear(rotationOf(UpAxis::y, Vec3d(0.0, 0.0, 90.0)).transform(Vec3d(1.0, 0.0, 0.0)),
               Vec3d(0.0, 1.0, 0.0)));
  CHECK(isNear(rotationOf(UpAxis::y, Vec3d(0.0, 90.0, 0.0)).transform(Vec3d(0.0, 1.0, 0.0)),
               Vec3d(1.0, 0.0, 0.0)));
}
