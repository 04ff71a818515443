#include "texture/optimize/passes.h"

#include "tests/texture/optimize/laid_exemplar.h"

#include <catch2/catch.hpp>

#include <set>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using fluidtex::Float8;

namespace {

using Widths = std::vector<std::pair<int, std::size_t>>;

Synthesizer synthesizerOf(const SynthesisOptions& options, const Image& color, bool toroidal, int levels,
                          const Image& guidance = {}) {
  return makeSynthesizer(makeExemplar(color, toroidal, options, levels, guidance), options);
}

// Blocks of a small exemplar on a ball.
struct Ball {
  OrientedMesh surface = orientedMesh(sphereMesh(14));
  SynthesisOptions options;
  Synthesizer synthesizer;
  State start;

  explicit Ball(Method method = Method::coordinates) {
    options.method = method;
    options.windows = {13, 9, 7};
    synthesizer = synthesizerOf(options, blobImage(48, 48, 4, 9.0, 1), false, 1);
    start.labels = blockLabels(surface.view(), image(), 14.0f, 5);
    start.value = lookUp(image(), start.labels);
  }
  const TexelImage& image() const { return synthesizer.tables->image[0]; }
  Level level() const { return {surface.view(), image(), synthesizer.tables->histogram[0], {}, {}}; }
  State run(const PassPlan& plan, State state, SynthesisStats& stats, const Progress& progress = {}) {
    runPasses(synthesizer, level(), plan, state, stats, progress);
    return state;
  }
};

bool sameLabels(const Labels& a, const Labels& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Label& x, const Label& y) {
    return x.texel == y.texel && x.jacobian == y.jacobian;
  });
}

double seamsOver(const SeamModel& seams, const Labels& labels) {
  double sum = 0.0;
  for (std::uint32_t v = 0; v < labels.size(); ++v) sum += double(seamCostAround(seams, labels, v));
  return sum;
}

}  // namespace

TEST_CASE("passes: windows are those that fit a level, each width once, with their place in the options") {
  SynthesisOptions options;
  options.windows = {33, 17, 9};
  const Image color = blobImage(40, 44, 4, 9.0, 1);
  // 5/8 of the shorter side: 25 of 40, 12.5 of 20 pixels.
  const Synthesizer plain = synthesizerOf(options, color, false, 2);
  CHECK(windowsOf(plain, 0) == Widths{{25, 0}, {17, 1}, {9, 2}});
  CHECK(windowsOf(plain, 1) == Widths{{11, 0}, {9, 2}});
  const Synthesizer toroidal = synthesizerOf(options, color, true, 2);
  CHECK(windowsOf(toroidal, 0) == Widths{{33, 0}, {17, 1}, {9, 2}});
  CHECK(windowsOf(toroidal, 1) == Widths{{19, 0}, {17, 1}, {9, 2}});
}

TEST_CASE("passes: seams are of all channels but the guidance and the gradient") {
  const auto channels = [](double feature, double gradient, bool guided) {
    SynthesisOptions options;
    options.windows = {9};
    options.featureWeight = feature;
    options.gradientWeight = gradient;
    const Synthesizer synthesizer = synthesizerOf(options, blobImage(32, 32, 4, 9.0, 1), true, 1,
                                                  guided ? blobImage(32, 32, 1, 9.0, 2) : Image{});
    const Float8 weight = seamChannels(synthesizer);
    std::string text;
    for (int c = 0; c < 8; ++c) text += weight[c] == 1.0f ? '1' : weight[c] == 0.0f ? '0' : '?';
    return text;
  };
  CHECK(channels(0.3, 0.3, false) == "11110000");
  CHECK(channels(0.3, 0.3, true) == "11101000");
  CHECK(channels(0.3, 0.0, false) == "11110000");
  CHECK(channels(0.3, 0.0, true) == "11101000");
  CHECK(channels(0.0, 0.3, false) == "11100000");
  CHECK(channels(0.0, 0.3, true) == "11100000");
  CHECK(channels(0.0, 0.0, false) == "11100000");
}

TEST_CASE("passes: droplets are not searched") {
  SynthesisOptions options;
  options.windows = {17, 9};
  const Synthesizer synthesizer = synthesizerOf(options, blobImage(40, 40, 4, 9.0, 1), true, 1);
  const SurfaceMesh large = sphereMesh(6), small = sphereMesh(2, 0.3, {5, 0, 0});
  REQUIRE((large.positions.size() > 81 && small.positions.size() < 81));
  CHECK(searched(synthesizer, buildVertexGraph(large)).empty());
  const std::vector<std::uint8_t> mask = searched(synthesizer, buildVertexGraph(together(large, small)));
  REQUIRE(mask.size() == large.positions.size() + small.positions.size());
  for (std::size_t v = 0; v < mask.size(); ++v) CHECK(mask[v] == (v < large.positions.size() ? 1 : 0));
}

TEST_CASE("passes: each has random numbers of its own") {
  Ball ball;
  std::set<std::uint64_t> keys;
  for (const std::uint64_t seed : {1u, 2u}) {
    ball.synthesizer.options.seed = seed;
    for (const int frame : {-1, 0, 1, 2, 300})
      for (const int level : {0, 1, 2})
        for (const int window : {9, 17, 33}) keys.insert(keyOf(ball.synthesizer, frame, level, window));
  }
  CHECK(keys.size() == 2 * 5 * 3 * 3);
}

TEST_CASE("passes: a prepared mesh is the mesh, with its graph and connection") {
  const OrientedMesh torus = orientedMesh(torusMesh(20, 10));
  const PreparedMesh prepared(torus.mesh);
  CHECK(&prepared.view().mesh == &torus.mesh);
  CHECK(prepared.view().graph.neighbor == torus.graph.neighbor);
  CHECK(prepared.view().connection.edge == torus.connection.edge);
  CHECK(prepared.view().connection.rotation == torus.connection.rotation);
}

TEST_CASE("passes: one for each window, as often as the plan says") {
  Ball ball;
  const auto iterations = [&](const std::vector<int>& each, int factor, std::size_t begin, std::size_t end) {
    SynthesisStats stats;
    std::vector<double> done;
    const PassPlan plan{.iterations = each, .factor = factor, .tree = false, .begin = begin, .end = end};
    ball.run(plan, ball.start, stats, [&](double share) { done.push_back(share); });
    const std::size_t count = std::min<std::size_t>(end, 3) - begin;
    REQUIRE(done.size() == count);
    for (std::size_t i = 0; i < count; ++i) CHECK(done[i] == Approx(double(i + 1) / double(count)));
    return stats.iterations;
  };
  CHECK(iterations({2, 1, 3}, 1, 0, 1000) == 6);
  CHECK(iterations({2, 1}, 1, 0, 1000) == 4);  // the last for those that follow
  CHECK(iterations({}, 1, 0, 1000) == 3);
  CHECK(iterations({2, 1, 3}, 2, 0, 1000) == 12);
  CHECK(iterations({2, 1, 3}, 1, 1, 2) == 1);
  CHECK(iterations({2, 1, 3}, 1, 2, 1000) == 3);
}

TEST_CASE("passes: run in two parts, widest first, they are the same as at once") {
  Ball ball;
  const std::vector<int> twice{2};
  SynthesisStats whole, parts;
  const State atOnce = ball.run({.frame = 3, .iterations = twice}, ball.start, whole);
  const State first = ball.run({.frame = 3, .iterations = twice, .end = 1}, ball.start, parts);
  const State second = ball.run({.frame = 3, .iterations = twice, .begin = 1}, first, parts);
  CHECK(sameLabels(atOnce.labels, second.labels));
  CHECK(difference(atOnce.value, second.value) == 0.0f);
  CHECK(whole.iterations == parts.iterations);
  CHECK(whole.energyStart == parts.energyStart);
  CHECK(whole.energyEnd == parts.energyEnd);
  CHECK(whole.energyEnd < whole.energyStart);
  CHECK_FALSE(sameLabels(first.labels, second.labels));
  // Another frame has other random numbers.
  const State other = ball.run({.frame = 4, .iterations = twice}, ball.start, whole);
  CHECK_FALSE(sameLabels(atOnce.labels, other.labels));
}

TEST_CASE(
    "passes: by coordinates texels are copied, by Kwatra's method averages stay and labels are not read") {
  const std::vector<int> once{1};
  SynthesisStats stats;
  Ball copied;
  const State texels = copied.run({.iterations = once}, copied.start, stats);
  CHECK(difference(texels.value, lookUp(copied.image(), texels.labels)) == 0.0f);
  Ball averaged(Method::kwatra07);
  State without = averaged.start;
  without.labels.clear();
  const State mean = averaged.run({.iterations = once}, averaged.start, stats),
              same = averaged.run({.iterations = once}, without, stats);
  CHECK(difference(mean.value, same.value) == 0.0f);
  CHECK(difference(mean.value, mean.average) == 0.0f);
}

TEST_CASE("passes: joined, labels have less of seams, and only those change that may") {
  Ball ball;
  const SeamModel seams = seamModel(ball.synthesizer, ball.surface.view(), 0);
  CHECK(seams.unit == ball.synthesizer.tables->seamUnit[0]);
  CHECK(&seams.image == &ball.image());
  State state = ball.start;
  state.average = state.value;
  std::vector<std::uint8_t> free;
  for (const Vec3f& x : ball.surface.mesh.positions) free.push_back(x.z() > 0.0f);
  Labels all = state.labels, upper = state.labels;
  joinLabels(seams, state, 0.0f, {}, nullptr, 1, all);
  joinLabels(seams, state, 0.0f, free, nullptr, 1, upper);
  const double before = seamsOver(seams, state.labels);
  REQUIRE(before > 0.0);
  CHECK(seamsOver(seams, upper) < before);
  CHECK(seamsOver(seams, all) < seamsOver(seams, upper));
  std::size_t changed = 0;
  for (std::size_t v = 0; v < upper.size(); ++v) {
    const bool same = upper[v].texel == state.labels[v].texel;
    if (!free[v]) CHECK(same);
    changed += !same;
  }
  CHECK(changed > 0);
  // Held by what is wanted, everything stays.
  Labels held = state.labels;
  joinLabels(seams, state, 1e6f, {}, nullptr, 1, held);
  CHECK(difference(lookUp(ball.image(), held), state.average) < 1e-3f);
}
