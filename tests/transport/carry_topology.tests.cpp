#include "transport/carry.h"

#include "tests/transport/textured_meshes.h"

#include <algorithm>

using namespace fluidtex;
using namespace fluidtex::testing;
using namespace fluidtex::transport;

TEST_CASE("carry: coordinates are never averaged across a jump", "[transport]") {
  // Two patches with unrelated coordinates meet along x = 0.
  const SurfaceMesh mesh = sphereMesh(20);
  TexturedSurface previous = texturedMesh(mesh, constantDirection({0, 0, 1}));
  const Vec2f jump(1000.0f, -700.0f);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (mesh.positions[v].x() > 0.0f) previous.coordinate[v] += jump;
  }
  const double angle = 0.5 * mesh.spacing;
  const sim::Frame frame = steadyFrame({0.1, -14, 14}, 1.0, 1, linearFlow(rotationAbout({1, 1, 0}, angle)));
  const SurfaceMesh next = sphereMesh(23);
  const Carried carried = carry(previous, frame, next);
  int left = 0, right = 0;
  for (std::size_t v = 0; v < next.positions.size(); ++v) {
    const Vec2f plain =
        Vec2f(carried.previousPosition[v].x(), carried.previousPosition[v].y()) * float(kTexelsPerMeter);
    const Vec2f offset = carried.coordinate[v] - plain;
    const bool onLeft = offset.length() < 0.5f, onRight = (offset - jump).length() < 0.5f;
    REQUIRE((onLeft || onRight));
    (onLeft ? left : right) += 1;
    // The side is that of the landing point, up to the spacing.
    if (std::abs(carried.previousPosition[v].x()) > mesh.spacing)
      REQUIRE(onRight == (carried.previousPosition[v].x() > 0.0f));
  }
  CHECK(left > 100);
  CHECK(right > 100);
}

TEST_CASE("carry: two drops merge, every vertex gets a value, trust is low off the old surface only",
          "[transport]") {
  // Two spheres in touch become one capsule; nothing moves, only the gap is filled.
  const SurfaceMesh one = sphereMesh(14, 0.5, {-0.52, 0, 0}), two = sphereMesh(14, 0.5, {0.52, 0, 0});
  SurfaceMesh both = one;
  for (const Vec3I& t : two.triangles)
    both.triangles.push_back(t + Vec3I(std::uint32_t(one.positions.size())));
  both.positions.insert(both.positions.end(), two.positions.begin(), two.positions.end());
  both.normals.insert(both.normals.end(), two.normals.begin(), two.normals.end());
  const TexturedSurface previous = texturedMesh(both, constantDirection({0.1, 0.2, 1}));

  SurfaceMesh capsule = sphereMesh(24, 0.5);
  for (Vec3f& x : capsule.positions) {
    const float stretch = std::clamp(x.x() * 8.0f, -1.0f, 1.0f) * 0.52f;
    x.x() += stretch;
    if (std::abs(stretch) < 0.52f) {  // the bridge
      const float radius = std::sqrt(x.y() * x.y() + x.z() * x.z());
      x.y() *= 0.45f / radius;
      x.z() *= 0.45f / radius;
    }
  }
  const sim::Frame frame = steadyFrame({0.08, -16, 16}, 1.0, 1, [](const Vec3d&) { return Vec3d(0.0); });
  const Carried carried = carry(previous, frame, capsule);
  requireWhole(carried, capsule);
  int seam = 0, kept = 0;
  for (std::size_t v = 0; v < capsule.positions.size(); ++v) {
    const Vec3f& x = capsule.positions[v];
    const double off = std::min(std::abs((Vec3d(x) - Vec3d(-0.52, 0, 0)).length() - 0.5),
                                std::abs((Vec3d(x) - Vec3d(0.52, 0, 0)).length() - 0.5));
    if (off < 0.002) {
      REQUIRE(carried.trust[v] > 0.9f);
      ++kept;
    } else if (off > 0.12) {
      REQUIRE(carried.trust[v] < 0.1f);
      ++seam;
    }
  }
  CHECK(seam > 20);
  CHECK(kept > 500);
}

TEST_CASE("carry: a new body far from everything gets values without trust", "[transport]") {
  const TexturedSurface previous = texturedMesh(sphereMesh(10), constantDirection({0, 0, 1}));
  const SurfaceMesh far = sphereMesh(10, 1.0, {50, 20, -30});
  const sim::Frame frame = steadyFrame({0.1, -4, 4}, 1.0, 1, [](const Vec3d&) { return Vec3d(0.0); });
  const Carried carried = carry(previous, frame, far);
  requireWhole(carried, far);
  for (const float trust : carried.trust) REQUIRE(trust == 0.0f);
}

TEST_CASE("carry: each side of a thin sheet picks up its own", "[transport]") {
  const double thickness = 0.02;
  const SurfaceMesh sheet = boxMesh({-0.5, -0.5, 0}, {0.5, 0.5, thickness}, {50, 50, 1});
  TexturedSurface previous = texturedMesh(sheet, constantDirection({1, 0, 0}));
  for (std::size_t v = 0; v < sheet.positions.size(); ++v) {
    previous.color[v] = sheet.normals[v].z() > 0.0f ? Vec4f(1, 0, 0, 1) : Vec4f(0, 0, 1, 1);
  }
  // The solver moved the sheet by three quarters of its thickness more than the velocity says.
  for (const double error : {0.75 * thickness, -0.75 * thickness}) {
    SurfaceMesh next = sheet;
    for (Vec3f& x : next.positions) x.z() += float(error);
    const sim::Frame frame = steadyFrame({0.04, -16, 16}, 1.0, 1, [](const Vec3d&) { return Vec3d(0.0); });
    const Carried carried = carry(previous, frame, next);
    for (std::size_t v = 0; v < next.positions.size(); ++v) {
      if (std::abs(next.normals[v].z()) < 0.99f) continue;
      REQUIRE(carried.color[v][0] == (next.normals[v].z() > 0.0f ? 1.0f : 0.0f));
    }
  }
}

TEST_CASE("carry: trust falls where the velocity is missing", "[transport]") {
  const SurfaceMesh mesh = sphereMesh(10);
  const TexturedSurface previous = texturedMesh(mesh, constantDirection({0, 0, 1}));
  // Velocity is known for x, y, z < 0.4 only.
  const sim::Frame frame = steadyFrame({0.1, -16, 4}, 1.0, 1, [](const Vec3d&) { return Vec3d(0.0); });
  const Carried carried = carry(previous, frame, mesh);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3f& x = mesh.positions[v];
    const float outermost = std::max({x.x(), x.y(), x.z()});
    if (outermost < 0.3f) REQUIRE(carried.trust[v] == Approx(1.0f));
    if (outermost > 0.6f) REQUIRE(carried.trust[v] < 0.7f);
  }
}
