#include "texture/labels/pieces.h"

#include "tests/texture/orientation/oriented_mesh.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

TEST_CASE("pieces: components of a mask, in the order of their first vertex") {
  const SurfaceMesh mesh = together(sphereMesh(3, 1.0, {0, 0, 0}), sphereMesh(3, 1.0, {5, 0, 0}));
  const VertexGraph graph = buildVertexGraph(mesh);
  std::vector<std::uint8_t> mask(mesh.positions.size());
  // The first ball without its belt: two caps; the second whole.
  for (std::size_t v = 0; v < mask.size(); ++v)
    mask[v] = mesh.positions[v].x() > 2.0f || std::abs(mesh.positions[v].z()) > 0.45f;
  std::vector<std::vector<std::uint32_t>> pieces;
  forEachPiece(graph, mask, [&](const std::vector<std::uint32_t>& piece) { pieces.push_back(piece); });
  REQUIRE(pieces.size() == 3);
  std::size_t members = 0;
  std::uint32_t last = 0;
  for (const auto& piece : pieces) {
    CHECK(piece.front() == *std::min_element(piece.begin(), piece.end()));
    CHECK(piece.front() >= last);
    last = piece.front();
    members += piece.size();
    for (const std::uint32_t v : piece) {
      CHECK(mask[v] == 1);
      CHECK((mesh.positions[v].x() > 2.0f) == (mesh.positions[piece[0]].x() > 2.0f));
      if (mesh.positions[v].x() < 2.0f)
        CHECK((mesh.positions[v].z() > 0.0f) == (mesh.positions[piece[0]].z() > 0.0f));
    }
  }
  CHECK(members == std::size_t(std::count(mask.begin(), mask.end(), 1)));
}

TEST_CASE("pieces: half-edges that do not join part them") {
  const SurfaceMesh mesh = sphereMesh(3);
  const VertexGraph graph = buildVertexGraph(mesh);
  const std::vector<std::uint8_t> all(mesh.positions.size(), 1);
  int count = 0;
  forEachPiece(
      graph, all,
      [&](std::uint32_t v, std::uint32_t h) {
        return (mesh.positions[v].z() > 0.0f) == (mesh.positions[graph.neighbor[h]].z() > 0.0f);
      },
      [&](const std::vector<std::uint32_t>&) { ++count; });
  CHECK(count == 2);
}
