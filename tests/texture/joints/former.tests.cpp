#include "texture/joints/former.h"

#include "tests/texture/joints/sheets.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

const Piece kNow{{10.0f, 10.0f}, {{10.0f, 0.0f, 0.0f}, {0.0f, 10.0f, 0.0f}}};

// Vertices i + 3 j of a flat sheet, with edges along x, along y and along (1, 1).
TexturedSurface threeByThree() {
  TexturedSurface sheet = flatSheet(3);
  layPieces(
      {kNow}, [](const Vec3f&) { return 0; }, false, sheet);
  // Where nothing fades the former coordinate means nothing.
  std::fill(sheet.fading.coordinate.begin(), sheet.fading.coordinate.end(), Vec2f(NAN, NAN));
  return sheet;
}

void fade(TexturedSurface& sheet, std::uint32_t v, float weight) {
  sheet.fading.coordinate[v] = {float(100 * v), 5.0f};
  sheet.fading.gradient[v] = {{float(v), 0.0f, 0.0f}, {0.0f, 20.0f, 0.0f}};
  sheet.fading.weight[v] = weight;
}

// That the vertex has what once was at `source`, continued to it.
void checkFrom(const TexturedSurface& sheet, const Former& former, std::uint32_t v, std::uint32_t source) {
  CHECK(former.known[v] == 1);
  const Vec3f way = sheet.positions[v] - sheet.positions[source];
  CHECK(former.places.coordinate[v][0] == Approx(float(100 * source) + float(source) * way.x()));
  CHECK(former.places.coordinate[v][1] == Approx(5.0f + 20.0f * way.y()));
  CHECK(former.places.gradient[v].s == Vec3f(float(source), 0.0f, 0.0f));
  CHECK(former.places.gradient[v].t == Vec3f(0.0f, 20.0f, 0.0f));
}

void checkPresent(const TexturedSurface& sheet, const Former& former, std::uint32_t v) {
  CHECK(former.known[v] == 0);
  CHECK(former.places.coordinate[v] == sheet.coordinate[v]);
  CHECK(former.places.gradient[v].s == sheet.gradient[v].s);
}

}  // namespace

TEST_CASE("former: where nothing fades, the present places stand") {
  TexturedSurface sheet = threeByThree();
  const bool arrays = GENERATE(false, true);
  if (!arrays) sheet.fading = {};
  const Former former = formerPlaces(sheet);
  REQUIRE(former.known.size() == 9);
  for (std::uint32_t v = 0; v < 9; ++v) checkPresent(sheet, former, v);
}

TEST_CASE("former: a vertex that fades has its own, its neighbours have it continued, others none") {
  TexturedSurface sheet = threeByThree();
  fade(sheet, 1, 0.1f);
  const Former former = formerPlaces(sheet);
  for (const std::uint32_t v : {0u, 1u, 2u, 4u, 5u}) checkFrom(sheet, former, v, 1);
  for (const std::uint32_t v : {3u, 6u, 7u, 8u}) checkPresent(sheet, former, v);
}

TEST_CASE(
    "former: of neighbours that fade, the one with the largest weight counts, and of equal ones the first") {
  TexturedSurface sheet = threeByThree();
  fade(sheet, 1, 0.2f);
  fade(sheet, 3, 0.7f);
  fade(sheet, 5, 0.7f);
  const Former former = formerPlaces(sheet);
  // What fades, however little, keeps its own beside what fades more.
  for (const std::uint32_t v : {1u, 3u, 5u}) checkFrom(sheet, former, v, v);
  checkFrom(sheet, former, 4, 3);
  checkFrom(sheet, former, 0, 3);
  checkFrom(sheet, former, 2, 5);
  checkFrom(sheet, former, 7, 3);
  checkFrom(sheet, former, 8, 5);
  fade(sheet, 5, 0.8f);
  checkFrom(sheet, formerPlaces(sheet), 4, 5);
}

TEST_CASE("former: the same on any number of threads, in whatever order the triangles come") {
  TexturedSurface torus = patchedTorus(60, 2);
  const Former one = onThreads(1, [&] { return formerPlaces(torus); });
  const Former many = onThreads(7, [&] { return formerPlaces(torus); });
  CHECK(one.places.coordinate == many.places.coordinate);
  CHECK(one.known == many.known);
  std::reverse(torus.triangles.begin(), torus.triangles.end());
  const Former reversed = formerPlaces(torus);
  CHECK(one.places.coordinate == reversed.places.coordinate);
  CHECK(one.known == reversed.known);
}
