#include "transport/trust.h"

#include "tests/transport/textured_meshes.h"

using namespace fluidtex;
using namespace fluidtex::testing;
using namespace fluidtex::transport;

TEST_CASE("trust: falls with the stretch, whatever turn and axes it comes with", "[transport]") {
  const double spacing = 0.02;
  const auto gradient = [&](double along, double across, double angle) {
    const Vec3f e(float(std::cos(angle)), float(std::sin(angle)), 0.0f), f(-e.y(), e.x(), 0.0f);
    // Singular values along / spacing and across / spacing, in axes turned on both sides.
    const Vec3f a = e * float(along / spacing), b = f * float(across / spacing);
    return texture::TexelGradient{a * 0.6f + b * 0.8f, a * -0.8f + b * 0.6f};
  };
  for (const double angle : {0.0, 0.7, 2.0}) {
    CHECK(stretchTrust(gradient(1, 1, angle), spacing) == 1.0f);
    CHECK(stretchTrust(gradient(1.9, 0.6, angle), spacing) == 1.0f);
    CHECK(stretchTrust(gradient(2.5, 1, angle), spacing) == Approx(0.8).epsilon(1e-4));  // squeezed
    CHECK(stretchTrust(gradient(1, 0.4, angle), spacing) == Approx(0.8).epsilon(1e-4));  // drawn out
    CHECK(stretchTrust(gradient(1, 0, angle), spacing) == Approx(0.6));
  }
}

TEST_CASE("trust: stretch gathers over frames until the texture is renewed", "[transport]") {
  // A flat sheet drawn out to 1.4 times its length in each of three frames.
  const double factor = 1.4;
  const Mat3d draw = matrix(factor, 0, 0, 0, 1 / factor, 0, 0, 0, 1);
  SurfaceMesh mesh = boxMesh({-0.1, -0.1, -0.2}, {0.1, 0.1, 0}, {10, 10, 10});
  TexturedSurface surface = texturedMesh(mesh, constantDirection({1, 0.3, 0}));
  for (texture::TexelGradient& g : surface.gradient)
    g = {Vec3f(1, 0, 0) / float(mesh.spacing), Vec3f(0, 1, 0) / float(mesh.spacing)};
  const Mat3d rate = matrix(std::log(factor), 0, 0, 0, -std::log(factor), 0, 0, 0, 0);
  const sim::Frame frame = steadyFrame({0.05, -30, 30}, 1.0, 8, linearFlow(rate));
  for (const double expected : {1.0, 1.0, 2.0 / (factor * factor * factor)}) {
    const double spacing = surface.spacing;
    const SurfaceMesh next = mappedMesh(mesh, draw);
    const Carried carried = carry(surface, frame, next);
    for (std::size_t v = 0; v < next.positions.size(); ++v) {
      if (next.normals[v].z() > 0.99f)
        REQUIRE(stretchTrust(carried.gradient[v], spacing) == Approx(expected).epsilon(0.01));
    }
    surface = continued(carried, next);
    mesh = next;
  }
}

TEST_CASE("trust: neighbours that landed as the flow says are believed, others are not", "[transport]") {
  const SurfaceMesh mesh = sphereMesh(12);
  const Mat3d turn = exponential(rotationAbout({1, 2, 3}, 1.0));
  const std::vector<Mat3d> map(mesh.positions.size(), turn);
  const std::vector<std::uint8_t> stays(mesh.positions.size(), 0);
  std::vector<Vec3f> landed;
  for (const Vec3f& x : mesh.positions) landed.emplace_back(turn * Vec3d(x));
  for (const float trust : neighborTrust(mesh, landed, map, stays)) REQUIRE(trust == 1.0f);
  // The upper half came from elsewhere; and all that is far left landed in one place.
  for (std::size_t v = 0; v < landed.size(); ++v) {
    if (mesh.positions[v].z() > 0.0f) landed[v] += Vec3f(5, 0, 0);
    if (mesh.positions[v].x() < -0.8f) landed[v] = Vec3f(9, 9, 9);
  }
  const std::vector<float> trust = neighborTrust(mesh, landed, map, stays);
  int torn = 0;
  for (std::size_t v = 0; v < landed.size(); ++v) {
    const Vec3f& x = mesh.positions[v];
    const double edge = 2.0 * mesh.spacing;
    const bool apart = std::abs(x.z()) < 0.1 * edge || (x.x() > -0.8f && x.x() < -0.8f + 0.1 * edge);
    if (apart && x.x() > -0.7f) {
      REQUIRE(trust[v] == 0.0f);
      ++torn;
    }
    if (x.x() < -0.8f - edge) REQUIRE(trust[v] < 0.6f);
    if (std::abs(x.z()) > edge && x.x() > -0.8f + edge) REQUIRE(trust[v] == 1.0f);
  }
  CHECK(torn > 10);
}
