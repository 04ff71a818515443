#include "transport/carry.h"

#include "tests/transport/orientation_flows.h"
#include "texture/orientation/orient.h"
#include "transport/backtrace.h"

#include <algorithm>
#include <numbers>

using namespace fluidtex;
using namespace fluidtex::testing;
using namespace fluidtex::transport;

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
    REQUIRE(trustBesidesStretch(carried, previous, v) > 0.999f);
  }
}

TEST_CASE("carry: directions that symmetry makes equal are picked up as one", "[transport]") {
  const int symmetry = GENERATE(2, 4);
  const Vec3d axis(1, 2, 2);
  const double angle = 0.4;
  const sim::Frame frame = steadyFrame({0.1, -16, 16}, 1.0, 4, linearFlow(rotationAbout(axis, angle)));
  const SurfaceMesh before = torusMesh(48, 24);
  const SurfaceMesh after = mappedMesh(torusMesh(61, 31), exponential(rotationAbout(axis, angle)));
  const TexturedSurface plain =
      texturedMesh(before, [](const Vec3d& x) { return Vec3d(0.3 + x.z(), x.x(), 0.5); });
  TexturedSurface turned = plain;
  for (std::size_t v = 0; v < turned.orientation.size(); ++v) {
    Vec3f& d = turned.orientation[v];
    const std::size_t turns = v * 2654435761u >> 7;
    for (std::size_t k = 0; k < turns % std::size_t(symmetry); ++k)
      d = symmetry == 2 ? -d : before.normals[v].cross(d);
  }
  const Carried expected = carry(plain, frame, after, symmetry),
                found = carry(turned, frame, after, symmetry);
  const Carried asArrows = carry(turned, frame, after, 1);
  std::size_t wrong = 0;
  for (std::size_t v = 0; v < after.positions.size(); ++v) {
    const auto off = [&](const Carried& carried) {  // degrees to the nearest of the equal directions
      const double whole =
          angleBetween(Vec3d(expected.orientation[v]), Vec3d(carried.orientation[v])) / kDegree;
      const double period = 360.0 / symmetry;
      return std::abs(whole - period * std::round(whole / period));
    };
    REQUIRE(off(found) < 0.05);
    wrong += off(asArrows) > 1.0;
  }
  CHECK(wrong > after.positions.size() / 4);
}

TEST_CASE("carry: orientation follows closed forms over 200 frames", "[transport][slow]") {
  // d ~ F d0 for steady linear flow, F = exp(A t), on a surface that moves with the flow.
  constexpr int kFrames = 200;
  for (const auto& [name, a, time, direction] : linearCases()) {
    INFO(name);
    const SurfaceMesh start = sphereMesh(7, 0.4);
    const sim::Frame frame = steadyFrame({0.1, -16, 16}, time / kFrames, 1, linearFlow(a));
    TexturedSurface surface = texturedMesh(start, constantDirection(direction));
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

TEST_CASE("carry: a uniform stream leaves the orientation as it is, over 200 frames", "[transport]") {
  constexpr int kFrames = 200;
  const Vec3d velocity(0.6, -0.3, 0.2);
  const SurfaceMesh start = sphereMesh(7, 0.4);
  const TexturedSurface first = texturedMesh(start, constantDirection({0.3, 0.5, 0.8}));
  const sim::Frame frame = steadyFrame({0.1, -20, 20}, 0.01, 1, [&](const Vec3d&) { return velocity; });
  TexturedSurface surface = first;
  for (int step = 1; step <= kFrames; ++step) {
    SurfaceMesh next = start;
    for (Vec3f& x : next.positions) x = Vec3f(Vec3d(x) + velocity * (0.01 * step));
    surface = continued(carry(surface, frame, next), next);
  }
  for (std::size_t v = 0; v < start.positions.size(); ++v)
    REQUIRE(angleBetween(Vec3d(first.orientation[v]), Vec3d(surface.orientation[v])) < 0.05 * kDegree);
}

TEST_CASE("carry: what is tangent stays so without being projected", "[transport]") {
  // l . grad(phi) is conserved: the traced map turns tangents into tangents of the moved surface.
  for (const auto& [name, a, time, direction] : linearCases()) {
    INFO(name);
    const Mat3d f = exponential(a * time);
    const SurfaceMesh start = sphereMesh(7, 0.4), next = mappedMesh(start, f);
    const TexturedSurface first = texturedMesh(start, constantDirection(direction));
    const Backtrace trace = traceBack(next.positions, steadyFrame({0.1, -30, 30}, time, 200, linearFlow(a)));
    for (std::size_t v = 0; v < start.positions.size(); ++v) {
      const Vec3d carried = trace.map[v].inverse() * Vec3d(first.orientation[v]);
      REQUIRE(std::abs(carried.unit().dot(Vec3d(next.normals[v]))) < 1e-4);
    }
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
