#include "transport/carry.h"

#include "tests/texture/closed_meshes.h"
#include "tests/transport/velocity_grids.h"
#include "texture/orient.h"

#include <tbb/global_control.h>
#include <catch2/catch.hpp>

#include <cstring>
#include <numbers>

using namespace fluidtex;
using namespace fluidtex::testing;
using namespace fluidtex::transport;
using texture::Carried;
using texture::TexelGradient;
using texture::TexturedSurface;
using texture::Vec2f;
using texture::Vec4f;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kTexelsPerMeter = 50.0;

double angleBetween(const Vec3d& a, const Vec3d& b) {
  return std::atan2(a.cross(b).length(), a.dot(b));
}

Vec3f projected(const Vec3f& x, const Vec3f& n) {
  return x - n * n.dot(x);
}

// Exemplar coordinates that are one linear function of position all over; colour and age likewise.
TexturedSurface texturedMesh(const SurfaceMesh& mesh, const Flow& direction) {
  TexturedSurface surface;
  surface.spacing = mesh.spacing;
  surface.positions = mesh.positions;
  surface.normals = mesh.normals;
  surface.triangles = mesh.triangles;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3f &x = mesh.positions[v], &n = mesh.normals[v];
    Vec3f d = projected(Vec3f(direction(Vec3d(x))), n);
    d.normalize();
    surface.orientation.push_back(d);
    surface.color.emplace_back(0.5f + 0.1f * x.x(), 0.5f + 0.1f * x.y(), 0.5f + 0.1f * x.z(), 1.0f);
    surface.coordinate.emplace_back(float(kTexelsPerMeter * x.x()), float(kTexelsPerMeter * x.y()));
    surface.gradient.push_back({projected(Vec3f(float(kTexelsPerMeter), 0, 0), n),
                                projected(Vec3f(0, float(kTexelsPerMeter), 0), n)});
    surface.age.push_back(2.0f + x.z());
    surface.trust.push_back(1.0f);
  }
  surface.previousPosition = surface.positions;
  return surface;
}

Flow constantDirection(const Vec3d& d) {
  return [d](const Vec3d&) { return d; };
}

// The mesh after a linear map F: normals turn with F^-T.
SurfaceMesh mappedMesh(SurfaceMesh mesh, const Mat3d& f) {
  for (Vec3f& x : mesh.positions) x = Vec3f(f * Vec3d(x));
  const Mat3d normalMap = f.inverse().transpose();
  for (Vec3f& n : mesh.normals) {
    n = Vec3f(normalMap * Vec3d(n));
    n.normalize();
  }
  return mesh;
}

// The state that the next frame starts from, with nothing synthesised in between.
TexturedSurface continued(const Carried& carried, const SurfaceMesh& mesh) {
  TexturedSurface surface;
  surface.spacing = mesh.spacing;
  surface.positions = mesh.positions;
  surface.normals = mesh.normals;
  surface.triangles = mesh.triangles;
  surface.orientation = carried.orientation;
  surface.color = carried.color;
  surface.coordinate = carried.coordinate;
  surface.gradient = carried.gradient;
  surface.age = carried.age;
  surface.trust = carried.trust;
  surface.previousPosition = carried.previousPosition;
  return surface;
}

void requireWhole(const Carried& carried, const SurfaceMesh& mesh) {
  const std::size_t count = mesh.positions.size();
  REQUIRE(carried.orientation.size() == count);
  REQUIRE(carried.color.size() == count);
  REQUIRE(carried.coordinate.size() == count);
  REQUIRE(carried.gradient.size() == count);
  REQUIRE(carried.age.size() == count);
  REQUIRE(carried.trust.size() == count);
  REQUIRE(carried.previousPosition.size() == count);
  for (std::size_t v = 0; v < count; ++v) {
    REQUIRE(carried.orientation[v].length() == Approx(1.0).epsilon(1e-5));
    REQUIRE(std::abs(carried.orientation[v].dot(mesh.normals[v])) < 1e-5f);
    REQUIRE(std::abs(carried.gradient[v].s.dot(mesh.normals[v])) < 1e-4f * kTexelsPerMeter);
    REQUIRE(std::abs(carried.gradient[v].t.dot(mesh.normals[v])) < 1e-4f * kTexelsPerMeter);
    REQUIRE((carried.trust[v] >= 0.0f && carried.trust[v] <= 1.0f));
    REQUIRE(std::isfinite(carried.color[v].lengthSqr()));
    REQUIRE(std::isfinite(carried.coordinate[v].lengthSqr()));
    REQUIRE(std::isfinite(carried.age[v]));
  }
}

}  // namespace

TEST_CASE("carry: nothing moved, nothing changes", "[transport]") {
  const SurfaceMesh mesh = sphereMesh(16);
  const TexturedSurface previous = texturedMesh(mesh, constantDirection({0.3, 0.5, 0.8}));
  const Carried carried = carry(previous, sim::Frame{}, mesh);
  requireWhole(carried, mesh);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    REQUIRE(carried.coordinate[v] == previous.coordinate[v]);
    REQUIRE((carried.color[v] - previous.color[v]).length() < 1e-6f);
    REQUIRE((carried.orientation[v] - previous.orientation[v]).length() < 5e-6f);
    REQUIRE((carried.gradient[v].s - previous.gradient[v].s).length() < 1e-4f);
    REQUIRE(carried.age[v] == Approx(previous.age[v]));
    REQUIRE(carried.trust[v] == 1.0f);
    REQUIRE(carried.previousPosition[v] == mesh.positions[v]);
  }
}

TEST_CASE("carry: a first frame gets an empty result", "[transport]") {
  CHECK(carry({}, sim::Frame{}, sphereMesh(2)).empty());
}

TEST_CASE("carry: a uniform stream takes everything with it onto another mesh", "[transport]") {
  const Vec3d shift(0.13, -0.07, 0.21);
  const sim::Frame frame = steadyFrame({0.1, -20, 20}, 0.1, 2, [&](const Vec3d&) { return shift / 0.1; });
  const SurfaceMesh before = sphereMesh(24), after = sphereMesh(19, 1.0, shift);
  const TexturedSurface previous = texturedMesh(before, constantDirection({0.3, 0.5, 0.8}));
  const Carried carried = carry(previous, frame, after);
  requireWhole(carried, after);
  std::vector<double> turns;
  for (std::size_t v = 0; v < after.positions.size(); ++v) {
    const Vec3f old = after.positions[v] - Vec3f(shift);
    REQUIRE((carried.previousPosition[v] - old).length() < 0.005f);  // chords of the coarser mesh
    // Texels: linear functions are carried without error but for the chord's height.
    REQUIRE((carried.coordinate[v] - Vec2f(old.x(), old.y()) * float(kTexelsPerMeter)).length() < 0.15f);
    REQUIRE(carried.color[v][0] == Approx(0.5 + 0.1 * old.x()).margin(1e-3));
    REQUIRE(carried.age[v] == Approx(2.0 + old.z()).margin(0.01));
    REQUIRE(carried.trust[v] > 0.98f);
    turns.push_back(angleBetween(Vec3d(projected(Vec3f(0.3f, 0.5f, 0.8f), after.normals[v])),
                                 Vec3d(carried.orientation[v])));
  }
  std::sort(turns.begin(), turns.end());
  CHECK(turns[turns.size() / 2] < 0.2 * kDegree);
  CHECK(turns[turns.size() * 95 / 100] < 1.0 * kDegree);
}

TEST_CASE("carry: rigid rotation turns orientation and gradient with the surface", "[transport]") {
  const Vec3d axis(1, 2, 2);
  const double angle = 0.4;
  const sim::Frame frame = steadyFrame({0.1, -16, 16}, 1.0, 4, linearFlow(rotationAbout(axis, angle)));
  const Mat3d turn = exponential(rotationAbout(axis, angle));
  const SurfaceMesh before = torusMesh(48, 24), after = mappedMesh(before, turn);
  const TexturedSurface previous =
      texturedMesh(before, [](const Vec3d& x) { return Vec3d(0.3 + x.z(), x.x(), 0.5); });
  const Carried carried = carry(previous, frame, after);
  requireWhole(carried, after);
  for (std::size_t v = 0; v < after.positions.size(); ++v) {
    REQUIRE(angleBetween(turn * Vec3d(previous.orientation[v]), Vec3d(carried.orientation[v])) <
            0.01 * kDegree);
    REQUIRE((turn * Vec3d(previous.gradient[v].s) - Vec3d(carried.gradient[v].s)).length() <
            1e-3 * kTexelsPerMeter);
    REQUIRE((turn * Vec3d(previous.gradient[v].t) - Vec3d(carried.gradient[v].t)).length() <
            1e-3 * kTexelsPerMeter);
    REQUIRE((carried.coordinate[v] - previous.coordinate[v]).length() < 0.01f);
    REQUIRE(carried.trust[v] > 0.999f);
  }
}

TEST_CASE("carry: orientation follows closed forms over 200 frames", "[transport][slow]") {
  // d ~ F d0 for steady linear flow, F = exp(A t), on a surface that moves with the flow (validation cases B1
  // to B4, B6).
  struct Case {
    const char* name;
    Mat3d a;
    double time;
  };
  const std::vector<Case> cases{{"rigid rotation", rotationAbout({1, 2, 2}, 2 * std::numbers::pi), 1.0},
                                {"simple shear", matrix(0, 1, 0, 0, 0, 0, 0, 0, 0), 2.0},
                                {"planar strain", matrix(1, 0, 0, 0, -1, 0, 0, 0, 0), 0.5},
                                {"triaxial strain", matrix(0.5, 0, 0, 0, 0.25, 0, 0, 0, -0.75), 0.8},
                                {"general", matrix(0.3, -0.8, 0.2, 0.5, 0.1, -0.4, 0.6, 0.2, -0.4), 1.0}};
  constexpr int kFrames = 200;
  for (const auto& [name, a, time] : cases) {
    INFO(name);
    const SurfaceMesh start = sphereMesh(7, 0.4);
    const sim::Frame frame = steadyFrame({0.1, -16, 16}, time / kFrames, 1, linearFlow(a));
    TexturedSurface surface = texturedMesh(start, constantDirection({0.3, 0.5, 0.8}));
    const TexturedSurface first = surface;
    for (int step = 1; step <= kFrames; ++step) {
      const SurfaceMesh next = mappedMesh(start, exponential(a * (time * step / kFrames)));
      surface = continued(carry(surface, frame, next), next);
    }
    const Mat3d f = exponential(a * time), back = f.inverse();
    double worst = 0.0, sum = 0.0, worstGradient = 0.0;
    for (std::size_t v = 0; v < start.positions.size(); ++v) {
      const double error = angleBetween(f * Vec3d(first.orientation[v]), Vec3d(surface.orientation[v]));
      worst = std::max(worst, error);
      sum += error;
      // Gradients are covectors: they turn with B = F^-1 from the right.
      const Vec3d expected = back.transpose() * Vec3d(first.gradient[v].s);
      const Vec3d n(surface.normals[v]);
      worstGradient =
          std::max(worstGradient, (expected - n * n.dot(expected) - Vec3d(surface.gradient[v].s)).length());
    }
    CHECK(sum / start.positions.size() < 0.02 * kDegree);
    CHECK(worst < 0.1 * kDegree);
    CHECK(worstGradient < 0.01 * kTexelsPerMeter);
  }
}

TEST_CASE("carry: orientation in a swirl with a closed form", "[transport]") {
  // B5: Om(r) = exp(-r^2), start (0.6, 0.3), angle 0.4, t = 3: position (-0.483890, 0.464597), d = (0.251743,
  // 0.967794).
  const Flow swirl = [](const Vec3d& x) {
    const double rate = std::exp(-(x.x() * x.x() + x.y() * x.y()));
    return Vec3d(-rate * x.y(), rate * x.x(), 0.0);
  };
  const int frames = 60;
  const sim::Frame frame = steadyFrame({0.02, -60, 60}, 3.0 / frames, 1, swirl);
  // A flat sheet in the plane of the flow; its top side is what is looked at.
  const SurfaceMesh mesh = boxMesh({-1, -1, -0.1}, {1, 1, 0.0}, {200, 200, 10});
  const Vec3d direction(std::cos(0.4), std::sin(0.4), 0.0);
  // One pick-up for the whole time by one frame of many substeps: only the trace is put to the test.
  sim::Frame whole = frame;
  whole.substeps.assign(frames, frame.substeps[0]);
  const TexturedSurface previous = texturedMesh(mesh, constantDirection(direction));
  SurfaceMesh target = mesh;
  std::size_t nearest = 0;
  for (std::size_t v = 0; v < target.positions.size(); ++v) {
    const auto distance = [&](std::size_t u) {
      return (target.positions[u] - Vec3f(-0.483890f, 0.464597f, 0.0f)).length();
    };
    if (target.normals[v].z() > 0.99f &&
        (distance(v) < distance(nearest) || target.normals[nearest].z() < 0.99f))
      nearest = v;
  }
  target.positions[nearest] = Vec3f(-0.483890f, 0.464597f, 0.0f);
  const Carried carried = carry(previous, whole, target);
  CHECK((carried.previousPosition[nearest] - Vec3f(0.6f, 0.3f, 0.0f)).length() < 0.02f * 0.02f);
  CHECK(angleBetween(Vec3d(carried.orientation[nearest]), Vec3d(0.251743, 0.967794, 0.0)) < 0.1 * kDegree);
}

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

TEST_CASE("carry: transparent colour does not bleed", "[transport]") {
  const SurfaceMesh mesh = sphereMesh(8), next = sphereMesh(11);
  TexturedSurface previous = texturedMesh(mesh, constantDirection({0, 0, 1}));
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    previous.color[v] = v % 2 ? Vec4f(0.8f, 0.2f, 0.1f, 1.0f) : Vec4f(0.0f, 9.0f, 9.0f, 0.0f);
  }
  const Carried carried = carry(previous, sim::Frame{}, next);
  int mixed = 0;
  for (const Vec4f& color : carried.color) {
    if (color[3] < 0.05f) continue;
    REQUIRE((color - Vec4f(0.8f, 0.2f, 0.1f, color[3])).length() < 1e-4f);
    mixed += color[3] < 0.95f;
  }
  CHECK(mixed > 100);
}

TEST_CASE("carry: points moved with the flow come home", "[transport]") {
  const Flow vortex = [](const Vec3d& x) {
    return Vec3d(-std::cos(x.x()) * std::sin(x.y()), std::sin(x.x()) * std::cos(x.y()), 0.1);
  };
  const sim::Frame frame = steadyFrame({0.1, -20, 20}, 0.4, 4, vortex);
  SurfaceMesh mesh = sphereMesh(20);
  const TexturedSurface previous = texturedMesh(mesh, constantDirection({0.3, 0.5, 0.8}));
  mesh.positions = moved(mesh.positions, frame);
  const Carried carried = carry(previous, frame, mesh);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    REQUIRE((carried.previousPosition[v] - previous.positions[v]).length() < 0.02f * 0.1f);
    REQUIRE((carried.coordinate[v] - previous.coordinate[v]).length() < 0.02f);
    REQUIRE((carried.color[v] - previous.color[v]).length() < 1e-3f);
  }
}

TEST_CASE("carry: with orientation, a rigid turn leaves the field as it was", "[transport]") {
  const double angle = 0.02;
  texture::Surface start;
  start.levels.push_back(sphereMesh(16));
  texture::orient(start, {});
  SurfaceMesh mesh = start.levels[0];
  TexturedSurface surface = texturedMesh(mesh, constantDirection({0, 0, 1}));
  surface.orientation = mesh.orientation;
  const std::vector<Vec3f> first = mesh.orientation;
  const Vec3d axis(2, -1, 2);
  const sim::Frame frame = steadyFrame({0.1, -14, 14}, 1.0, 2, linearFlow(rotationAbout(axis, angle)));
  const int frames = 10;
  for (int step = 1; step <= frames; ++step) {
    texture::Surface next;
    next.levels.push_back(mappedMesh(mesh, exponential(rotationAbout(axis, angle * step))));
    const Carried carried = carry(surface, frame, next.levels[0]);
    texture::orient(next, carried);
    surface = continued(carried, next.levels[0]);
    surface.orientation = next.levels[0].orientation;
  }
  const Mat3d turn = exponential(rotationAbout(axis, angle * frames));
  std::vector<double> errors;
  for (std::size_t v = 0; v < first.size(); ++v) {
    errors.push_back(angleBetween(turn * Vec3d(first[v]), Vec3d(surface.orientation[v])));
  }
  std::sort(errors.begin(), errors.end());
  CHECK(errors[errors.size() / 2] < 0.2 * kDegree);
  CHECK(errors[errors.size() * 95 / 100] < 2.0 * kDegree);
}

TEST_CASE("velocity and contact at positions", "[transport]") {
  sim::Frame frame = steadyFrame({0.1, -10, 10}, 1.0, 2, constantDirection({1, 2, 3}));
  frame.substeps.back() = substep({0.1, -10, 10}, 0.5, linearFlow(rotationAbout({0, 0, 1}, 2.0)));
  const std::vector<Vec3f> points{Vec3f(0.5f, 0.25f, 0.0f), Vec3f(7, 7, 7)};
  const std::vector<Vec3f> velocity = velocityAt(points, frame);
  CHECK((velocity[0] - Vec3f(-0.5f, 1.0f, 0.0f)).length() < 1e-5f);
  CHECK(velocity[1] == Vec3f(0.0f));
  CHECK(velocityAt(points, sim::Frame{})[0] == Vec3f(0.0f));

  CHECK(contactAt(points, frame) == std::vector<std::uint8_t>{0, 0});
  // A floor below z = 0, voxels of 0.1 m.
  auto solid = openvdb::FloatGrid::create(0.3f);
  solid->setTransform(openvdb::math::Transform::createLinearTransform(0.1));
  auto accessor = solid->getAccessor();
  for (int i = -20; i < 20; ++i) {
    for (int j = -20; j < 20; ++j) {
      for (int k = -3; k <= 3; ++k) accessor.setValue({i, j, k}, 0.1f * float(k));
    }
  }
  frame.solidPhi = solid;
  const std::vector<Vec3f> above{Vec3f(0.3f, 0.2f, 0.04f), Vec3f(0.3f, 0.2f, 0.06f), Vec3f(0, 0, -0.1f),
                                 Vec3f(0, 0, 5)};
  CHECK(contactAt(above, frame) == std::vector<std::uint8_t>{1, 0, 1, 0});
}

TEST_CASE("carry: the same bytes on any number of threads", "[transport]") {
  const sim::Frame frame = steadyFrame({0.1, -14, 14}, 0.3, 3, linearFlow(rotationAbout({1, 1, 0}, 0.7)));
  const TexturedSurface previous = texturedMesh(sphereMesh(24), constantDirection({0.3, 0.5, 0.8}));
  const SurfaceMesh next = sphereMesh(21);
  const auto run = [&](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return carry(previous, frame, next);
  };
  const Carried one = run(1), four = run(4);
  const auto same = [](const auto& a, const auto& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
  };
  CHECK(same(one.orientation, four.orientation));
  CHECK(same(one.color, four.color));
  CHECK(same(one.coordinate, four.coordinate));
  CHECK(same(one.gradient, four.gradient));
  CHECK(same(one.trust, four.trust));
  CHECK(same(one.previousPosition, four.previousPosition));
}
