#include "sim/meshes/closed_surface.h"

#include <catch2/catch.hpp>

#include <vector>

using namespace fluidtex::sim;

namespace {

// The four faces of a tetrahedron.
const Polygons kTetrahedron{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

}  // namespace

TEST_CASE("closed surface: corners named twice in a row are one, also where the polygon begins", "[sim]") {
  CHECK(withoutRepeats({1, 1, 2, 3, 3, 3}) == std::vector<std::size_t>{1, 2, 3});
  CHECK(withoutRepeats({1, 2, 1}).size() == 2);
  CHECK(withoutRepeats({1, 2, 3, 2}) == std::vector<std::size_t>{1, 2, 3, 2});
  CHECK(withoutRepeats({4, 4, 4}) == std::vector<std::size_t>{4});
}

TEST_CASE("closed surface: edges of a rim and of a face that meets it from inside", "[sim]") {
  CHECK(openEdges(kTetrahedron).none());
  Polygons faces = kTetrahedron;
  faces.pop_back();
  CHECK(openEdges(faces).ofOne == 3);
  CHECK(openEdges(faces).ofMore == 0);
  faces = kTetrahedron;
  faces.push_back({0, 1, 4});
  CHECK(openEdges(faces).ofOne == 2);
  CHECK(openEdges(faces).ofMore == 1);
}

TEST_CASE("closed surface: of twins none or one is kept, as closes the surface", "[sim]") {
  // Two tetrahedra on both sides of a face of their own: the wall goes.
  Polygons faces = kTetrahedron;
  for (const auto& face : Polygons{{1, 3, 2}, {1, 2, 4}, {1, 4, 3}, {2, 3, 4}}) faces.push_back(face);
  CHECK(withoutTwins(faces).size() == 6);
  CHECK(openEdges(withoutTwins(faces)).none());
  // Every face twice: one of each stays.
  faces = kTetrahedron;
  faces.insert(faces.end(), kTetrahedron.begin(), kTetrahedron.end());
  CHECK(withoutTwins(faces).size() == 4);
  // What no rule closes comes back as it is.
  faces = {{0, 1, 2}, {2, 1, 0}, {0, 1, 3}};
  CHECK(withoutTwins(faces) == faces);
}

TEST_CASE("closed surface: the fan of a concave polygon starts at the corner that sees all others", "[sim]") {
  const std::vector<Vec3d> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  CHECK(bestFan(square).isWhole);
  const std::vector<Vec3d> arrow{{0, 0, 0}, {2, 1, 0}, {4, 0, 0}, {2, 4, 0}};
  CHECK(bestFan(arrow).isWhole);
  CHECK(bestFan(arrow).start % 2 == 1);
  // A comb of three prongs has no such corner.
  std::vector<Vec3d> comb{{0, 0, 0}, {5, 0, 0}};
  for (const int x : {4, 2, 0}) {
    comb.emplace_back(x + 1, 3, 0);
    comb.emplace_back(x, 3, 0);
    if (x > 0) comb.emplace_back(x, 1, 0);
    if (x > 0) comb.emplace_back(x - 1, 1, 0);
  }
  CHECK_FALSE(bestFan(comb).isWhole);
}
