#include "texture/joints/cut.h"

#include "tests/texture/joints/sheets.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <map>
#include <set>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

double areaOf(const TexturedSurface& surface, std::uint32_t t) {
  const Vec3I& c = surface.triangles[t];
  const Vec3f& a = surface.positions[c[0]];
  return 0.5 * double((surface.positions[c[1]] - a).cross(surface.positions[c[2]] - a).length());
}

// Edges of the surface as a set of points: how often each is passed one way less how often the other way.
std::map<std::array<float, 6>, int> boundary(const TexturedSurface& surface) {
  std::map<std::array<float, 6>, int> passes;
  for (const Vec3I& c : surface.triangles)
    for (int k = 0; k < 3; ++k) {
      const Vec3f &a = surface.positions[c[k]], &b = surface.positions[c[(k + 1) % 3]];
      const std::array<float, 3> from{a[0], a[1], a[2]}, to{b[0], b[1], b[2]};
      const bool up = from < to;
      const auto &low = up ? from : to, &high = up ? to : from;
      passes[{low[0], low[1], low[2], high[0], high[1], high[2]}] += up ? 1 : -1;
    }
  std::erase_if(passes, [](const auto& edge) { return edge.second == 0; });
  return passes;
}

// Largest deviation in a triangle of a coordinate from what the gradient at each corner says.
float deviation(const TexturedSurface& s, const std::vector<Vec2f>& coordinate,
                const std::vector<TexelGradient>& gradient, const Vec3I& c) {
  float largest = 0.0f;
  for (int k = 0; k < 3; ++k)
    for (int l = 0; l < 3; ++l) {
      const Vec2f there = continued(coordinate[c[k]], gradient[c[k]], s.positions[c[l]] - s.positions[c[k]]);
      largest = std::max(largest, (coordinate[c[l]] - there).length());
    }
  return largest;
}

}  // namespace

TEST_CASE("cut: a surface of one piece, or without coordinates, stays as it is") {
  TexturedSurface sheet = flatSheet(5);
  layPieces(
      {Piece{{3, 3}, {{9, 0, 0}, {0, 9, 0}}}}, [](const Vec3f&) { return 0; }, false, sheet);
  const bool without = GENERATE(false, true);
  if (without) sheet.coordinate.clear();
  const CutSurface cut = cutAtJoints(sheet, false);
  CHECK(cut.surface.positions == sheet.positions);
  CHECK(cut.surface.triangles == sheet.triangles);
  CHECK(cut.surface.coordinate == sheet.coordinate);
  REQUIRE(cut.origin.size() == sheet.positions.size());
  REQUIRE(cut.triangle.size() == sheet.triangles.size());
  for (std::uint32_t v = 0; v < cut.origin.size(); ++v) CHECK(cut.origin[v].vertex[0] == v);
  for (std::uint32_t t = 0; t < cut.triangle.size(); ++t) CHECK(cut.triangle[t] == t);
}

TEST_CASE("cut: of two pieces of a sheet, the coordinates are each piece's on its side of the middle") {
  const Piece left{{10, 10}, {{10, 0, 0}, {0, 10, 0}}}, right{{40, 20}, {{0, -8, 0}, {12, 3, 0}}};
  TexturedSurface sheet = flatSheet(10);
  layPieces(
      {left, right}, [](const Vec3f& x) { return x.x() < 0.45f ? 0u : 1u; }, false, sheet);
  const CutSurface cut = cutAtJoints(sheet, false);
  const TexturedSurface& s = cut.surface;
  std::size_t onCut = 0;
  for (const Vec3I& c : s.triangles) {
    const Vec3f centre = (s.positions[c[0]] + s.positions[c[1]] + s.positions[c[2]]) / 3.0f;
    const Piece& piece = centre.x() < 0.45f ? left : right;
    for (int k = 0; k < 3; ++k) {
      CHECK((s.coordinate[c[k]] - piece.at(s.positions[c[k]])).length() < 1e-4f);
      CHECK(s.gradient[c[k]].s == piece.gradient.s);
      onCut += std::abs(s.positions[c[k]].x() - 0.45f) < 1e-4f;
    }
  }
  CHECK(onCut > 0);
}

TEST_CASE("cut: what is not of a piece is interpolated, the rest is the side's") {
  const Piece left{{10, 10}, {{10, 0, 0}, {0, 10, 0}}}, right{{40, 20}, {{0, -8, 0}, {12, 3, 0}}};
  TexturedSurface sheet = flatSheet(10);
  layPieces(
      {left, right}, [](const Vec3f& x) { return x.x() + x.y() < 0.83f ? 0u : 1u; }, false, sheet);
  const CutSurface cut = cutAtJoints(sheet, false);
  const TexturedSurface& s = cut.surface;
  CHECK(s.positions.size() > sheet.positions.size());
  for (std::size_t v = 0; v < s.positions.size(); ++v) {
    const float x = s.positions[v].x(), y = s.positions[v].y();
    const Origin& origin = cut.origin[v];
    Vec3f mean(0.0f);
    float sum = 0.0f;
    for (std::size_t k = 0; k < 3; ++k) {
      mean += sheet.positions[origin.vertex[k]] * origin.weight[k];
      sum += origin.weight[k];
    }
    CHECK(sum == Approx(1.0f));
    CHECK((mean - s.positions[v]).length() < 1e-6f);
    CHECK(s.age[v] == Approx(x - 2.0f * y).margin(1e-5));
    CHECK(s.color[v][0] == Approx(0.1f * x).margin(1e-6));
    CHECK(s.maps.at("height")[v] == Approx(3.0f * x + y).margin(1e-5));
    CHECK(s.velocity[v].x() == Approx(y).margin(1e-6));
    CHECK(s.previousPosition[v].x() == Approx(x - 1.0f).margin(1e-6));
    CHECK(s.normals[v] == Vec3f(0.0f, 0.0f, 1.0f));
    CHECK(s.orientation[v] == Vec3f(1.0f, 0.0f, 0.0f));
    CHECK((s.vectors.at("grain")[v].x() == 1.0f || s.vectors.at("grain")[v].y() == 1.0f));
    CHECK((s.contact[v] == 0 || s.contact[v] == 1));
  }
}

TEST_CASE("cut: three pieces meet at the middle of their triangle") {
  const std::vector<Piece> pieces{{{10, 10}, {{10, 0, 0}, {0, 10, 0}}},
                                  {{40, 20}, {{0, -8, 0}, {12, 3, 0}}},
                                  {{25, 30}, {{-10, 0, 0}, {0, 10, 0}}}};
  TexturedSurface one = flatSheet(2);
  one.triangles.resize(1);  // corners 0, 1, 3
  layPieces(
      pieces, [](const Vec3f& x) { return x.x() < 0.05f   ? 0u
                                          : x.y() < 0.05f ? 1u
                                                          : 2u; }, false, one);
  const CutSurface cut = cutAtJoints(one, false);
  REQUIRE(cut.surface.triangles.size() == 6);
  double area = 0.0;
  std::array<double, 3> ofPiece{};
  for (std::uint32_t t = 0; t < 6; ++t) {
    const Vec3I& c = cut.surface.triangles[t];
    for (std::size_t p = 0; p < 3; ++p) {
      bool all = true;
      for (int k = 0; k < 3; ++k)
        all = all &&
              (cut.surface.coordinate[c[k]] - pieces[p].at(cut.surface.positions[c[k]])).length() < 1e-3f;
      if (all) ofPiece[p] += areaOf(cut.surface, t);
    }
    area += areaOf(cut.surface, t);
  }
  CHECK(area == Approx(areaOf(one, 0)));
  for (const double part : ofPiece) CHECK(part == Approx(area / 3.0));
}

TEST_CASE("cut: the same points, closed, every triangle of one piece without a jump") {
  const auto seed = GENERATE(std::uint64_t(1), std::uint64_t(2), std::uint64_t(3));
  const bool toroidal = GENERATE(false, true);
  const TexturedSurface torus = patchedTorus(40, seed);
  const CutSurface cut = cutAtJoints(torus, toroidal);
  const TexturedSurface& s = cut.surface;
  REQUIRE(boundary(torus).empty());
  CHECK(boundary(s).empty());
  REQUIRE(cut.triangle.size() == s.triangles.size());
  std::vector<double> area(torus.triangles.size(), 0.0);
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
    const Vec3I &c = s.triangles[t], &of = torus.triangles[cut.triangle[t]];
    area[cut.triangle[t]] += areaOf(s, t);
    CHECK(deviation(s, s.coordinate, s.gradient, c) < 2.0f * kOnePiece);
    bool fades = false;
    for (int k = 0; k < 3; ++k) {
      fades = fades || s.fading.weight[c[k]] > 0.0f;
      const Origin& origin = cut.origin[c[k]];
      for (std::size_t i = 0; i < 3; ++i)
        if (origin.weight[i] > 0.0f)
          CHECK((origin.vertex[i] == of[0] || origin.vertex[i] == of[1] || origin.vertex[i] == of[2]));
    }
    if (fades) CHECK(deviation(s, s.fading.coordinate, s.fading.gradient, c) < 2.0f * kOnePiece);
  }
  for (std::uint32_t t = 0; t < area.size(); ++t) CHECK(area[t] == Approx(areaOf(torus, t)));
  std::set<std::uint32_t> used;
  for (const Vec3I& c : s.triangles) used.insert({c[0], c[1], c[2]});
  CHECK(used.size() == s.positions.size());
}

TEST_CASE("cut: the same on any number of threads") {
  const TexturedSurface torus = patchedTorus(60, 4);
  const CutSurface one = onThreads(1, [&] { return cutAtJoints(torus, true); });
  const CutSurface many = onThreads(7, [&] { return cutAtJoints(torus, true); });
  CHECK(one.surface.triangles == many.surface.triangles);
  CHECK(one.surface.positions == many.surface.positions);
  CHECK(one.surface.coordinate == many.surface.coordinate);
  CHECK(one.surface.fading.coordinate == many.surface.fading.coordinate);
}
