#include "texture/frames/first_frame.h"

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/frames/textured_spheres.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

// An exemplar of 80 x 72 texels, with two windows of three iterations each.
Synthesizer firstSynthesizer(int levels, SynthesisOptions options = smallOptions()) {
  return makeSynthesizer(makeExemplar(blobImage(80, 72, 4, 12.0, 2), false, options, levels), options);
}

// How often windows were improved, and the state.
std::pair<int, State> firstOf(const Surface& surface, int exemplarLevels, int finest, int frame = 1,
                              const SynthesisOptions& options = smallOptions()) {
  Synthesizer synthesizer = firstSynthesizer(exemplarLevels, options);
  SynthesisStats stats;
  State state = synthesizeFromNothing(synthesizer, surface, finest, frame, stats, {});
  return {stats.iterations, std::move(state)};
}

bool sameTexels(const Labels& a, const Labels& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Label& x, const Label& y) { return x.texel == y.texel; });
}

}  // namespace

TEST_CASE("first frame: down to the level that is asked for, coarser ones three times as long") {
  const Surface surface = sphere(20, 3);
  for (const int finest : {0, 1, 2}) {
    const auto [iterations, state] = firstOf(surface, 3, finest);
    const std::size_t count = surface.levels[std::size_t(finest)].positions.size();
    REQUIRE(state.labels.size() == count);
    REQUIRE(state.value.size() == count);
    REQUIRE(state.average.size() == count);
    CHECK(iterations == 6 * (finest == 0 ? 1 + 3 + 3 : finest == 1 ? 3 + 3 : 3));
    // On the exemplar, as large as it is at that level.
    for (const Label& label : state.labels) {
      CHECK((label.texel[0] >= 0.0f && label.texel[0] <= float((80 >> finest) - 1)));
      CHECK((label.texel[1] >= 0.0f && label.texel[1] <= float((72 >> finest) - 1)));
    }
  }
}

TEST_CASE("first frame: it begins at the coarsest level that surface and exemplar have") {
  const Surface one = sphere(12, 1), two = sphere(12, 2), three = sphere(12, 3);
  CHECK(firstOf(three, 1, 0).first == 6);
  CHECK(firstOf(three, 2, 0).first == 6 + 18);
  CHECK(firstOf(one, 3, 0).first == 6);
  // What is small may be gone at coarser levels.
  Surface gone = two, only = two;
  gone.levels[1] = {};
  only.levels.resize(1);
  CHECK(firstOf(gone, 2, 0).first == 6);
  CHECK(sameTexels(firstOf(gone, 2, 0).second.labels, firstOf(only, 2, 0).second.labels));
}

TEST_CASE("first frame: progress rises to one, by the points of each level") {
  Synthesizer synthesizer = firstSynthesizer(2);
  const Surface surface = sphere(16, 2);
  SynthesisStats stats;
  std::vector<double> done;
  synthesizeFromNothing(synthesizer, surface, 0, 1, stats, [&](double share) { done.push_back(share); });
  REQUIRE(done.size() == 4);
  const double fine = double(surface.levels[0].positions.size()),
               coarse = double(surface.levels[1].positions.size());
  CHECK(done[0] == Approx(0.5 * coarse / (fine + coarse)));
  CHECK(done[1] == Approx(coarse / (fine + coarse)));
  CHECK(done[2] == Approx((coarse + 0.5 * fine) / (fine + coarse)));
  CHECK(done[3] == Approx(1.0));
}

TEST_CASE("first frame: what it adds is added to the figures that are there") {
  Synthesizer synthesizer = firstSynthesizer(1);
  SynthesisStats stats;
  stats.iterations = 100;
  synthesizeFromNothing(synthesizer, sphere(10, 1), 0, 1, stats, {});
  CHECK(stats.iterations == 106);
  CHECK(stats.energyEnd < stats.energyStart);
}

TEST_CASE("first frame: droplets keep what they begin with, all else is searched") {
  Surface surface;
  surface.levels.push_back(together(sphereMesh(10), sphereMesh(2, 0.2, {4.0, 0.0, 0.0})));
  orient(surface, {});
  SynthesisOptions once = smallOptions();
  once.firstIterations = {1, 0};
  const Labels longer = firstOf(surface, 1, 0).second.labels,
               shorter = firstOf(surface, 1, 0, 1, once).second.labels;
  std::size_t droplet = 0, changed = 0;
  for (std::size_t v = 0; v < longer.size(); ++v) {
    const bool same = longer[v].texel == shorter[v].texel;
    if (surface.levels[0].positions[v].x() > 2.0f) {
      ++droplet;
      CHECK(same);
    } else {
      changed += !same;
    }
  }
  CHECK(droplet == 42);
  CHECK(changed > 500);
}

TEST_CASE("first frame: by Kwatra's method the averages are what remains") {
  SynthesisOptions options = smallOptions();
  options.method = Method::kwatra07;
  const State state = firstOf(sphere(12, 2), 2, 0, 1, options).second;
  REQUIRE(state.value.size() == state.average.size());
  for (std::size_t v = 0; v < state.value.size(); ++v)
    for (int c = 0; c < 3; ++c) CHECK(state.value[v][c] == state.average[v][c]);
}
