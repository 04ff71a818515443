#include "texture/window_tree.h"

#include "texture/random.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>

using namespace fluidtex::texture;
using Catch::Matchers::WithinRel;

TEST_CASE("tree: holds every descriptor once, and all leaves together give the nearest", "[texture]") {
  for (const std::size_t count : {std::size_t(1), std::size_t(7), std::size_t(3000)}) {
    std::vector<float> descriptors(count * kDescriptorSize);
    for (std::size_t i = 0; i < descriptors.size(); ++i)
      descriptors[i] = float(randomUnit(4, i)) / float(1 + i % kDescriptorSize);
    const WindowTree tree = buildWindowTree(descriptors, 64, 1);
    std::multiset<std::uint32_t> held;
    for (const std::uint32_t i : tree.index)
      if (i != kNoWindow) held.insert(i);
    CHECK(held.size() == count);
    CHECK(std::set<std::uint32_t>(held.begin(), held.end()).size() == count);
    for (int leaf = 0; leaf < tree.leaves(); ++leaf)
      CHECK(tree.firstBlock[std::size_t(leaf)] < tree.firstBlock[std::size_t(leaf) + 1]);

    TreeSearch search;
    for (std::uint64_t n = 0; n < 20; ++n) {
      std::vector<float> target(kDescriptorSize);
      for (std::size_t k = 0; k < target.size(); ++k) target[k] = float(randomUnit(9 + n, k)) / float(1 + k);
      std::vector<Found> expected;
      for (std::size_t i = 0; i < count; ++i) {
        float distance = 0.0f;
        for (std::size_t k = 0; k < target.size(); ++k)
          distance += std::pow(descriptors[i * kDescriptorSize + k] - target[k], 2.0f);
        expected.push_back({distance, std::uint32_t(i)});
      }
      std::sort(expected.begin(), expected.end());
      searchWindowTree(tree, descriptors.data() + n * 7 % count * kDescriptorSize, 1, 1, search);
      CHECK(search.best[0].distance == 0.0f);  // a descriptor of the tree is found by the first probe
      searchWindowTree(tree, target.data(), tree.leaves(), 5, search);
      REQUIRE(search.best.size() == std::min<std::size_t>(5, count));
      for (std::size_t k = 0; k < search.best.size(); ++k)
        CHECK_THAT(search.best[k].distance, WithinRel(expected[k].distance, 1e-4f));
    }
  }
}
