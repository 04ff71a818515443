#include "texture/optimize/optimize.h"

#include "tests/texture/optimize/laid_exemplar.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <memory>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using fluidtex::Float8;

TEST_CASE("optimize: energy never rises while the window stays") {
  const OrientedMesh surface = orientedMesh(sphereMesh(20));
  const Source source(blobImage(72, 64, 4, 9.0, 3), GENERATE(false, true));
  const int window = GENERATE(7, 13);
  const double robust = GENERATE(0.8, 2.0);
  SynthesisOptions options;
  options.robustExponent = robust;
  options.usage = GENERATE(0.0, 1.0);
  options.histogram = GENERATE(0.0, 10.0);
  const SearchTable table = buildSearchTable(source.match, source.image.toroidal, window, 1, 4);

  State state;
  state.labels = blockLabels(surface.view(), source.image, 24.0f, 5);
  state.value = lookUp(source.image, state.labels);
  Level level{surface.view(), source.image, source.histogram, {}, {}};
  level.constraint.value = state.value;
  const std::vector<float> trust(state.value.size(), 0.7f);
  level.constraint.weight = constraintWeights(level.view, state.value, trust, 0.1);
  struct Search {
    const SearchTable* table;
    int probes, similar;
  };
  for (const Search& search : {Search{nullptr, 4, 0}, Search{&table, 4, 4}, Search{&table, 0, 4}}) {
    State copy = state;
    Pass pass;
    pass.window = window;
    pass.iterations = 6;
    pass.table = search.table;
    pass.probes = search.probes;
    pass.similar = search.similar;
    pass.seed = 11;
    const EnergyTrace trace = optimize(level, pass, options, copy);
    REQUIRE(trace.size() == 7);
    for (std::size_t i = 1; i < trace.size(); ++i) CHECK(trace[i] <= trace[i - 1] * (1.0 + 1e-6));
    CHECK(trace.back() < 0.9 * trace.front());
  }
}

TEST_CASE("optimize: a window's look-alikes are tried where no tree is searched") {
  // Four tiles of one noise, each of its own contrast: the surface shows one of them, its labels say another.
  const OrientedMesh surface = flatBox(24);
  const Image noise = noiseImage(16, 16, 3, 1);
  const Image tiles = imageOf(32, 32, 3, [&](int x, int y, int c) {
    return (1.0f - 0.04f * float(x / 16 + 2 * (y / 16))) * noise.at(x % 16, y % 16)[c];
  });
  const Source source(tiles, true);
  const SearchTable table = buildSearchTable(source.match, true, 9, 1, 4);
  const Level level{surface.view(), source.image, source.histogram, {}, middle(surface, 6.0f, 24.0f)};
  SynthesisOptions options;
  options.usage = options.histogram = 0.0;
  options.robustExponent = 2.0;
  const auto energyWith = [&](int similar) {
    State state;
    state.labels = laidDown(surface, Vec2f(19.0f, 5.0f));
    state.value = lookUp(source.image, state.labels);
    for (Label& label : state.labels) label.texel = source.image.brought(label.texel + Vec2f(16.0f, 0.0f));
    Pass pass;
    pass.table = &table;
    pass.probes = 0;
    pass.similar = similar;
    return optimize(level, pass, options, state);
  };
  const EnergyTrace with = energyWith(4), without = energyWith(0);
  CHECK(with.front() == without.front());
  CHECK(without.back() > 0.1 * without.front());
  CHECK(with.back() < 0.1 * without.back());
}

TEST_CASE("optimize: an exemplar laid down whole is at rest, with no energy") {
  const OrientedMesh surface = flatBox(40);
  // Linear images are exact on any mesh; on a mesh aligned with the pixels every image is.
  const bool linear = GENERATE(true, false);
  const Image image =
      linear ? imageOf(64, 60, 3, [](int x, int y, int c) { return 0.01f * x * (c + 1) + 0.005f * y; })
             : noiseImage(64, 60, 3, 4);
  const Source source(image, false);
  const Vec2f corner = linear ? Vec2f(11.3f, 48.6f) : Vec2f(11.0f, 49.0f);
  State state;
  state.labels = laidDown(surface, corner);
  state.value = lookUp(source.image, state.labels);
  const Values before = state.value;
  // Windows of 9 around the middle vertices stay on the plane, and inside the exemplar.
  const Level level{surface.view(), source.image, source.histogram, {}, middle(surface, 6.0f, 40.0f)};
  Pass pass;
  pass.iterations = 3;
  const EnergyTrace trace = optimize(level, pass, SynthesisOptions{}, state);
  for (const double e : trace) CHECK(e < 1e-5);
  CHECK(difference(state.value, before) < 1e-4f);
  CHECK(difference(state.average, before) < 1e-3f);
  for (std::uint32_t v = 0; v < before.size(); ++v)
    if (level.wanted[v]) CHECK((state.labels[v].texel - laidDown(surface, corner)[v].texel).length() < 1e-3f);
}

TEST_CASE("optimize: only wanted vertices change") {
  const OrientedMesh surface = flatBox(30);
  const Source source(blobImage(64, 64, 3, 8.0, 2), false);
  State state;
  state.labels = blockLabels(surface.view(), source.image, 12.0f, 1);
  state.value = lookUp(source.image, state.labels);
  const State before = state;
  const Level level{surface.view(), source.image, source.histogram, {}, middle(surface, 8.0f, 30.0f)};
  Pass pass;
  pass.iterations = 2;
  const EnergyTrace trace = optimize(level, pass, SynthesisOptions{}, state);
  CHECK(trace.back() < trace.front());
  std::size_t changed = 0;
  for (std::size_t v = 0; v < before.labels.size(); ++v) {
    const bool same = before.labels[v].texel == state.labels[v].texel &&
                      difference({before.value[v]}, {state.value[v]}) == 0.0f;
    if (!level.wanted[v]) CHECK(same);
    changed += !same;
  }
  CHECK(changed > 20);
}

TEST_CASE("optimize: copied cores are texels of the exemplar") {
  const OrientedMesh surface = orientedMesh(torusMesh(80, 32));
  const Source source(blobImage(64, 64, 3, 10.0, 7), false);
  State state;
  state.labels = blockLabels(surface.view(), source.image, 20.0f, 9);
  state.value = lookUp(source.image, state.labels);
  const Level level{surface.view(), source.image, source.histogram, {}, {}};
  Pass pass;
  pass.iterations = 2;
  optimize(level, pass, SynthesisOptions{}, state);
  CHECK(difference(state.value, lookUp(source.image, state.labels)) == 0.0f);
  CHECK(difference(state.value, state.average) > 0.01f);
  for (const Label& label : state.labels) {
    CHECK(stretch(label) < 1.001f);
    CHECK((label.texel - source.image.brought(label.texel)).length() == 0.0f);
  }
}

TEST_CASE("optimize: a strong constraint holds the surface, none lets it go") {
  const OrientedMesh surface = orientedMesh(sphereMesh(16));
  const Source source(blobImage(64, 64, 3, 10.0, 7), false);
  State start;
  start.labels = blockLabels(surface.view(), source.image, 10.0f, 9);
  start.value = lookUp(source.image, start.labels);
  Pass pass;
  pass.iterations = 3;
  pass.copyCores = false;
  SynthesisOptions options;
  options.histogram = 0.0;
  const std::vector<float> trust(start.value.size(), 1.0f);
  float moved[2];
  for (const bool held : {false, true}) {
    Level level{surface.view(), source.image, source.histogram, {}, {}};
    level.constraint.value = start.value;
    level.constraint.weight = constraintWeights(level.view, start.value, trust, held ? 1e4 : 0.0);
    State state = start;
    optimize(level, pass, options, state);
    moved[held] = difference(state.value, start.value);
  }
  CHECK(moved[0] > 0.05f);
  CHECK(moved[1] < 1e-3f);
}

TEST_CASE("optimize: constraint weights grow with the gradient and with trust") {
  const OrientedMesh surface = flatBox(20);
  Values value(surface.mesh.positions.size());
  for (std::size_t v = 0; v < value.size(); ++v)
    value[v] = Float8{surface.mesh.positions[v].x() > 10.0f ? 1.0f : 0.0f};
  std::vector<float> trust(value.size(), 1.0f);
  const std::uint32_t edge = nearestVertex(surface.mesh, Vec3f(10, 10, 2)),
                      plain = nearestVertex(surface.mesh, Vec3f(3, 10, 2)),
                      doubted = nearestVertex(surface.mesh, Vec3f(4, 10, 2));
  trust[doubted] = 0.25f;
  const std::vector<float> weight = constraintWeights(surface.view(), value, trust, 0.2);
  CHECK(weight[plain] == Approx(0.2));
  CHECK(weight[doubted] == Approx(0.05));
  CHECK(weight[edge] == Approx(0.8));  // steeper than three times the mean
}

TEST_CASE("optimize: the same on one thread and on many") {
  const OrientedMesh surface = orientedMesh(sphereMesh(18));
  const Source source(blobImage(64, 64, 3, 9.0, 3), false);
  const SearchTable table = buildSearchTable(source.match, false, 9, 1);
  const Level level{surface.view(), source.image, source.histogram, {}, {}};
  State results[2];
  EnergyTrace traces[2];
  for (int i = 0; i < 2; ++i) {
    onThreads(i == 0 ? 1 : 4, [&] {
      results[i].labels = blockLabels(level.view, source.image, 24.0f, 5);
      results[i].value = lookUp(source.image, results[i].labels);
      Pass pass;
      pass.iterations = 3;
      pass.table = &table;
      traces[i] = optimize(level, pass, SynthesisOptions{}, results[i]);
    });
  }
  CHECK(traces[0] == traces[1]);
  CHECK(difference(results[0].value, results[1].value) == 0.0f);
  for (std::size_t v = 0; v < results[0].labels.size(); ++v)
    CHECK(results[0].labels[v].texel == results[1].labels[v].texel);
}
