#include "texture/frames/synthesize.h"

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/frames/textured_spheres.h"
#include "tests/threads.h"
#include "texture/labels/labels.h"
#include "texture/measure/tiles.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

float stretchAt(const TexturedSurface& surface, std::size_t v) {
  const Vec3f &d = surface.orientation[v], b = rowAxis(d, surface.normals[v]);
  const TexelGradient& g = surface.gradient[v];
  const auto scale = float(surface.spacing);
  return stretch({surface.coordinate[v],
                  {g.s.dot(d) * scale, g.s.dot(b) * scale, g.t.dot(d) * scale, g.t.dot(b) * scale}});
}

// Mean and spread of the colours.
std::array<double, 6> statistics(const std::vector<float>& rgba) {
  std::array<double, 6> result{};
  const std::size_t count = rgba.size() / 4;
  for (int c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < count; ++i) result[c] += rgba[4 * i + c] / double(count);
    for (std::size_t i = 0; i < count; ++i)
      result[3 + c] += std::pow(rgba[4 * i + c] - result[c], 2) / double(count);
    result[3 + c] = std::sqrt(result[3 + c]);
  }
  return result;
}

std::vector<float> flat(const std::vector<Vec4f>& color) {
  std::vector<float> result;
  for (const Vec4f& c : color) result.insert(result.end(), c.asPointer(), c.asPointer() + 4);
  return result;
}

}  // namespace

TEST_CASE("synthesize: a first frame takes its texels from the whole exemplar, unstretched") {
  const bool toroidal = GENERATE(false, true);
  const SynthesisOptions options = smallOptions();
  Synthesizer synthesizer =
      makeSynthesizer(makeExemplar(blobImage(96, 88, 4, 12.0, 2), toroidal, options, 3), options);
  SynthesisStats stats;
  double last = 0.0;
  bool rising = true;
  const TexturedSurface result = synthesize(synthesizer, sphere(32, 3), {}, 1, 0.0, stats,
                                            [&](double done) { rising &= done >= last, last = done; });
  const std::size_t count = result.positions.size();
  REQUIRE(count == 10u * 32 * 32 + 2);
  CHECK(result.exemplarWidth == 96);
  CHECK(result.exemplarHeight == 88);
  CHECK(rising);
  CHECK(last == Approx(1.0));
  CHECK(stats.renewed == 1.0);
  CHECK(stats.iterations == (3 + 3) * (1 + 3 + 3));
  CHECK(stats.energyEnd < stats.energyStart);
  std::set<std::pair<int, int>> used;
  std::vector<float> stretched;
  for (std::size_t v = 0; v < count; ++v) {
    const Vec2f& q = result.coordinate[v];
    CHECK((q[0] >= 0 && q[0] <= (toroidal ? 96 : 95) && q[1] >= 0 && q[1] <= (toroidal ? 88 : 87)));
    stretched.push_back(stretchAt(result, v));
    float expected[4];
    sampleCubic(synthesizer.exemplar.color, toroidal, q, expected);
    CHECK(result.color[v] == Vec4f(expected));
    CHECK(result.age[v] == 0.0f);
    CHECK(result.trust[v] == 0.0f);
    CHECK(result.previousPosition[v] == result.positions[v]);
    used.insert({int(q[0]) / 12, int(q[1]) / 12});
  }
  CHECK(used.size() >= 45);  // of 8 x 8 cells
  // All that there is comes from slips between pieces.
  CHECK(percentile(stretched, 0.5) < 1.05f);
  CHECK(percentile(stretched, 0.95) < 1.15f);
  CHECK(percentile(stretched, 0.999) < 2.0f);
  const std::array<double, 6> surface = statistics(flat(result.color)),
                              exemplar = statistics(synthesizer.exemplar.color.data);
  for (int i = 0; i < 3; ++i) {
    CHECK(surface[i] == Approx(exemplar[i]).margin(0.06));
    CHECK(surface[3 + i] == Approx(exemplar[3 + i]).epsilon(0.2));
  }
}

TEST_CASE("synthesize: neighbours mostly continue each other") {
  const SynthesisOptions options = smallOptions();
  Synthesizer synthesizer =
      makeSynthesizer(makeExemplar(blobImage(96, 88, 4, 12.0, 2), false, options, 3), options);
  SynthesisStats stats;
  const TexturedSurface result = synthesize(synthesizer, sphere(32, 3), {}, 1, 0.0, stats);
  std::size_t edges = 0, whole = 0;
  for (const Vec3I& t : result.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t v = t[i], u = t[(i + 1) % 3];
      const Vec3f way = result.positions[u] - result.positions[v];
      const Vec2f there =
          result.coordinate[v] + Vec2f(result.gradient[v].s.dot(way), result.gradient[v].t.dot(way));
      ++edges;
      whole += (there - result.coordinate[u]).length() < 0.75f;
    }
  }
  CHECK(double(whole) > 0.7 * double(edges));
}

TEST_CASE("synthesize: a surface at rest comes to rest") {
  const SynthesisOptions options = smallOptions();
  Synthesizer synthesizer =
      makeSynthesizer(makeExemplar(blobImage(96, 88, 4, 12.0, 2), false, options, 2), options);
  SynthesisStats stats;
  TexturedSurface last = synthesize(synthesizer, sphere(28, 2), {}, 1, 0.0, stats);
  double later = 0.0;
  for (int frame = 2; frame <= 48; ++frame) {  // longer than two fades
    const TexturedSurface next =
        synthesize(synthesizer, surfaceOf(last), carriedFrom(last), frame, 0.04, stats);
    std::size_t changed = 0;
    for (std::size_t v = 0; v < next.positions.size(); ++v) {
      const bool kept = next.coordinate[v] == last.coordinate[v];
      changed += !kept;
      if (kept && next.age[v] != 0.0f) CHECK(next.age[v] == Approx(last.age[v] + 0.04f));
      CHECK(next.trust[v] == 1.0f);
    }
    const double share = double(changed) / double(next.positions.size());
    CHECK(stats.renewed >= share - 1e-9);
    if (frame > 6) CHECK(stats.renewed < 0.005);
    if (frame > 6) later += stats.renewed;
    last = next;
  }
  CHECK(later < 0.01);
}

TEST_CASE("synthesize: stretched texture is renewed, the rest is kept") {
  const SynthesisOptions options = smallOptions();
  Synthesizer synthesizer =
      makeSynthesizer(makeExemplar(blobImage(96, 88, 4, 12.0, 2), false, options, 2), options);
  SynthesisStats stats;
  TexturedSurface last = synthesize(synthesizer, sphere(28, 2), {}, 1, 0.0, stats);
  for (int frame = 2; frame <= 8; ++frame)  // so that only the stretch is left to repair
    last = synthesize(synthesizer, surfaceOf(last), carriedFrom(last), frame, 0.04, stats);
  Carried carried = carriedFrom(last);
  std::fill(carried.fading.weight.begin(), carried.fading.weight.end(), 0.0f);  // all has rested
  const auto stretched = [&](std::size_t v) { return last.positions[v].x() > 0.2f; };
  for (std::size_t v = 0; v < last.positions.size(); ++v)
    if (stretched(v)) carried.gradient[v].s *= 0.5f;
  TexturedSurface next = synthesize(synthesizer, surfaceOf(last), carried, 9, 0.04, stats);
  CHECK(stats.renewed > 0.2);
  CHECK(stats.renewed < 0.5);  // not all at once: the cap is 0.4 of the sphere, its rim a tenth
  for (int frame = 10; frame <= 14; ++frame)
    next = synthesize(synthesizer, surfaceOf(next), carriedFrom(next), frame, 0.04, stats);
  std::size_t touched = 0, whole = 0;
  for (std::size_t v = 0; v < next.positions.size(); ++v) {
    if (last.positions[v].x() > -0.4f) continue;  // beyond what wear is averaged over and discs' rims
    ++whole;
    touched += next.coordinate[v] != last.coordinate[v];
  }
  CHECK(double(touched) < 0.01 * double(whole));

  const auto still = [&] {
    std::size_t parts = 0, found = 0;
    for (std::size_t v = 0; v < next.positions.size(); ++v)
      parts += stretched(v), found += stretched(v) && stretchAt(next, v) > 1.4f;
    return double(found) / double(parts);
  };
  CHECK(still() < 0.03);
}

TEST_CASE("synthesize: small drops and odd parts get texture, and keep it") {
  // A large sphere and three drops of 12, 42 and 162 vertices.
  Surface surface;
  for (const int level : {0, 1}) {
    SurfaceMesh all = sphereMesh(level == 0 ? 16 : 8);
    const double spacing = all.spacing;
    for (const int subdivisions : {1, 2, 4}) {
      if (level == 1 && subdivisions > 1) continue;  // the coarser level has lost two of them
      const double radius = 0.5 * subdivisions * spacing;
      const SurfaceMesh drop = sphereMesh(subdivisions, radius, {2.0 + subdivisions, 0, 0});
      const auto base = std::uint32_t(all.positions.size());
      all.positions.insert(all.positions.end(), drop.positions.begin(), drop.positions.end());
      all.normals.insert(all.normals.end(), drop.normals.begin(), drop.normals.end());
      for (const Vec3I& t : drop.triangles) all.triangles.push_back(t + Vec3I(base, base, base));
    }
    all.spacing = spacing;
    surface.levels.push_back(std::move(all));
  }
  orient(surface, {});
  const SynthesisOptions options = smallOptions();
  Synthesizer synthesizer =
      makeSynthesizer(makeExemplar(blobImage(80, 80, 4, 12.0, 2), false, options, 2), options);
  SynthesisStats stats;
  const TexturedSurface first = synthesize(synthesizer, surface, {}, 1, 0.0, stats);
  for (const TexelGradient& g : first.gradient) CHECK((g.s.length() > 0.0f && std::isfinite(g.s.length())));
  const TexturedSurface next = synthesize(synthesizer, surfaceOf(first), carriedFrom(first), 2, 0.04, stats);
  for (const Vec4f& c : next.color) CHECK((std::isfinite(c[0]) && c[3] == 1.0f));
}

TEST_CASE("synthesize: the same on one thread and on many") {
  SynthesisOptions options = smallOptions();
  options.method = GENERATE(Method::coordinates, Method::kwatra07);
  TexturedSurface results[2];
  for (int i = 0; i < 2; ++i) {
    onThreads(i == 0 ? 1 : 4, [&] {
      Synthesizer synthesizer =
          makeSynthesizer(makeExemplar(blobImage(80, 80, 4, 12.0, 2), false, options, 2), options);
      SynthesisStats stats;
      const TexturedSurface first = synthesize(synthesizer, sphere(16, 2), {}, 1, 0.0, stats);
      Carried carried = carriedFrom(first);
      for (TexelGradient& g : carried.gradient) g.s *= 1.45f;
      results[i] = synthesize(synthesizer, surfaceOf(first), carried, 2, 0.04, stats);
    });
  }
  CHECK(results[0].color == results[1].color);
  CHECK(results[0].coordinate == results[1].coordinate);
  CHECK(results[0].age == results[1].age);
}

TEST_CASE("synthesize: frames and seeds have random numbers of their own") {
  SynthesisOptions options = smallOptions();
  const auto run = [&](std::uint64_t seed, int frame) {
    options.seed = seed;
    Synthesizer synthesizer =
        makeSynthesizer(makeExemplar(blobImage(80, 80, 4, 12.0, 2), false, options, 1), options);
    SynthesisStats stats;
    return synthesize(synthesizer, sphere(10, 1), {}, frame, 0.0, stats).coordinate;
  };
  CHECK(run(1, 1) == run(1, 1));
  CHECK(run(1, 1) != run(2, 1));
  CHECK(run(1, 1) != run(1, 2));
}

TEST_CASE("synthesize: the paper's method carries and averages colours") {
  SynthesisOptions options = smallOptions();
  options.method = Method::kwatra07;
  options.histogram = 0.0;
  Image image = blobImage(80, 80, 4, 12.0, 2);
  Synthesizer synthesizer = makeSynthesizer(makeExemplar(image, false, options, 2), options);
  CHECK(synthesizer.exemplar.match[0].channels == 3);
  SynthesisStats stats;
  const TexturedSurface first = synthesize(synthesizer, sphere(20, 2), {}, 1, 0.0, stats);
  const TexturedSurface next = synthesize(synthesizer, surfaceOf(first), carriedFrom(first), 2, 0.04, stats);
  CHECK(stats.renewed == 1.0);
  double difference = 0.0;
  std::size_t looked = 0;
  for (std::size_t v = 0; v < next.color.size(); ++v) {
    difference += (next.color[v] - first.color[v]).length() / double(next.color.size());
    float texel[4];
    sampleCubic(synthesizer.exemplar.color, false, next.coordinate[v], texel);
    looked += (Vec4f(texel) - next.color[v]).length() < 1e-4f;
  }
  CHECK(difference < 0.15);                                 // it starts from and is held to what was carried
  CHECK(double(looked) < 0.1 * double(next.color.size()));  // averages, not texels
  const std::array<double, 6> surface = statistics(flat(next.color)), exemplar = statistics(image.data);
  for (int i = 0; i < 3; ++i) CHECK(surface[i] == Approx(exemplar[i]).margin(0.08));
}

TEST_CASE("synthesize: the smallest exemplars that are taken give texture on every frame") {
  SynthesisOptions options = smallOptions();
  options.method = GENERATE(Method::coordinates, Method::kwatra07);
  options.windows = {3};
  const bool toroidal = GENERATE(false, true);
  const int side = toroidal ? 3 : 5;
  Synthesizer synthesizer =
      makeSynthesizer(makeExemplar(blobImage(side, side, 4, 3.0, 2), toroidal, options, 3), options);
  SynthesisStats stats;
  TexturedSurface last = synthesize(synthesizer, sphere(8, 3), {}, 1, 0.0, stats);
  for (int frame = 2; frame <= 3; ++frame)
    last = synthesize(synthesizer, surfaceOf(last), carriedFrom(last), frame, 0.04, stats);
  for (std::size_t v = 0; v < last.positions.size(); ++v) {
    CHECK((last.coordinate[v][0] >= 0.0f && last.coordinate[v][0] <= float(side)));
    CHECK((last.color[v][0] >= 0.0f && last.color[v][0] <= 1.001f));
  }
}

TEST_CASE("synthesize: alpha is matched and looked up") {
  const SynthesisOptions options = smallOptions();
  Image image = blobImage(80, 80, 4, 12.0, 2);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 80; ++x) image.at(x, y)[3] = (x / 10 + y / 10) % 2 ? 1.0f : 0.0f;
  Synthesizer synthesizer = makeSynthesizer(makeExemplar(image, false, options, 2), options);
  CHECK(synthesizer.exemplar.colorChannels == 4);
  SynthesisStats stats;
  const TexturedSurface result = synthesize(synthesizer, sphere(16, 2), {}, 1, 0.0, stats);
  double mean = 0.0;
  for (const Vec4f& c : result.color) mean += c[3] / double(result.color.size());
  CHECK(mean == Approx(0.5).margin(0.12));
}

TEST_CASE("synthesize: no surface gives no texture, wrong sizes are refused") {
  const SynthesisOptions options = smallOptions();
  Synthesizer synthesizer =
      makeSynthesizer(makeExemplar(blobImage(40, 40, 4, 12.0, 2), false, options, 1), options);
  SynthesisStats stats;
  CHECK(synthesize(synthesizer, {}, {}, 1, 0.0, stats).empty());
  SynthesisOptions without = options;
  without.windows.clear();
  CHECK_THROWS_AS(makeSynthesizer(makeExemplar(blobImage(40, 40, 4, 12.0, 2), false, without, 1), without),
                  std::invalid_argument);
  Surface bare;
  bare.levels.push_back(sphereMesh(4));
  CHECK_THROWS_AS(synthesize(synthesizer, bare, {}, 1, 0.0, stats), std::invalid_argument);
  Carried wrong;
  wrong.previousPosition.resize(3);
  CHECK_THROWS_AS(synthesize(synthesizer, sphere(4, 1), wrong, 1, 0.0, stats), std::invalid_argument);
}

TEST_CASE("synthesize: droplets keep what was carried to them, whatever it is worth") {
  const SynthesisOptions options = smallOptions();
  Synthesizer synthesizer =
      makeSynthesizer(makeExemplar(blobImage(64, 64, 4, 12.0, 2), true, options, 1), options);
  SynthesisStats stats;
  for (const int subdivisions : {2, 4}) {  // 42 vertices, fewer than 9 x 9 pixels, and 162
    const TexturedSurface first = synthesize(synthesizer, sphere(subdivisions, 1), {}, 1, 0.0, stats);
    Carried carried = carriedFrom(first);
    carried.trust.assign(first.positions.size(), 0.0f);
    std::fill(carried.coordinate.begin(), carried.coordinate.end(), Vec2f(7.0f, 9.0f));
    const TexturedSurface second = synthesize(synthesizer, surfaceOf(first), carried, 2, 0.1, stats);
    CHECK((stats.renewed == 0.0) == (subdivisions == 2));
    CHECK((second.coordinate == carried.coordinate) == (subdivisions == 2));
  }
}

TEST_CASE("synthesize: a droplet beside a ball whose texture is renewed keeps what was carried") {
  const SynthesisOptions options = smallOptions();
  Synthesizer synthesizer =
      makeSynthesizer(makeExemplar(blobImage(64, 64, 4, 12.0, 2), true, options, 1), options);
  Surface both;
  both.levels.push_back(together(sphereMesh(6), sphereMesh(2, 1.0, {4.0, 0.0, 0.0})));
  orient(both, {});
  SynthesisStats stats;
  const TexturedSurface first = synthesize(synthesizer, both, {}, 1, 0.0, stats);
  Carried carried = carriedFrom(first);
  carried.trust.assign(first.positions.size(), 0.0f);
  const TexturedSurface second = synthesize(synthesizer, both, carried, 2, 0.1, stats);
  CHECK(stats.renewed > 0.3);
  std::size_t droplet = 0;
  for (std::size_t v = 0; v < first.positions.size(); ++v) {
    if (first.positions[v].x() < 2.0f) continue;
    ++droplet;
    CHECK(second.coordinate[v] == carried.coordinate[v]);
  }
  CHECK(droplet == 42);
}
