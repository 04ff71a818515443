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
    if (off < 0.002 && std::abs(x.x()) > 0.7f) {  // an edge away from the bridge and more
      REQUIRE(trustBesidesStretch(carried, previous, v) > 0.9f);
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

namespace {

// A slab from which the part inside [lower, upper], as high as the slab, has gone; each of the two or four
// walls that this leaves is a grid of `cells` squares of its own, facing into the gap.
struct Gap {
  Vec3d lower, upper;
  bool wallsAlongX;  // besides those at lower.x and upper.x also those at lower.y and upper.y
};

SurfaceMesh opened(const SurfaceMesh& slab, const Gap& gap) {
  SurfaceMesh mesh = slab;
  std::erase_if(mesh.triangles, [&](const Vec3I& t) {
    const Vec3d middle((slab.positions[t[0]] + slab.positions[t[1]] + slab.positions[t[2]]) / 3.0f);
    return middle.x() > gap.lower.x() && middle.x() < gap.upper.x() && middle.y() > gap.lower.y() &&
           middle.y() < gap.upper.y();
  });
  const auto addWall = [&](const Vec3d& from, const Vec3d& along, const Vec3f& normal) {
    constexpr int kAlong = 30, kUp = 3;
    const auto first = std::uint32_t(mesh.positions.size());
    const double height = gap.upper.z() - gap.lower.z();
    for (int i = 0; i <= kAlong; ++i) {
      for (int k = 0; k <= kUp; ++k) {
        mesh.positions.emplace_back(from + along * (double(i) / kAlong) + Vec3d(0, 0, height * k / kUp));
        mesh.normals.push_back(normal);
        const std::uint32_t a = first + std::uint32_t(i * (kUp + 1) + k), b = a + kUp + 1;
        if (i == kAlong || k == kUp) continue;
        mesh.triangles.emplace_back(a, b, a + 1);
        mesh.triangles.emplace_back(b, b + 1, a + 1);
      }
    }
  };
  const Vec3d size = gap.upper - gap.lower;
  addWall(gap.lower, {0, size.y(), 0}, {1, 0, 0});
  addWall(gap.lower + Vec3d(size.x(), 0, 0), {0, size.y(), 0}, {-1, 0, 0});
  if (gap.wallsAlongX) {
    addWall(gap.lower, {size.x(), 0, 0}, {0, 1, 0});
    addWall(gap.lower + Vec3d(0, size.y(), 0), {size.x(), 0, 0}, {0, -1, 0});
  }
  return mesh;
}

}  // namespace

TEST_CASE("carry: a sheet tears, a hole opens: trust is low on what was laid open only", "[transport]") {
  const double rise = 0.15;  // half of the slab's thickness; voxels are 0.08
  const SurfaceMesh slab = boxMesh({-1, -1, -rise}, {1, 1, rise}, {40, 40, 6});
  const TexturedSurface previous = texturedMesh(slab, constantDirection({1, 0.2, 0.3}));
  const sim::Frame frame = steadyFrame({0.08, -16, 16}, 1.0, 1, [](const Vec3d&) { return Vec3d(0.0); });
  for (const Gap& gap :
       {Gap{{-0.1, -1, -rise}, {0.1, 1, rise}, false}, {{-0.3, -0.3, -rise}, {0.3, 0.3, rise}, true}}) {
    const SurfaceMesh next = opened(slab, gap);
    const Carried carried = carry(previous, frame, next);
    requireWhole(carried, next);
    std::size_t open = 0;
    for (std::size_t v = 0; v < next.positions.size(); ++v) {
      const bool old = v<slab.positions.size(), flat = std::abs(next.normals[v].z())> 0.99f;
      if (old && flat) REQUIRE(trustBesidesStretch(carried, previous, v) > 0.999f);
      // Of a wall, what is not at its rim, where the old surface still is.
      if (!old && std::abs(next.positions[v].z()) < 0.6 * rise && std::abs(next.positions[v].y()) < 0.7) {
        REQUIRE(carried.trust[v] < 0.1f);
        ++open;
      }
    }
    CHECK(open > 50);
  }
}

TEST_CASE("carry: two sheets close up, trust is low along the seam only", "[transport]") {
  // Two slabs side by side become one; what was their two rims is gone.
  const SurfaceMesh left = boxMesh({-1, -0.5, -0.2}, {-0.04, 0.5, 0.2}, {24, 25, 8}),
                    right = boxMesh({0.04, -0.5, -0.2}, {1, 0.5, 0.2}, {24, 25, 8});
  SurfaceMesh both = left;
  for (const Vec3I& t : right.triangles)
    both.triangles.push_back(t + Vec3I(std::uint32_t(left.positions.size())));
  both.positions.insert(both.positions.end(), right.positions.begin(), right.positions.end());
  both.normals.insert(both.normals.end(), right.normals.begin(), right.normals.end());
  const TexturedSurface previous = texturedMesh(both, constantDirection({0.2, 1, 0.3}));
  // Each slab goes to the middle, past the other's rim: neighbours across the seam came from 0.08 m apart.
  const sim::Frame frame = steadyFrame(
      {0.02, -60, 60}, 0.1, 1, [](const Vec3d& x) { return Vec3d(x.x() < 0.0 ? 0.4 : -0.4, 0.0, 0.0); });
  const SurfaceMesh next = boxMesh({-0.96, -0.5, -0.2}, {0.96, 0.5, 0.2}, {48, 25, 8});
  const Carried carried = carry(previous, frame, next);
  requireWhole(carried, next);
  int seam = 0, kept = 0;
  for (std::size_t v = 0; v < next.positions.size(); ++v) {
    const Vec3f& x = next.positions[v];
    if (std::abs(next.normals[v].z()) < 0.99f) continue;
    if (std::abs(x.x()) < 0.025f) {
      REQUIRE(carried.trust[v] < 0.5f);
      ++seam;
    } else if (std::abs(x.x()) > 0.1f && std::abs(x.x()) < 0.9f) {
      REQUIRE(trustBesidesStretch(carried, previous, v) > 0.99f);
      ++kept;
    }
  }
  CHECK(seam > 40);
  CHECK(kept > 1000);
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
    if (outermost < 0.3f) REQUIRE(trustBesidesStretch(carried, previous, v) == Approx(1.0f));
    if (outermost > 0.6f) REQUIRE(carried.trust[v] == 0.0f);
  }
}
