#include "texture/shown/rest_positions.h"

#include "tests/texture/shown/oriented_sphere.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex;
using namespace fluidtex::testing;
using namespace fluidtex::texture;

namespace {

constexpr int kSize = 8;

// Red grows to the right and green downwards.
Image ramp() {
  Image image{kSize, kSize, 4, {}};
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x)
      for (const float value : {float(x) / kSize, float(y) / kSize, 0.0f, 1.0f}) image.data.push_back(value);
  return image;
}

// What a surface hands on that has moved by `step`.
Carried movedBy(const TexturedSurface& last, const Vec3f& step) {
  Carried carried;
  static_cast<VertexTexture&>(carried) = last;
  carried.orientation = last.orientation;
  carried.trust.assign(last.positions.size(), 1.0f);
  carried.previousPosition = last.positions;
  for (Vec3f& x : carried.previousPosition) x -= step;
  return carried;
}

std::size_t nearest(const SurfaceMesh& mesh, const Vec3f& normal) {
  std::size_t best = 0;
  for (std::size_t v = 0; v < mesh.normals.size(); ++v)
    if (mesh.normals[v].dot(normal) > mesh.normals[best].dot(normal)) best = v;
  return best;
}

}  // namespace

TEST_CASE("rest positions: at first the picture is projected from where the surface is", "[texture]") {
  const Image image = ramp();
  const Surface surface = orientedSphere();
  const SurfaceMesh& mesh = surface.levels[0];
  const TexturedSurface first = restTextured(surface, {}, image, {}, 1, 0.1);
  CHECK(first.rest == mesh.positions);
  CHECK(first.secondRest.empty());
  // On top the rows run along x, and y is up in the picture.
  const std::size_t top = nearest(mesh, Vec3f(0, 0, 1));
  const auto mirrored = [](float texel) {
    const float period = 2.0f * kSize, inside = texel - period * std::floor(texel / period);
    return inside < kSize ? inside : period - 1.0f - inside;
  };
  const Vec3f x = mesh.positions[top] / float(mesh.spacing);
  CHECK(first.color[top][0] == Approx(mirrored(x[0]) / kSize).margin(0.13));
  CHECK(first.color[top][1] == Approx(mirrored(-x[1]) / kSize).margin(0.13));
  for (const Vec4f& color : first.color) CHECK(color[3] == Approx(1.0f));
}

TEST_CASE("rest positions: those that are believed are carried, others are the present ones", "[texture]") {
  const Image image = ramp();
  Surface surface = orientedSphere();
  const TexturedSurface first = restTextured(surface, {}, image, {}, 1, 0.1);
  Carried carried = movedBy(first, Vec3f(0.5f, 0, 0));
  for (Vec3f& x : surface.levels[0].positions) x += Vec3f(0.5f, 0, 0);
  carried.trust[3] = 0.1f;
  const TexturedSurface second = restTextured(surface, carried, image, {}, 2, 0.1);
  for (std::size_t v = 0; v < second.positions.size(); ++v) {
    if (v == 3) {
      CHECK(second.rest[v] == second.positions[v]);
      CHECK(second.age[v] == 0.0f);
      continue;
    }
    CHECK(second.rest[v] == first.rest[v]);
    CHECK(second.age[v] == Approx(0.1f));
    CHECK((second.color[v] - first.color[v]).length() < 1e-5f);
  }
  CHECK(second.previousPosition == carried.previousPosition);
}

TEST_CASE("rest positions: two are reset in turn, each when it weighs nothing", "[texture]") {
  const Image image = ramp();
  Surface surface = orientedSphere();
  const RestOptions dual{.every = 3};
  const Vec3f step(0.1f, 0.0f, 0.0f);
  TexturedSurface last = restTextured(surface, {}, image, dual, 1, 0.1);
  const std::vector<Vec3f> start = last.positions;
  const auto stepsOf = [&](const Vec3f& rest) { return int(std::lround((rest - start[5])[0] / step[0])); };
  // The first is reset in frames 1, 7, ..., the second in 4, 10, ...
  const int first[] = {0, 0, 0, 0, 0, 6, 6, 6}, second[] = {0, 0, 3, 3, 3, 3, 3, 3};
  for (int frame = 2; frame < 10; ++frame) {
    for (Vec3f& x : surface.levels[0].positions) x += step;
    const TexturedSurface next = restTextured(surface, movedBy(last, step), image, dual, frame, 0.1);
    INFO(frame);
    CHECK(stepsOf(next.rest[5]) == first[frame - 2]);
    CHECK(stepsOf(next.secondRest[5]) == second[frame - 2]);
    last = next;
  }
  // In frame 4 the second has just been reset: the first alone is seen, which rides with the surface.
  surface = orientedSphere();
  TexturedSurface seen = restTextured(surface, {}, image, dual, 1, 0.1);
  const TexturedSurface single = restTextured(surface, {}, image, {}, 1, 0.1);
  for (int frame = 2; frame < 5; ++frame) {
    for (Vec3f& x : surface.levels[0].positions) x += step;
    seen = restTextured(surface, movedBy(seen, step), image, dual, frame, 0.1);
  }
  for (std::size_t v = 0; v < seen.color.size(); ++v)
    CHECK((seen.color[v] - single.color[v]).length() < 1e-5f);
}
