#include "texture/levelset/isosurface.h"

#include "level_sets.h"
#include "tests/texture/mesh/characteristics.h"
#include "texture/mesh/editable_mesh.h"

#include <catch2/catch.hpp>

#include <map>

using namespace fluidtex;
using namespace fluidtex::texture;

namespace {

std::map<long, int> characteristics(const IsoSurface& s) {
  return testing::characteristics(s.positions.size(), s.triangles);
}

// The signs of a block of 4^3 nodes come from the bits of a hash; all around it is outside.
FloatGrid::Ptr noiseGrid(std::uint64_t seed) {
  openvdb::initialize();
  auto grid = FloatGrid::create(3.0f);
  std::uint64_t bits = seed * 0x9e3779b97f4a7c15ULL;
  bits = (bits ^ bits >> 30) * 0xbf58476d1ce4e5b9ULL;
  bits ^= bits >> 27;
  for (int x = -1; x < 5; ++x) {
    for (int y = -1; y < 5; ++y) {
      for (int z = -1; z < 5; ++z) {
        const bool inside =
            x >= 0 && y >= 0 && z >= 0 && x < 4 && y < 4 && z < 4 && (bits >> (x * 16 + y * 4 + z) & 1);
        // Some values are exactly or nearly zero.
        const float size = (x + 2 * y + 3 * z) % 5 == 0 ? 0.0f : (x + y + z) % 7 == 0 ? 1e-30f : 0.7f;
        grid->tree().setValue(openvdb::Coord(x + 6, y + 6, z + 6), inside ? -std::max(size, 1e-30f) : size);
      }
    }
  }
  return grid;
}

// Marching tetrahedra straight from its definition; vertices numbered by the pair of nodes they lie between.
std::map<long, int> tetrahedraCharacteristics(const FloatGrid& phi) {
  using Node = openvdb::Coord;
  std::map<std::pair<Node, Node>, std::uint32_t> numbers;
  std::vector<Vec3I> triangles;
  const auto value = [&](const Node& n) { return phi.tree().getValue(n); };
  const auto vertex = [&](Node a, Node b) {
    if (b < a) std::swap(a, b);
    return numbers.emplace(std::pair(a, b), std::uint32_t(numbers.size())).first->second;
  };
  openvdb::CoordBBox box = phi.evalActiveVoxelBoundingBox();
  for (auto it = box.begin(); it; ++it) {
    std::array<int, 3> axes{0, 1, 2};
    do {
      std::array<Node, 4> n{*it, *it, *it, *it};
      for (std::size_t k = 1; k < 4; ++k) {
        n[k] = n[k - 1];
        ++n[k][axes[k - 1]];
      }
      std::vector<Node> inside, outside;
      for (const Node& node : n) (value(node) < 0.0f ? inside : outside).push_back(node);
      const auto at = [&](std::size_t i, std::size_t o) { return vertex(inside[i], outside[o]); };
      if (inside.size() == 1) triangles.emplace_back(at(0, 0), at(0, 1), at(0, 2));
      if (inside.size() == 3) triangles.emplace_back(at(0, 0), at(1, 0), at(2, 0));
      if (inside.size() == 2) {
        triangles.emplace_back(at(0, 0), at(0, 1), at(1, 1));
        triangles.emplace_back(at(0, 0), at(1, 1), at(1, 0));
      }
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  return testing::characteristics(numbers.size(), triangles);
}

}  // namespace

TEST_CASE("isosurface: closed and manifold for any signs, with the topology of marching tetrahedra") {
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const FloatGrid::Ptr grid = noiseGrid(seed);
    const IsoSurface surface = isoSurface(LevelSet(*grid));
    INFO("seed " << seed);
    REQUIRE(isClosedManifold(surface.positions.size(), surface.triangles));
    REQUIRE(characteristics(surface) == tetrahedraCharacteristics(*grid));
  }
}

TEST_CASE("isosurface: one inside node gives an octahedron around it, facing outwards") {
  const IsoSurface surface = isoSurface(LevelSet(*oneVoxelGrid(0.1)));
  REQUIRE(surface.positions.size() == 6);
  REQUIRE(surface.triangles.size() == 8);
  for (const Vec3I& t : surface.triangles) {
    const Vec3f a = surface.positions[t[0]], b = surface.positions[t[1]], c = surface.positions[t[2]];
    REQUIRE((b - a).cross(c - a).dot(a + b + c) > 0.0f);
  }
}

TEST_CASE("isosurface: area and topology of closed forms") {
  const double voxel = 0.05;
  const IsoSurface sphere = isoSurface(LevelSet(*sphereGrid(1.0, voxel)));
  CHECK(area(sphere.positions, sphere.triangles) * voxel * voxel == Approx(4.0 * M_PI).epsilon(0.005));
  CHECK(characteristics(sphere) == std::map<long, int>{{2, 1}});
  const IsoSurface torus = isoSurface(LevelSet(*torusGrid(1.0, 0.4, voxel)));
  CHECK(area(torus.positions, torus.triangles) * voxel * voxel ==
        Approx(4.0 * M_PI * M_PI * 0.4).epsilon(0.005));
  CHECK(characteristics(torus) == std::map<long, int>{{0, 1}});
}

TEST_CASE("isosurface: a tile of inside values without leaves around it is closed too") {
  openvdb::initialize();
  auto grid = FloatGrid::create(1.0f);
  grid->tree().addTile(1, openvdb::Coord(16, 8, 0), -1.0f, false);
  const IsoSurface surface = isoSurface(LevelSet(*grid));
  REQUIRE(isClosedManifold(surface.positions.size(), surface.triangles));
  REQUIRE(characteristics(surface) == std::map<long, int>{{2, 1}});
}
