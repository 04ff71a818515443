#include "texture/frames/renewal.h"

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/orientation/oriented_mesh.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <numeric>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using fluidtex::Float8;
using fluidtex::randomUnit;

namespace {

const Float8 kAllChannels{1, 1, 1, 1, 1, 1, 1, 1};

// The picture texel = (20 + scale x, 60 - y) on the upper side of a flat box.
Labels picture(const OrientedMesh& surface, float scale) {
  Labels labels;
  for (const Vec3f& x : surface.mesh.positions)
    labels.push_back({{20 + scale * x.x(), 60 - x.y()}, {scale, 0, 0, 1}});
  return labels;
}

bool onTop(const Vec3f& x) {
  return x.z() > 1.9f && x.x() > 4 && x.x() < 20 && x.y() > 4 && x.y() < 20;
}

}  // namespace

TEST_CASE(
    "renewal: whole, unstretched texture is left alone, stretched texture gets discs, the lost is renewed at "
    "once") {
  const OrientedMesh surface = flatBox(48);
  const TexelImage image = makeTexelImage(blobImage(100, 100, 3, 10.0, 1), false, 4);
  const SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  const std::size_t count = surface.mesh.positions.size();
  const std::vector<float> trusted(count, 1.0f), doubted(count, 0.1f);
  const std::vector<std::uint8_t> free(count, 1);
  const DiscOptions all{1.35, 8.0, 1.0, 1.0};
  // The share of the upper side's middle that discs cover: no picture fits around the box's edges.
  const auto middle = [](const Vec3f& x) { return onTop(x - Vec3f(12, 12, 0)); };
  const auto covered = [&](const Labels& labels, const std::vector<std::uint8_t>& mask) {
    std::size_t found = 0, size = 0;
    for (const Disc& disc : worstDiscs(model, labels, wearAround(model, labels, trusted), mask, all, 1))
      for (const std::uint32_t v : disc.members) found += middle(surface.mesh.positions[v]);
    for (const Vec3f& x : surface.mesh.positions) size += middle(x);
    return double(found) / double(size);
  };
  CHECK(covered(picture(surface, 1.0f), free) == 0.0);
  CHECK(covered(picture(surface, 1.6f), free) > 0.2);
  CHECK(covered(picture(surface, 1 / 1.6f), free) > 0.2);
  CHECK(covered(picture(surface, 1.6f), std::vector<std::uint8_t>(count, 0)) == 0.0);

  const auto lostOnTop = [&](const Labels& labels, const std::vector<float>& trust) {
    const std::vector<std::uint8_t> lost = lostLabels(model, labels, trust);
    std::size_t sum = 0, size = 0;
    for (std::uint32_t v = 0; v < count; ++v)
      if (onTop(surface.mesh.positions[v])) sum += lost[v], ++size;
    return double(sum) / double(size);
  };
  Labels outside = picture(surface, 1.0f);
  for (Label& label : outside) label.texel += Vec2f(100, 0);
  CHECK(lostOnTop(picture(surface, 1.6f), trusted) == 0.0);
  CHECK(lostOnTop(outside, trusted) == 1.0);
  CHECK(lostOnTop(picture(surface, 1.0f), doubted) == 1.0);
}

TEST_CASE("renewal: mirror images are lost where the exemplar must not show them") {
  const OrientedMesh surface = flatBox(10);
  TexelImage image = makeTexelImage(blobImage(100, 100, 3, 10.0, 1), false, 4);
  const std::vector<float> trusted(surface.mesh.positions.size(), 1.0f);
  for (const bool allowed : {false, true}) {
    image.ways.mirrored = allowed;
    const SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
    for (const bool mirrored : {false, true}) {
      const Labels labels(trusted.size(), unstretched({50, 50}, {std::polar(1.0f, 0.8f), mirrored}));
      const auto expected = std::uint8_t(mirrored && !allowed);
      CHECK(lostLabels(model, labels, trusted) == std::vector<std::uint8_t>(trusted.size(), expected));
    }
  }
}

TEST_CASE("renewal: what a mesh gave is not lost by being mirrored or beyond the picture's edge") {
  const OrientedMesh surface = flatBox(10);
  const TexelImage image = makeTexelImage(blobImage(100, 100, 3, 10.0, 1), false, 4);
  const std::size_t count = surface.mesh.positions.size();
  std::vector<float> trust(count, 1.0f);
  trust[7] = 0.1f;
  std::vector<std::uint8_t> original(count, 1), expected(count, 0);
  original[3] = 0;
  expected[3] = expected[7] = 1;
  SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  model.original = &original;
  CHECK(lostLabels(model, Labels(count, unstretched({50, 50}, {Complexf(1.0f), true})), trust) == expected);
  CHECK(lostLabels(model, Labels(count, unstretched({150, 50}, {})), trust) == expected);
}

TEST_CASE("renewal: discs keep to their size, their distance and the budget, worst first") {
  const OrientedMesh surface = flatBox(60);
  const TexelImage image = makeTexelImage(blobImage(200, 200, 3, 10.0, 1), false, 4);
  const SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  const std::size_t count = surface.mesh.positions.size();
  const std::vector<std::uint8_t> free(count, 1);
  // The right half is stretched more than the left one.
  Labels labels;
  Wear wear;
  for (const Vec3f& x : surface.mesh.positions) {
    const float scale = x.x() < 30 ? 1.0f / 1.4f : 1.0f / 1.5f;
    labels.push_back({{100 + scale * (x.x() - 30), 150 - x.y()}, {scale, 0, 0, 1}});
    wear.bad.push_back(-std::log(scale));
  }
  wear.stretch.assign(count, 0.3f);  // nothing urgent
  for (const double budget : {0.1, 0.4}) {
    const DiscOptions options{1.35, 10.0, budget, budget};
    const std::vector<Disc> discs = worstDiscs(model, labels, wear, free, options, 1);
    REQUIRE_FALSE(discs.empty());
    std::size_t covered = 0;
    for (std::size_t i = 0; i < discs.size(); ++i) {
      if (i > 0) covered += discs[i - 1].members.size();
      const Vec3f& center = surface.mesh.positions[discs[i].center];
      for (const std::uint32_t v : discs[i].members)
        CHECK((surface.mesh.positions[v] - center).length() <= 8.01f);
      // On one side; around an edge of the box the way along the surface is longer.
      for (std::size_t j = 0; j < i; ++j) {
        const Vec3f& other = surface.mesh.positions[discs[j].center];
        if (other.z() == center.z()) CHECK((other - center).length() > 15.9f);
      }
    }
    CHECK(double(covered) < budget * double(count));
    const Disc& worst = discs.front();
    CHECK(surface.mesh.positions[worst.center].x() > 28.0f);
  }
}

TEST_CASE(
    "renewal: where the stretch is urgent another budget counts, and what lies between discs joins them") {
  const OrientedMesh surface = flatBox(60);
  const TexelImage image = makeTexelImage(blobImage(200, 200, 3, 10.0, 1), false, 4);
  const SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  const std::size_t count = surface.mesh.positions.size();
  const Labels labels = picture(surface, 0.4f);
  const std::vector<std::uint8_t> free(count, 1);
  const auto much = float(std::log(2.5));
  // The share that is covered by as much as is urgent: all, nothing, the half with x below 30.
  const auto covered = [&](const auto& urgent, double urgentBudget) {
    Wear wear{std::vector<float>(count, much), {}};
    for (const Vec3f& x : surface.mesh.positions) wear.stretch.push_back(urgent(x) ? much : 0.0f);
    std::vector<int> discsOf(count, 0);
    std::size_t sum = 0;
    const DiscOptions options{1.35, 10.0, 0.05, urgentBudget};
    for (const Disc& disc : worstDiscs(model, labels, wear, free, options, 1))
      for (const std::uint32_t v : disc.members) {
        CHECK(++discsOf[v] == 1);
        ++sum;
        // Beyond a disc only what is urgent.
        if ((surface.mesh.positions[v] - surface.mesh.positions[disc.center]).length() > 8.01f)
          CHECK(urgent(surface.mesh.positions[v]));
      }
    return double(sum) / double(count);
  };
  const auto all = [](const Vec3f&) { return true; };
  const auto none = [](const Vec3f&) { return false; };
  const auto onLeft = [](const Vec3f& x) { return x.x() < 30.0f; };
  CHECK(covered(none, 1.0) < 0.1);
  CHECK(covered(all, 0.05) < 0.25);  // a disc or two, and what lies around them
  CHECK(covered(all, 1.0) > 0.95);
  CHECK(covered(onLeft, 1.0) > 0.45);
  CHECK(covered(onLeft, 1.0) < 0.7);
}

TEST_CASE("renewal: what the flow wears out in a frame") {
  const double life = (1.45 + 1.5) * std::log(1.22);
  const Strain still, fast{0.5f * float(life), Complexf(0.5f * float(life), 0.0f)}, torn{10.0f, {}};
  CHECK(wornShare({}, 1.0, 1.22) == 0.0);
  CHECK(wornShare({still, still}, 1.0, 1.22) == 0.0);
  CHECK(wornShare({fast, still}, 0.1, 1.22) == Approx(0.05));
  CHECK(wornShare({torn, still}, 1.0, 1.22) == Approx(0.5));  // once is enough
  // Where its wear counts twice, and where it is locked.
  CHECK(wornShare({fast, fast}, 0.1, 1.22, {2.0f, 0.0f}) == Approx(0.1));
}

TEST_CASE("renewal: texture fades as fast as it gets bad, and never slower than it is told to") {
  const auto most = float(1.8 * std::log(1.35));
  CHECK(fadingSpeed(0.0f, 1.35, 0.4) == Approx(2.5));
  CHECK(fadingSpeed(most, 1.35, 0.4) == Approx(2.5));           // in a second
  CHECK(fadingSpeed(10.0f * most, 1.35, 0.4) == Approx(10.0));  // in a tenth of one
}

TEST_CASE("renewal: a mask grows by rings") {
  const OrientedMesh surface = flatBox(12);
  std::vector<std::uint8_t> mask(surface.mesh.positions.size(), 0);
  const Vec3f center(6, 6, 2);
  mask[nearestVertex(surface.mesh, center)] = 1;
  const std::vector<std::uint8_t> result = grown(surface.graph, mask, 2);
  for (std::uint32_t v = 0; v < mask.size(); ++v) {
    const Vec3f way = surface.mesh.positions[v] - center;
    if (surface.mesh.positions[v].z() < 1.9f) continue;
    // Squares are split along one diagonal, so that rings are hexagons.
    const float rings = way.x() * way.y() > 0 ? std::max(std::abs(way.x()), std::abs(way.y()))
                                              : std::abs(way.x()) + std::abs(way.y());
    CHECK(bool(result[v]) == (rings < 2.5f));
  }
}

TEST_CASE("renewal: a proposal that repairs is taken, one that tears is not") {
  const OrientedMesh surface = flatBox(24);
  const TexelImage image = makeTexelImage(blobImage(100, 100, 3, 10.0, 1), false, 4);
  const SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  const std::vector<float> trust(surface.mesh.positions.size(), 1.0f);
  const Labels good = picture(surface, 1.0f);
  Labels hole = good;  // a torn piece in the middle
  std::vector<std::uint8_t> inside;
  for (std::uint32_t v = 0; v < hole.size(); ++v) {
    const Vec3f& x = surface.mesh.positions[v];
    inside.push_back(x.z() > 1.9f && (x - Vec3f(12, 12, 2)).length() < 5);
    if (!inside[v]) continue;
    hole[v].texel = Vec2f(float(randomUnit(1, v)), float(randomUnit(2, v))) * 99.0f;
    // What is right by chance would be kept.
    if ((hole[v].texel - good[v].texel).length() < 10.0f) hole[v].texel += Vec2f(20.0f, 20.0f);
  }
  std::vector<std::uint8_t> renewed;
  const Labels mended = settle(model, hole, good, trust, renewed);
  CHECK(renewed == inside);
  for (std::uint32_t v = 0; v < hole.size(); ++v) CHECK(mended[v].texel == good[v].texel);

  const Labels kept = settle(model, good, hole, trust, renewed);
  CHECK(std::count(renewed.begin(), renewed.end(), 1) == 0);
  for (std::uint32_t v = 0; v < hole.size(); ++v) CHECK(kept[v].texel == good[v].texel);

  const auto sum = [&](const Labels& labels) {
    const std::vector<float> costs = badness(model, labels, trust);
    return std::accumulate(costs.begin(), costs.end(), 0.0);
  };
  CHECK(sum(mended) < sum(hole));
}

TEST_CASE("renewal: whatever is proposed, the summed badness does not rise") {
  const OrientedMesh surface = flatBox(16);
  const TexelImage image = makeTexelImage(blobImage(100, 100, 3, 10.0, 1), false, 4);
  const SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  const std::size_t count = surface.mesh.positions.size();
  std::size_t taken = 0;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const auto random = [&](std::uint64_t i) { return float(randomUnit(seed, i)); };
    // A stretched picture, doubted here and there, and a proposal that lays a few unstretched patches into
    // it, shifted a little: sometimes they overlap or touch, or leave one vertex between them.
    const Labels carried = picture(surface, 1.2f + 0.8f * random(0));
    Labels proposed = carried;
    const Vec3f middle(4 + 8 * random(1), 4 + 8 * random(2), 2);
    for (std::uint64_t patch = 0; patch < seed % 4 + 1; ++patch) {
      const std::uint64_t key = 10 * (patch + 1);
      const Vec3f center = middle + Vec3f(4 * random(key) - 2, 4 * random(key + 1) - 2, 0);
      const float radius = 0.5f + 2.0f * random(key + 2);
      const Vec2f start = carried[nearestVertex(surface.mesh, center)].texel +
                          Vec2f(3 * random(key + 3), 3 * random(key + 4));
      for (std::uint32_t v = 0; v < count; ++v) {
        const Vec3f way = surface.mesh.positions[v] - center;
        if (way.length() < radius) proposed[v] = unstretched(start + Vec2f(way.x(), -way.y()), {});
      }
    }
    std::vector<float> trust(count);
    for (std::uint32_t v = 0; v < count; ++v) trust[v] = random(20000 + v) < 0.02f ? 0.2f : 1.0f;

    std::vector<std::uint8_t> renewed;
    const Labels result = settle(model, carried, proposed, trust, renewed);
    std::vector<float> trustAfter = trust;  // what is new is trusted
    for (std::uint32_t v = 0; v < count; ++v)
      if (renewed[v]) trustAfter[v] = 1.0f, ++taken;
    const auto sum = [&](const Labels& labels, const std::vector<float>& believed) {
      const std::vector<float> costs = badness(model, labels, believed);
      return std::accumulate(costs.begin(), costs.end(), 0.0);
    };
    CHECK(sum(result, trustAfter) <= sum(carried, trust) + 1e-4);
  }
  CHECK(taken > 300);
}
