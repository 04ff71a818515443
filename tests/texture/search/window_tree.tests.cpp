#include "texture/search/window_tree.h"

#include "numerics/random.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>

using namespace fluidtex::texture;
using Catch::Matchers::WithinRel;
using fluidtex::randomUnit;

TEST_CASE("codes: sixteen at once are the sums of the squared differences of the upper bits", "[texture]") {
  constexpr std::size_t kCount = 4 * kCodeBlock;
  std::vector<float> descriptors(kCount * kDescriptorSize);
  for (std::size_t i = 0; i < descriptors.size(); ++i) descriptors[i] = float(randomUnit(2, i)) - 0.3f;
  WindowCodes codes = codesFor(descriptors);
  for (std::size_t i = 0; i < kCount; ++i) addCode(codes, descriptors.data() + i * kDescriptorSize);
  makeCoarse(codes);
  REQUIRE(codes.count() == kCount);
  for (std::uint64_t n = 0; n < 20; ++n) {
    std::vector<float> target(kDescriptorSize);
    // The last ones lie beyond the range, and not everywhere in it.
    for (std::size_t k = 0; k < target.size(); ++k)
      target[k] = (n < 16 ? 1.0f : 3.0f) * (float(randomUnit(30 + n, k)) - 0.3f);
    if (n == 19) target[5] = std::nanf("");
    const CodedQuery query(codes, target.data());
    for (std::size_t i = 0; i < kCount; ++i) {
      int coarse = 0;
      double exact = 0.0;
      for (std::size_t k = 0; k < kDescriptorSize; ++k) {
        const int difference = (codes.fine[i * kDescriptorSize + k] >> 8) - (query.fine[k] >> 8);
        coarse += difference * difference;
        exact += std::pow(double(descriptors[i * kDescriptorSize + k]) - target[k], 2.0);
      }
      CHECK(coarseDistances(codes, i / kCodeBlock, query)[i % kCodeBlock] == std::min(coarse, 32767));
      if (n < 16) CHECK_THAT(fineDistance(codes, i, query), WithinRel(float(exact), 1e-3f));
    }
  }
}

TEST_CASE("tree: holds every descriptor once, and all leaves together give the nearest", "[texture]") {
  for (const std::size_t count : {std::size_t(1), std::size_t(70), std::size_t(3000)}) {
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
      if (count == 1) continue;  // all else lies beyond the range of one
      for (std::size_t k = 0; k < search.best.size(); ++k)
        CHECK_THAT(search.best[k].distance, WithinRel(expected[k].distance, 2e-3f));
    }
  }
}
