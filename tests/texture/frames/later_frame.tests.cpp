#include "texture/frames/later_frame.h"

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/frames/textured_spheres.h"
#include "texture/frames/synthesize.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using fluidtex::randomUnit;

namespace {

constexpr double kStep = 0.04;  // s

// A textured sphere and what it hands on if nothing moves.
struct Rested {
  SynthesisOptions options = smallOptions();
  Synthesizer synthesizer =
      makeSynthesizer(makeExemplar(blobImage(80, 72, 4, 12.0, 2), false, options, 2), options);
  Surface surface = sphere(20, 2);
  TexturedSurface first;
  Carried carried;

  Rested() {
    SynthesisStats stats;
    first = synthesize(synthesizer, surface, {}, 1, 0.0, stats);
    carried = carriedFrom(first);
  }
  // levels: of the surface that is handed over.
  LaterFrame next(SynthesisStats& stats, std::size_t levels = 1, int frame = 2) {
    Surface shown = surface;
    shown.levels.resize(levels);
    const PreparedMesh prepared(shown.levels.front());
    return synthesizeLater(synthesizer, shown, prepared.view(), carried, {frame, kStep}, stats, {});
  }
  Labels transported() const {
    return labelsOf(surface.levels.front(), carried.coordinate, carried.gradient);
  }
  // As of surface that has just come to light: any place, of no trust.
  void doubt(std::size_t v) {
    carried.trust[v] = 0.1f;
    carried.coordinate[v] = Vec2f(float(79.0 * randomUnit(1, 2 * v)), float(71.0 * randomUnit(1, 2 * v + 1)));
  }
  // Draws out the texture by `factor` where x is above 0.
  void stretchHalf(float factor) {
    for (std::size_t v = 0; v < carried.gradient.size(); ++v)
      if (first.positions[v].x() > 0.0f) carried.gradient[v].s /= factor;
  }
};

std::size_t renewedIn(const LaterFrame& later) {
  return std::accumulate(later.renewed.begin(), later.renewed.end(), std::size_t(0));
}

}  // namespace

TEST_CASE("later frame: what is kept has the transported label, what is renewed another") {
  Rested rested;
  rested.stretchHalf(2.0f);
  SynthesisStats stats;
  const LaterFrame later = rested.next(stats);
  const Labels transported = rested.transported();
  REQUIRE(later.labels.size() == transported.size());
  REQUIRE(later.renewed.size() == transported.size());
  REQUIRE(later.fadingSpeed.size() == transported.size());
  CHECK(stats.iterations > 0);
  std::size_t renewed = 0, onTheHalf = 0;
  for (std::size_t v = 0; v < transported.size(); ++v) {
    const bool same =
        later.labels[v].texel == transported[v].texel && later.labels[v].jacobian == transported[v].jacobian;
    CHECK(same == !later.renewed[v]);
    renewed += later.renewed[v];
    onTheHalf += later.renewed[v] && rested.first.positions[v].x() > -0.2f;
  }
  CHECK(renewed > transported.size() / 20);
  CHECK(onTheHalf > 0.9 * double(renewed));
}

TEST_CASE("later frame: within a cross-fade nothing is renewed that can be believed") {
  Rested rested;
  rested.stretchHalf(2.0f);
  std::fill(rested.carried.fading.weight.begin(), rested.carried.fading.weight.end(), 0.3f);
  SynthesisStats stats;
  const LaterFrame later = rested.next(stats);
  CHECK(renewedIn(later) == 0);
  CHECK(stats.iterations == 0);
  const Labels transported = rested.transported();
  for (std::size_t v = 0; v < transported.size(); ++v) CHECK(later.labels[v].texel == transported[v].texel);
  // What cannot be believed is.
  for (std::size_t v = 0; v < transported.size(); ++v)
    if (rested.first.positions[v].z() > 0.3f) rested.doubt(v);
  const LaterFrame fresh = rested.next(stats);
  std::size_t doubted = 0;
  for (std::size_t v = 0; v < transported.size(); ++v) {
    doubted += rested.carried.trust[v] < 0.3f;
    if (fresh.renewed[v]) CHECK(rested.carried.trust[v] < 0.3f);
  }
  CHECK(renewedIn(fresh) > 0.95 * double(doubted));
}

TEST_CASE("later frame: locked texture stays however it is stretched, but new surface gets some") {
  Rested rested;
  rested.stretchHalf(2.0f);
  const std::size_t count = rested.first.positions.size();
  rested.carried.renewal.assign(count, 1.0f);
  const auto locked = [&](std::size_t v) { return rested.first.positions[v].y() > 0.0f; };
  for (std::size_t v = 0; v < count; ++v)
    if (locked(v)) rested.carried.renewal[v] = 0.0f;
  SynthesisStats stats;
  const LaterFrame later = rested.next(stats);
  CHECK(renewedIn(later) > count / 50);
  for (std::size_t v = 0; v < count; ++v)
    if (locked(v)) CHECK_FALSE(later.renewed[v]);
  for (std::size_t v = 0; v < count; ++v)
    if (locked(v) && rested.first.positions[v].z() > 0.3f) rested.doubt(v);
  const LaterFrame fresh = rested.next(stats);
  std::size_t doubted = 0, renewed = 0;
  for (std::size_t v = 0; v < count; ++v) {
    if (!locked(v)) continue;
    if (fresh.renewed[v]) CHECK(rested.carried.trust[v] < 0.3f);
    doubted += rested.carried.trust[v] < 0.3f;
    renewed += fresh.renewed[v];
  }
  CHECK(double(renewed) > 0.95 * double(doubted));
}

TEST_CASE("later frame: where wear counts more, texture is renewed sooner, where it counts less, later") {
  Rested rested;
  rested.stretchHalf(1.15f);  // less than keepStretch
  const std::size_t count = rested.first.positions.size();
  SynthesisStats stats;
  const std::size_t usual = renewedIn(rested.next(stats));
  rested.carried.renewal.assign(count, 0.5f);
  CHECK(renewedIn(rested.next(stats)) < usual / 4);
  rested.carried.renewal.assign(count, 5.0f);
  CHECK(renewedIn(rested.next(stats)) > 3 * usual + count / 10);
}

TEST_CASE("later frame: fades last as the options say, and less where the flow would draw them out") {
  Rested rested;
  rested.options.fade = rested.synthesizer.options.fade = 0.5;
  SynthesisStats stats;
  for (const float speed : rested.next(stats).fadingSpeed) CHECK(speed == Approx(2.0f).epsilon(1e-4));
  // A sphere that grows by a tenth in each direction.
  for (Vec3f& x : rested.carried.previousPosition) x /= 1.1f;
  const double rate = std::log(1.1) / kStep, most = 1.8 * std::log(rested.options.keepStretch);
  REQUIRE(rate / most > 2.0);
  for (const float speed : rested.next(stats).fadingSpeed) CHECK(speed == Approx(rate / most).epsilon(0.01));
}

TEST_CASE("later frame: wide fresh surface is textured coarse to fine, where there are coarser levels") {
  Rested rested;
  for (std::size_t v = 0; v < rested.carried.trust.size(); ++v) rested.doubt(v);
  SynthesisStats fine, coarse;
  const LaterFrame alone = rested.next(fine, 1), whole = rested.next(coarse, 2);
  // The coarser level's two windows, thrice three times each.
  CHECK(coarse.iterations == fine.iterations + 2 * 3 * 3);
  const std::size_t count = alone.labels.size();
  CHECK(renewedIn(alone) > 0.9 * double(count));
  CHECK(renewedIn(whole) > 0.9 * double(count));
  std::size_t differ = 0;
  for (std::size_t v = 0; v < count; ++v) differ += alone.labels[v].texel != whole.labels[v].texel;
  CHECK(differ > count / 2);
}

TEST_CASE("later frame: frames have random numbers of their own") {
  Rested rested;
  rested.stretchHalf(2.0f);
  SynthesisStats stats;
  const auto texels = [&](int frame) {
    std::vector<Vec2f> result;
    for (const Label& label : rested.next(stats, 1, frame).labels) result.push_back(label.texel);
    return result;
  };
  const std::vector<Vec2f> second = texels(2);
  CHECK(second == texels(2));
  CHECK(second != texels(3));
}
