// What is left of a pattern after sixty pick-ups.
#include "transport/pick_up.h"

#include "tests/transport/textured_meshes.h"

#include <cstdio>

using namespace fluidtex;
using namespace fluidtex::testing;
using namespace fluidtex::transport;

namespace {

// Five spacings from light to light, on the exemplar.
float pattern(const Vec2f& texel, double wave) {
  const double k = 2 * std::numbers::pi / wave;
  return float(0.5 + 0.5 * std::sin(k * texel.x()) * std::sin(k * texel.y()));
}

// Root mean square of the difference along edges, on the cap where the texture lies flat.
double sharpness(const SurfaceMesh& mesh, const std::vector<float>& values) {
  double sum = 0.0;
  int count = 0;
  for (const Vec3I& t : mesh.triangles) {
    if (mesh.normals[t[0]].z() < 0.8f) continue;
    const double difference = double(values[t[0]]) - double(values[t[1]]);
    sum += difference * difference;
    ++count;
  }
  return std::sqrt(sum / count);
}

struct Left {
  double color, coordinate;  // shares of the sharpness at the start
};

// The sphere turns about its upright axis by a third of a spacing (at its middle) a frame; its mesh stays, or
// rides with it.
Left sharpnessLeft(bool riding, int frames) {
  const SurfaceMesh start = sphereMesh(28);
  const double wave = 5.0 * start.spacing * kTexelsPerMeter, angle = start.spacing / 3.0;
  const sim::Frame frame = steadyFrame({0.1, -14, 14}, 1.0, 2, linearFlow(rotationAbout({0, 0, 1}, angle)));
  TexturedSurface surface = texturedMesh(start, constantDirection({1, 0, 0}));
  std::vector<float> first;
  for (std::size_t v = 0; v < start.positions.size(); ++v) {
    first.push_back(pattern(surface.coordinate[v], wave));
    surface.color[v] = Vec4f(first[v], first[v], first[v], 1.0f);
  }
  for (int step = 1; step <= frames; ++step) {
    const SurfaceMesh next =
        riding ? mappedMesh(start, exponential(rotationAbout({0, 0, 1}, angle * step))) : start;
    surface = continued(carry(surface, frame, next), next);
  }
  std::vector<float> color, coordinate;
  for (std::size_t v = 0; v < start.positions.size(); ++v) {
    color.push_back(surface.color[v][0]);
    coordinate.push_back(pattern(surface.coordinate[v], wave));
  }
  const double before = sharpness(start, first);
  return {sharpness(start, color) / before, sharpness(start, coordinate) / before};
}

}  // namespace

TEST_CASE("pick-up: coordinates keep a pattern sharp over 60 frames, colours blur", "[transport]") {
  const Left fixed = sharpnessLeft(false, 60), riding = sharpnessLeft(true, 60);
  std::printf("sharpness left after 60 frames: colour %.3f, riding %.3f; coordinate %.3f, riding %.3f\n",
              fixed.color, riding.color, fixed.coordinate, riding.coordinate);
  CHECK(fixed.color < 0.2);
  CHECK(fixed.coordinate > 0.9);
  CHECK(fixed.coordinate < 1.1);
  CHECK(riding.color > 0.95);
  CHECK(riding.coordinate == Approx(1.0).epsilon(0.02));
}

TEST_CASE("pick-up: a texel is the nearest corner's, offset and turned into the place's plane",
          "[transport]") {
  const SurfaceMesh mesh = sphereMesh(12);
  const TexturedSurface surface = texturedMesh(mesh, constantDirection({1, 0, 0}));
  SurfacePoint point;
  point.triangle = 17;
  point.weight = Vec3f(0.6f, 0.3f, 0.1f);
  const Vec3I& t = mesh.triangles[17];
  for (int i = 0; i < 3; ++i) point.position += Vec3d(mesh.positions[t[i]]) * double(point.weight[i]);
  const Landing landing = landingAt(surface, point);
  REQUIRE(landing.nearestVertex() == t[0]);
  const Texel texel =
      texelAt(surface, surface.coordinate, surface.gradient, landing, Mat3d::identity(), landing.normal);
  const Vec3f offset = Vec3f(point.position) - mesh.positions[t[0]];
  CHECK(texel.coordinate.x() == Approx(surface.coordinate[t[0]].x() + surface.gradient[t[0]].s.dot(offset)));
  CHECK(std::abs(texel.gradient.s.dot(landing.normal)) < 1e-4f * kTexelsPerMeter);
  // Turned, not cut: as long as it was.
  CHECK(texel.gradient.s.length() == Approx(surface.gradient[t[0]].s.length()).epsilon(1e-4));
  CHECK(valueAt(surface.age, landing) == Approx(2.0 + point.position.z()).epsilon(1e-5));
}
