#include "texture/labels/guidance.h"

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/orientation/oriented_mesh.h"
#include "tests/threads.h"
#include "texture/frames/synthesize.h"
#include "texture/labels/usage.h"
#include "texture/optimize/optimize.h"
#include "texture/orientation/orient.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numeric>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using fluidtex::Float8;

namespace {

// One channel of texture and one of guidance, a ramp from 0 at the left edge to 1 at the right one.
TexelImage rampImage(float weight) {
  TexelImage image =
      makeTexelImage(imageOf(64, 48, 2,
                             [&](int x, int y, int c) {
                               return c == 0 ? float((x + y) % 7) : std::sqrt(weight) * float(x) / 63.0f;
                             }),
                     false, 4);
  image.guide = 1;
  image.guidanceWeight = weight;
  return image;
}

// Blobs that are red on the left and blue on the right; the map tells the two apart.
constexpr int kWidth = 128, kHeight = 96;
float levelAt(float x) {
  return 1.0f / (1.0f + std::exp(-(x - 0.5f * kWidth) / 6.0f));
}

Image twoKinds() {
  const Image blobs = blobImage(kWidth, kHeight, 4, 12.0, 2);
  return imageOf(kWidth, kHeight, 4, [&](int x, int y, int c) {
    const float level = levelAt(float(x)), share = c == 0 ? 1.0f - level : c == 1 ? 0.2f : level;
    return c == 3 ? 1.0f : blobs.at(x, y)[1] * (0.1f + 0.9f * share);
  });
}

Image twoKindsMap() {
  return imageOf(kWidth, kHeight, 1, [](int x, int, int) { return levelAt(float(x)); });
}

SynthesisOptions smallOptions() {
  SynthesisOptions options;
  options.windows = {17, 9};
  options.firstIterations = {3, 3};
  options.laterIterations = {2, 2};
  options.renewalRadius = 10.0;
  return options;
}

Surface guidedSphere(int subdivisions, int levels, const std::function<float(const Vec3f&)>& wanted) {
  Surface surface;
  for (int l = 0; l < levels; ++l) {
    surface.levels.push_back(sphereMesh(subdivisions >> l));
    surface.levels.back().spacing = surface.levels.front().spacing * (1 << l);
  }
  orient(surface, {});
  for (SurfaceMesh& mesh : surface.levels)
    for (const Vec3f& x : mesh.positions) mesh.guidance.push_back(wanted(x));
  return surface;
}

float byHeight(const Vec3f& x) {
  return x.z() > 0.0f ? 1.0f : 0.0f;
}

// The share of the vertices, of those not beside the border, that show the half that they should.
double fitting(const TexturedSurface& surface, const std::function<float(const Vec3f&)>& wanted) {
  std::size_t fit = 0, all = 0;
  for (std::size_t v = 0; v < surface.positions.size(); ++v) {
    if (std::abs(surface.positions[v].z()) < 0.2f) continue;
    ++all;
    fit += std::abs(levelAt(surface.coordinate[v][0]) - wanted(surface.positions[v])) < 0.5f;
  }
  return double(fit) / double(all);
}

// The next frame's start where nothing has moved, with what is wanted on it.
struct Start {
  Surface surface;
  Carried carried;
};

Start resting(const TexturedSurface& last, const std::function<float(const Vec3f&)>& wanted) {
  Start start;
  SurfaceMesh mesh{last.spacing, last.positions, last.normals, last.triangles, last.orientation, {}, {}};
  for (const Vec3f& x : last.positions) mesh.guidance.push_back(wanted(x));
  start.surface.levels.push_back(std::move(mesh));
  start.carried.orientation = last.orientation;
  start.carried.color = last.color;
  start.carried.coordinate = last.coordinate;
  start.carried.gradient = last.gradient;
  start.carried.fading = last.fading;
  start.carried.age = last.age;
  start.carried.trust.assign(last.positions.size(), 1.0f);
  start.carried.previousPosition = last.positions;
  return start;
}

Synthesizer twoKindsSynthesizer(const SynthesisOptions& options) {
  return makeSynthesizer(makeExemplar(twoKinds(), false, options, 3, twoKindsMap()), options);
}

}  // namespace

TEST_CASE("guidance: what is wanted is held in the map's channel, and costs what it is off") {
  const float weight = GENERATE(0.25f, 4.0f);
  const TexelImage image = rampImage(weight);
  OrientedMesh surface = flatBox(4);
  Values values(surface.mesh.positions.size(), Float8{5.0f, 5.0f});
  holdGuidance(image, surface.mesh, values);
  CHECK(values[3][1] == 5.0f);  // nothing is wanted
  CHECK(guidanceCost(image, surface.mesh, {63.0f, 3.0f}, 3) == 0.0f);

  surface.mesh.guidance.assign(values.size(), 0.5f);
  holdGuidance(image, surface.mesh, values);
  CHECK(values[3][0] == 5.0f);
  CHECK(values[3][1] == Approx(0.5f * std::sqrt(weight)));
  CHECK(guidanceCost(image, surface.mesh, {31.5f, 3.0f}, 3) == 0.0f);
  CHECK(guidanceCost(image, surface.mesh, {31.5f + 63.0f * 0.09f, 3.0f}, 3) == 0.0f);
  const float middle = guidanceCost(image, surface.mesh, {0.0f, 3.0f}, 3);
  CHECK(middle == Approx(2.0f * weight * 0.4f));
  CHECK(guidanceCost(image, surface.mesh, {63.0f, 9.0f}, 3) == Approx(middle));
}

TEST_CASE("guidance: what the surface asks for is asked of the parts that have it, one on average") {
  const TexelImage image = rampImage(2.0f);
  OrientedMesh surface = flatBox(6);
  CHECK(demandOn(image, surface.mesh).empty());
  for (const Vec3f& x : surface.mesh.positions) surface.mesh.guidance.push_back(x.x() > 3.0f ? 0.9f : 0.7f);
  const Demand demand = demandOn(image, surface.mesh);
  REQUIRE(demand.share.size() == std::size_t(demand.columns * demand.rows));
  const double sum = std::accumulate(demand.share.begin(), demand.share.end(), 0.0);
  CHECK(sum / double(demand.share.size()) == Approx(1.0).epsilon(0.15));
  CHECK(demand.at(10.0f, 20.0f) == 0.0f);
  CHECK(demand.at(54.0f, 20.0f) > 2.0f);

  // Uses are even where they follow the demand.
  Usage usage(image, 8, 300, demand);
  for (int i = 0; i < 300; ++i)
    usage.add({40.0f + 20.0f * float(i % 20) / 20.0f, 48.0f * float(i / 20) / 15.0f}, 1.0f);
  CHECK(usage.at({50.0f, 24.0f}) < 2.0f);
  CHECK(usage.at({50.0f, 24.0f}) > 0.5f);
}

TEST_CASE("guidance: a level that the exemplar has not is asked of the nearest that it has") {
  TexelImage image =
      makeTexelImage(imageOf(32, 32, 1, [](int x, int, int) { return x < 16 ? 0.2f : 0.4f; }), false, 4);
  image.guide = 0;
  OrientedMesh surface = flatBox(4);
  surface.mesh.guidance.assign(surface.mesh.positions.size(), 1.0f);
  const Demand demand = demandOn(image, surface.mesh);
  CHECK(demand.at(28.0f, 5.0f) > 1.5f);
  CHECK(demand.at(2.0f, 5.0f) < 0.5f);
}

TEST_CASE("guidance: energy never rises while the window stays") {
  const Image match = [] {
    const Image color = twoKinds(), map = twoKindsMap();
    return imageOf(kWidth, kHeight, 4,
                   [&](int x, int y, int c) { return c < 3 ? color.at(x, y)[c] : map.at(x, y)[0]; });
  }();
  TexelImage image = makeTexelImage(match, false, 16);
  image.guide = 3;
  const HistogramTarget histogram = makeHistogramTarget(image);
  OrientedMesh surface = orientedMesh(sphereMesh(16));
  for (const Vec3f& x : surface.mesh.positions) surface.mesh.guidance.push_back(byHeight(x));
  const SearchTable table = buildSearchTable(match, false, 9, 1, 4);
  State state;
  state.labels = blockLabels(surface.view(), image, 24.0f, 5);
  state.value = lookUp(image, state.labels);
  const Level level{surface.view(), image, histogram, {}, {}};
  Pass pass;
  pass.iterations = 6;
  pass.table = &table;
  SynthesisOptions options;
  options.histogram = GENERATE(0.0, 10.0);
  const EnergyTrace trace = optimize(level, pass, options, state);
  for (std::size_t i = 1; i < trace.size(); ++i) CHECK(trace[i] <= trace[i - 1] * (1.0 + 1e-6));
  for (std::size_t v = 0; v < state.value.size(); ++v) CHECK(state.value[v][3] == surface.mesh.guidance[v]);
}

TEST_CASE("guidance: each part of a first frame shows what is wanted there, by either method") {
  SynthesisOptions options = smallOptions();
  options.method = GENERATE(Method::coordinates, Method::kwatra07);
  Synthesizer synthesizer = twoKindsSynthesizer(options);
  SynthesisStats stats;
  const TexturedSurface result = synthesize(synthesizer, guidedSphere(24, 2, byHeight), {}, 1, 0.0, stats);
  CHECK(fitting(result, byHeight) > 0.95);
  REQUIRE(result.guidance.size() == result.positions.size());
  CHECK(result.guidance[0] == byHeight(result.positions[0]));
  // Without guidance it would be a matter of luck.
  Surface free = guidedSphere(24, 2, byHeight);
  for (SurfaceMesh& mesh : free.levels) mesh.guidance.clear();
  CHECK(fitting(synthesize(synthesizer, free, {}, 1, 0.0, stats), byHeight) < 0.8);
}

TEST_CASE("guidance: texture that no longer fits is renewed over time, what fits comes to rest") {
  const SynthesisOptions options = smallOptions();
  Synthesizer synthesizer = twoKindsSynthesizer(options);
  SynthesisStats stats;
  TexturedSurface last = synthesize(synthesizer, guidedSphere(24, 2, byHeight), {}, 1, 0.0, stats);
  const auto rest = [&](const std::function<float(const Vec3f&)>& wanted, int first, int frames) {
    for (int frame = first; frame < first + frames; ++frame) {
      Start start = resting(last, wanted);
      last = synthesize(synthesizer, std::move(start.surface), start.carried, frame, 0.04, stats);
    }
  };
  rest(byHeight, 2, 10);
  CHECK(stats.renewed < 0.01);
  CHECK(fitting(last, byHeight) > 0.95);
  // Now the other way round.
  const auto turned = [](const Vec3f& x) { return 1.0f - byHeight(x); };
  rest(turned, 12, 1);
  CHECK(stats.renewed > 0.02);
  // Not all at once: 2.4 of the sphere a second is a tenth in discs, and their rims make that 2.6 times as
  // much.
  CHECK(stats.renewed < 0.35);
  CHECK(fitting(last, turned) < 0.4);
  rest(turned, 13, 24);
  CHECK(fitting(last, turned) > 0.9);
}

TEST_CASE("guidance: the same on one thread and on many") {
  const SynthesisOptions options = smallOptions();
  std::vector<Vec2f> results[2];
  for (int i = 0; i < 2; ++i) {
    onThreads(i == 0 ? 1 : 4, [&] {
      Synthesizer synthesizer = twoKindsSynthesizer(options);
      SynthesisStats stats;
      const TexturedSurface first = synthesize(synthesizer, guidedSphere(12, 2, byHeight), {}, 1, 0.0, stats);
      Start start = resting(first, [](const Vec3f& x) { return 1.0f - byHeight(x); });
      results[i] = synthesize(synthesizer, std::move(start.surface), start.carried, 2, 0.1, stats).coordinate;
    });
  }
  CHECK(results[0] == results[1]);
}

TEST_CASE("guidance: values for another number of vertices are refused") {
  const SynthesisOptions options = smallOptions();
  Synthesizer synthesizer = twoKindsSynthesizer(options);
  Surface surface = guidedSphere(6, 1, byHeight);
  surface.levels[0].guidance.pop_back();
  SynthesisStats stats;
  CHECK_THROWS_AS(synthesize(synthesizer, surface, {}, 1, 0.0, stats), std::invalid_argument);
}
