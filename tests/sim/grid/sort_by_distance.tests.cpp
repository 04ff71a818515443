#include "sim/grid/sort_by_distance.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <random>

using namespace fluidtex::sim;

TEST_CASE("sort_by_distance: rising within each group, equal ones in the order they came") {
  std::mt19937 random(8);
  std::uniform_real_distribution<float> distance(-2.0f, 2.0f);
  std::vector<float> distances;
  std::vector<FarVoxel> voxels;
  for (std::uint32_t n = 0; n < 5000; ++n) {
    // Many are equal, some are 0.
    distances.push_back(n % 3 == 0 ? float(int(4.0f * distance(random))) : distance(random));
    voxels.push_back({sortKey(distances.back(), int(n % 2)), n});
  }
  sortByDistance(voxels);
  REQUIRE(voxels.size() == distances.size());
  std::vector<char> seen(voxels.size(), 0);
  int wrong = 0;
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    seen[voxels[i].voxel] = 1;
    if (i == 0) continue;
    const std::uint32_t a = voxels[i - 1].voxel, b = voxels[i].voxel;
    const bool laterGroup = a % 2 == 0 && b % 2 == 1;
    if (laterGroup) continue;
    // The keys know distances to one part in four million.
    if (a % 2 != b % 2 || distances[a] > distances[b] + 1e-6f) ++wrong;
    if (distances[a] == distances[b] && a > b) ++wrong;
  }
  CHECK(wrong == 0);
  CHECK(std::count(seen.begin(), seen.end(), 1) == std::ptrdiff_t(seen.size()));
}

TEST_CASE("sort_by_distance: nothing, and one") {
  std::vector<FarVoxel> voxels;
  sortByDistance(voxels);
  CHECK(voxels.empty());
  voxels.push_back({sortKey(0.5f), 7});
  sortByDistance(voxels);
  CHECK(voxels.front().voxel == 7);
}
