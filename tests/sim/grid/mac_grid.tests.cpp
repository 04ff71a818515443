#include "sim/grid/mac_grid.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace fluidtex::sim;

TEST_CASE("mac_grid: samples sit at cell centres and lower face centres") {
  const double h = 0.25;
  const Coord ijk(3, -1, 7);
  const auto near = [](const Vec3d& a, const Vec3d& b) { return (a - b).length() < 1e-12; };
  CHECK(near(cellTransform(h)->indexToWorld(ijk), Vec3d(3.5, -0.5, 7.5) * h));
  CHECK(near(faceTransform(h, 0)->indexToWorld(ijk), Vec3d(3.0, -0.5, 7.5) * h));
  CHECK(near(faceTransform(h, 1)->indexToWorld(ijk), Vec3d(3.5, -1.0, 7.5) * h));
  CHECK(near(faceTransform(h, 2)->indexToWorld(ijk), Vec3d(3.5, -0.5, 7.0) * h));
}

TEST_CASE("mac_grid: a copy has the same transforms to the last bit") {
  const double h = 1.0 / 24;
  Velocity velocity = makeVelocity(h);
  for (int copies = 0; copies < 3; ++copies) velocity = copyOf(velocity);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(velocity.component[axis]->voxelSize() == makeVelocity(h).component[axis]->voxelSize());
    CHECK(velocity.component[axis]->worldToIndex(Vec3d(0.3, 0.2, 0.1)) ==
          faceTransform(h, axis)->worldToIndex(Vec3d(0.3, 0.2, 0.1)));
  }
}

TEST_CASE("mac_grid: cells cover the domain and no more") {
  CHECK(cellCount(Vec3d(1.0, 0.5, 0.51), 1.0 / 64) == Coord(64, 32, 33));
  CHECK(cellCount(Vec3d(0.3, 0.1, 0.01), 0.1) == Coord(3, 1, 1));
}

TEST_CASE("mac_grid: a gathered block is what an accessor reads") {
  FloatTree tree(7.0f);
  auto value = [](const Coord& c) { return static_cast<float>(c.x() + 100 * c.y() + 10000 * c.z()); };
  // Two of the neighbours exist, the others are background or tiles.
  for (const Coord& origin : {Coord(8, 8, 8), Coord(0, 8, 8), Coord(16, 16, 8)}) {
    FloatLeaf* leaf = tree.touchLeaf(origin);
    for (int n = 0; n < kLeafSize; ++n) leaf->setValueOn(n, value(leaf->offsetToGlobalCoord(n)));
  }
  tree.addTile(1, Coord(8, 0, 8), -3.0f, false);
  for (int n = 0; n < 6; ++n) tree.addTile(1, Coord(0, 16 * (n / 3), 8 * (n % 3)), 10.0f + float(n), false);
  for (const int halo : {0, 1, 3, 8}) {
    const int side = kLeafDim + 2 * halo;
    std::vector<float> block(static_cast<std::size_t>(side) * side * side,
                             std::numeric_limits<float>::quiet_NaN());
    gather(tree, Coord(8, 8, 8), halo, block.data());
    int wrong = 0;
    for (int i = 0; i < side; ++i) {
      for (int j = 0; j < side; ++j) {
        for (int k = 0; k < side; ++k) {
          const float expected = tree.getValue(Coord(8 + i - halo, 8 + j - halo, 8 + k - halo));
          if (block[static_cast<std::size_t>((i * side + j) * side + k)] != expected) ++wrong;
        }
      }
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("mac_grid: the largest component, and infinity for what is not a number") {
  Velocity velocity = makeVelocity(0.1);
  velocity.component[1]->tree().setValue(Coord(1, 2, 3), -4.0f);
  velocity.component[2]->tree().setValue(Coord(-1, 2, 3), 3.0f);
  CHECK(maxAbs(velocity) == 4.0);
  velocity.component[0]->tree().setValue(Coord(100, 0, 0), std::numeric_limits<float>::quiet_NaN());
  CHECK(std::isinf(maxAbs(velocity)));
}

TEST_CASE("mac_grid: a halo beyond the neighbouring leaves is refused", "[sim]") {
  const FloatTree tree(1.0f);
  std::vector<float> out(40 * 40 * 40);
  CHECK_NOTHROW(gather(tree, Coord(0), kLeafDim, out.data()));
  CHECK_THROWS_AS(gather(tree, Coord(0), kLeafDim + 1, out.data()), std::invalid_argument);
  CHECK_THROWS_AS(gather(tree, Coord(0), -1, out.data()), std::invalid_argument);
}
