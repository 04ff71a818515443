#include "sim/markers/stray_markers.h"

#include "numerics/random.h"
#include "sim/solids/solids.h"
#include "tests/sim/markers/unit_cube.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <set>

using namespace fluidtex::sim;

namespace {

// A quarter of a cell above the middle of a cell.
constexpr double kLevel = 0.5 + 0.75 * kVoxel;

double pool(const Vec3d& x) {
  return x[2] - kLevel;
}

// Heights from the level, in cells.
float heightOf(const MarkerBlock& block, const Marker& m) {
  return static_cast<float>((worldOf(block, m)[2] - kLevel) / kVoxel);
}

// A marker in the middle of the cube at a height, in cells; the block that it belongs to is there.
void add(Markers& markers, float height, float radius) {
  const float z = height + 0.75f + 16.0f - 0.5f;  // from the centre of the first cell of all
  const int first = static_cast<int>(z) & ~(kLeafDim - 1);
  MarkerBlock* block = findBlock(markers, Coord(16, 16, first));
  REQUIRE(block != nullptr);
  block->markers.push_back({4.3f, 4.2f, z - float(first), radius});
}

// How many of those added are left: no other has the same y.
int added(const Markers& markers) {
  int count = 0;
  for (const MarkerBlock& block : markers)
    for (const Marker& m : block.markers) count += m.y == 4.2f;
  return count;
}

// How many of the markers are among the present ones.
std::size_t leftOf(const Markers& markers, const Markers& present) {
  std::size_t count = 0;
  for (const MarkerBlock& block : markers) {
    std::set<std::array<float, 3>> places;
    const MarkerBlock* now = findBlock(present, block.origin);
    if (now != nullptr)
      for (const Marker& m : now->markers) places.insert({m.x, m.y, m.z});
    for (const Marker& m : block.markers) count += places.count({m.x, m.y, m.z});
  }
  return count;
}

}  // namespace

TEST_CASE("stray markers: one alone goes, of air and of liquid") {
  for (const float side : {-1.0f, 1.0f}) {
    for (const float depth : {0.15f, 0.4f, 0.9f}) {
      INFO("side " << side << ", depth " << depth);
      const auto phi = phiOf(pool);
      Markers markers = seedMarkers(*phi, *noSolid(), 1);
      const Markers others = markers;
      add(markers, -side * depth, side * 0.1f);
      maintainMarkers(markers, *phi, *noSolid(), 2);
      CHECK(added(markers) == 0);
      CHECK(leftOf(others, markers) == countOf(others));
    }
  }
}

TEST_CASE("stray markers: a drop more than a cell off stays") {
  const auto phi = phiOf(pool);
  Markers markers = seedMarkers(*phi, *noSolid(), 1);
  add(markers, 1.2f, -0.1f);
  maintainMarkers(markers, *phi, *noSolid(), 2);
  CHECK(added(markers) == 1);
}

TEST_CASE("stray markers: liquid and air that the grid has lost together stay") {
  for (const float side : {-1.0f, 1.0f}) {
    Markers markers = seedMarkers(*phiOf(pool), *noSolid(), 1);
    // The grid has lost four tenths of a cell of that side's.
    const auto phi = phiOf([&](const Vec3d& x) { return pool(x) - side * 0.4 * kVoxel; });
    const auto lost = [&] {
      std::size_t count = 0;
      for (const MarkerBlock& block : markers) {
        for (const Marker& m : block.markers) {
          const float off = heightOf(block, m) - side * 0.4f;
          // Beyond the cube phi is not known.
          count += m.radius * side > 0.0f && side * off < -0.15f &&
                   (worldOf(block, m) - Vec3d(0.5)).length() < 0.3;
        }
      }
      return count;
    };
    const std::size_t before = lost();
    CHECK(before > 500);
    maintainMarkers(markers, *phi, *noSolid(), 2);
    CHECK(lost() == before);
  }
}

TEST_CASE("stray markers: the last of a film stays, for the film has no depth") {
  const auto film = [](const Vec3d& x) { return std::abs(pool(x)) - 0.4 * kVoxel; };
  Markers markers = seedMarkers(*phiOf(film), *noSolid(), 1);
  for (MarkerBlock& block : markers)
    std::erase_if(block.markers, [](const Marker& m) { return m.radius < 0.0f; });
  add(markers, 0.8f, -0.1f);
  maintainMarkers(markers, *phiOf(film), *noSolid(), 2);
  CHECK(added(markers) == 1);
}

TEST_CASE("stray markers: those beside thin walls stay") {
  Options options;
  options.resolution = kCells;
  options.solids.resize(1);
  options.solids[0].shape = {Box{Vec3d(0.5 + 7.0 * kVoxel, -1.0, -1.0), Vec3d(0.5 + 7.8 * kVoxel, 2.0, 2.0)}};
  const auto solid = Solids(options).at(0.0);
  REQUIRE(solid->visibility != nullptr);
  const auto phi = phiOf(pool);
  const auto left = [&](const Visibility* visibility) {
    Markers markers = seedMarkers(*phi, *solid->phi, 1, visibility);
    add(markers, -0.4f, 0.1f);
    maintainMarkers(markers, *phi, *solid->phi, 2, visibility);
    return added(markers);
  };
  CHECK(left(nullptr) == 0);
  CHECK(left(solid->visibility.get()) == 1);
}

TEST_CASE("stray markers: bubbles and drops far below a cell pit a pool less") {
  Markers markers = seedMarkers(*phiOf(pool), *noSolid(), 1);
  std::uint64_t drawn = 0;
  for (MarkerBlock& block : markers) {
    for (Marker& m : block.markers) {
      const float height = heightOf(block, m);
      // One in twenty of those near the surface changes sides.
      if (std::abs(height) < 0.6f && std::abs(height) > 0.12f && fluidtex::randomBits(1, drawn++) % 20 == 0)
        m.radius = height < 0.0f ? 0.1f : -0.1f;
    }
  }
  const auto roughness = [&] {
    const auto phi = phiOf(pool);
    correctPhi(*phi, markers, *noSolid());
    double sum = 0.0, count = 0.0;
    for (int i = 8; i < kCells - 8; ++i) {
      for (int j = 8; j < kCells - 8; ++j) {
        const double off = phi->tree().getValue(Coord(i, j, 16)) / kVoxel + 0.25;
        sum += off * off;
        count += 1.0;
      }
    }
    return std::sqrt(sum / count);
  };
  const double before = roughness();
  CHECK(before > 0.03);
  maintainMarkers(markers, *phiOf(pool), *noSolid(), 2);
  // By chance some have company.
  CHECK(roughness() < 0.4 * before);
}
