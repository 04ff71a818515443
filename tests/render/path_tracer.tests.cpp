#include "render/path_tracer.h"
#include "shapes.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::render;
using namespace fluidtex::render::shapes;

namespace {

// Looks straight down on [0,1]^2 from far away.
Options fromAbove(int size, int samples) {
  Options options = evenLight(size, size, samples);
  options.camera.from = Vec3d(0.5, 0.5, 100.0);
  options.camera.at = Vec3d(0.5, 0.5, 0.0);
  options.camera.fov = 2.0 * std::atan(0.5 / 100.0) * 180.0 / 3.14159265358979;
  return options;
}

// A sun straight above whose light makes a white surface that faces it as bright as 1.
void onlySun(Options& options, double size) {
  options.light.skyColor = options.light.horizonColor = Vec3d(0.0);
  options.light.sunDirection = Vec3d(0.0, 0.0, 1.0);
  options.light.sunColor = Vec3d(3.14159265358979);
  options.light.sunSize = size;
}

}  // namespace

TEST_CASE("path tracer: a white ball in a white sky cannot be seen", "[render]") {
  const Picture picture =
      traceRadiance(sphere(Vec3f(0.5f), 0.45f, 3, Vec4f(1.0f)), {}, evenLight(64, 48, 8), unitView());
  for (const float value : picture.rgb) REQUIRE(value == Approx(1.0f).margin(1e-3));
}

TEST_CASE("path tracer: white balls that light each other keep all light", "[render]") {
  auto balls = sphere(Vec3f(0.3f, 0.5f, 0.5f), 0.22f, 3, Vec4f(1.0f));
  append(balls, sphere(Vec3f(0.75f, 0.5f, 0.5f), 0.22f, 3, Vec4f(1.0f)));
  Options options = evenLight(48, 32, 16);
  options.bounces = 60;
  const Picture picture = traceRadiance(balls, {}, options, unitView());
  for (const float value : picture.rgb) REQUIRE(value == Approx(1.0f).margin(2e-3));
}

TEST_CASE("path tracer: a grey ball in a white sky has its own colour", "[render]") {
  Options options = evenLight(33, 33, 4);
  const Picture picture =
      traceRadiance(sphere(Vec3f(0.5f), 0.45f, 3, Vec4f(0.2f, 0.4f, 0.1f, 1.0f)), {}, options, unitView());
  const Vec3f middle = pixel(picture, 16, 16);
  REQUIRE((middle - Vec3f(0.2f, 0.4f, 0.1f)).length() < 1e-4f);
  REQUIRE((pixel(picture, 0, 0) - Vec3f(1.0f)).length() < 1e-4f);
}

TEST_CASE("path tracer: the coat never brightens above the light", "[render]") {
  Options options = evenLight(40, 40, 256);
  options.gloss = 1.0;
  for (const float base : {0.0f, 1.0f}) {
    const Picture picture =
        traceRadiance(sphere(Vec3f(0.5f), 0.45f, 4, Vec4f(base, base, base, 1.0f)), {}, options, unitView());
    double sum = 0.0;
    for (const float value : picture.rgb) {
      REQUIRE(value < 1.03f);  // noise of 256 paths
      sum += value;
    }
    REQUIRE(sum / static_cast<double>(picture.rgb.size()) < 1.001);
  }
}

TEST_CASE("path tracer: the coat adds a highlight where the sun is mirrored", "[render]") {
  Options options = fromAbove(65, 16);
  onlySun(options, 3.0);
  const auto ball = sphere(Vec3f(0.5f), 0.45f, 4, Vec4f(0.1f, 0.1f, 0.1f, 1.0f));
  const Picture matt = traceRadiance(ball, {}, options, unitView());
  options.gloss = 1.0;
  const Picture wet = traceRadiance(ball, {}, options, unitView());
  REQUIRE(pixel(matt, 32, 32)[0] == Approx(0.1f).epsilon(0.01));
  REQUIRE(pixel(wet, 32, 32)[0] > 1.0f);
  // Away from it: the base behind the coat, (1-F)^2 / (1-Fmean) with F = 0.0337.
  REQUIRE(pixel(wet, 44, 32)[0] == Approx(pixel(matt, 44, 32)[0] * 1.0146f).epsilon(0.01));
}

TEST_CASE("path tracer: brightness follows the cosine of the sun's angle without facets", "[render]") {
  Options options = fromAbove(65, 64);
  onlySun(options, 0.5);
  options.light.sunDirection = Vec3d(1.0, 0.0, 0.25);
  // A coarse ball: its facets would show at the terminator.
  const auto ball = sphere(Vec3f(0.5f), 0.45f, 2, Vec4f(1.0f));
  const Picture picture = traceRadiance(ball, {}, options, unitView());
  const Vec3d sun = options.light.sunDirection / options.light.sunDirection.length();
  for (int y = 8; y < 57; ++y)
    for (int x = 8; x < 57; ++x) {
      const double nx = ((x + 0.5) / 65 - 0.5) / 0.45, ny = (0.5 - (y + 0.5) / 65) / 0.45;
      if (nx * nx + ny * ny > 0.8) continue;
      const double cosine = Vec3d(nx, ny, std::sqrt(1.0 - nx * nx - ny * ny)).dot(sun);
      REQUIRE(pixel(picture, x, y)[0] == Approx(std::max(0.0, cosine)).margin(0.06));
    }
}

TEST_CASE("path tracer: sunlight and shadow on a flat ground have their closed forms", "[render]") {
  constexpr float kRadius = 10.0f * 3.14159265f / 180.0f;  // of the sun
  Options options = fromAbove(64, 256);
  onlySun(options, 20.0);
  options.bounces = 0;
  const Solid ground = square(-1.0f, 2.0f, 0.0f, Vec3d(0.5));
  const Picture open = traceRadiance({}, {ground}, options, unitView());
  const float lit = 0.5f * 0.5f * (1.0f + std::cos(kRadius));  // mean cosine over the disc
  for (int x = 0; x < 64; ++x) REQUIRE(pixel(open, x, 30)[0] == Approx(lit).epsilon(0.005));

  // A black plate over x < 1/4 at height 1/2. On the ground below, t blur widths from its edge, the part of
  // the sun's disc beyond the edge is seen.
  const Solid plate{{{-9.0f, -9.0f, 0.5f}, {0.25f, -9.0f, 0.5f}, {0.25f, 9.0f, 0.5f}, {-9.0f, 9.0f, 0.5f}},
                    {{0, 1, 2}, {0, 2, 3}},
                    Vec3d(0.0)};
  const Picture picture = traceRadiance({}, {ground, plate}, options, unitView());
  REQUIRE(pixel(picture, 8, 32)[0] == 0.0f);
  for (int x = 18; x < 40; ++x) {
    const float t =
        std::min(1.0f, ((static_cast<float>(x) + 0.5f) / 64.0f - 0.25f) / (0.5f * std::tan(kRadius)));
    const float seen = 0.5f + (t * std::sqrt(1.0f - t * t) + std::asin(t)) / 3.14159265f;
    CAPTURE(x, t);
    REQUIRE(pixel(picture, x, 32)[0] == Approx(lit * seen).margin(0.015));
  }
}

TEST_CASE("path tracer: a small sun has a sharp shadow, a large one a soft shadow", "[render]") {
  const auto greys = [](double sunSize) {
    Options options = fromAbove(64, 16);
    onlySun(options, sunSize);
    options.bounces = 0;
    const Solid wall{{{0.2f, -9.0f, 0.0f}, {0.2f, 9.0f, 0.0f}, {0.2f, 9.0f, 0.4f}, {0.2f, -9.0f, 0.4f}},
                     {{0, 1, 2}, {0, 2, 3}},
                     Vec3d(0.0)};
    options.light.sunDirection = Vec3d(-1.0, 0.0, 1.0);
    const Picture picture =
        traceRadiance({}, {square(-9.0f, 9.0f, 0.0f, Vec3d(1.0)), wall}, options, unitView());
    const float lit = pixel(picture, 62, 32)[0], dark = pixel(picture, 20, 32)[0];
    REQUIRE(dark == 0.0f);
    REQUIRE(lit == Approx(std::sqrt(0.5f)).epsilon(0.02));
    int count = 0;
    for (int x = 0; x < 64; ++x) {
      const float value = pixel(picture, x, 32)[0];
      if (x > 20 && value > 0.02f * lit && value < 0.98f * lit) ++count;
    }
    return count;
  };
  REQUIRE(greys(0.2) <= 3);
  REQUIRE(greys(10.0) >= 6);
}

TEST_CASE("path tracer: alpha lets light through", "[render]") {
  // A black sheet in a white sky: what is seen of the sky behind is 1 - alpha.
  Options options = fromAbove(24, 256);
  for (const float alpha : {0.0f, 0.3f, 1.0f}) {
    texture::TexturedSurface sheet;
    sheet.positions = {{-1, -1, 0.5f}, {2, -1, 0.5f}, {2, 2, 0.5f}, {-1, 2, 0.5f}};
    sheet.normals.assign(4, Vec3f(0, 0, 1));
    sheet.triangles = {{0, 1, 2}, {0, 2, 3}};
    sheet.color.assign(4, Vec4f(0, 0, 0, alpha));
    const Picture seen = traceRadiance(sheet, {}, options, unitView());
    double sum = 0.0;
    for (const float value : seen.rgb) sum += value;
    REQUIRE(sum / static_cast<double>(seen.rgb.size()) == Approx(1.0 - alpha).margin(0.01));

    // And its shadow on a white floor is as light as that.
    Options sun = fromAbove(24, 64);
    onlySun(sun, 1.0);
    sun.bounces = 0;
    sun.camera.from = Vec3d(0.5, 0.5, 0.4);
    sun.camera.fov = 60.0;
    const Picture floor = traceRadiance(sheet, {square(-1.0f, 2.0f, 0.0f, Vec3d(1.0))}, sun, unitView());
    REQUIRE(pixel(floor, 12, 12)[0] == Approx(1.0f - alpha).margin(0.01));
  }
}

TEST_CASE("path tracer: light bounces the number of times it is told to", "[render]") {
  // Between two white planes lit by nothing but a white sky beyond their rims more bounces bring more light.
  const std::vector<Solid> planes{square(-1.0f, 2.0f, 0.0f, Vec3d(0.9)),
                                  square(-1.0f, 2.0f, 0.5f, Vec3d(0.9))};
  float before = 0.0f;
  for (int bounces = 0; bounces < 4; ++bounces) {
    Options options = evenLight(16, 16, 64);
    options.camera.from = Vec3d(0.5, 0.5, 0.4);
    options.camera.at = Vec3d(0.5, 0.5, 0.0);
    options.bounces = bounces;
    const float now = pixel(traceRadiance({}, planes, options, unitView()), 8, 8)[0];
    REQUIRE(now > before * 1.05f);
    before = now;
  }
  REQUIRE(before < 1.0f);
}

TEST_CASE("path tracer: input that does not fit together is refused", "[render]") {
  const auto ball = sphere(Vec3f(0.5f), 0.3f, 0, Vec4f(1.0f));
  auto bad = ball;
  bad.color.pop_back();
  REQUIRE_THROWS_AS(traceRadiance(bad, {}, evenLight(8, 8, 1), unitView()), std::invalid_argument);
  bad = ball;
  bad.normals.pop_back();
  REQUIRE_THROWS_AS(traceRadiance(bad, {}, evenLight(8, 8, 1), unitView()), std::invalid_argument);
  bad = ball;
  bad.triangles[0][1] = 12;
  REQUIRE_THROWS_AS(traceRadiance(bad, {}, evenLight(8, 8, 1), unitView()), std::invalid_argument);
  REQUIRE_THROWS_AS(traceRadiance(ball, {}, evenLight(0, 8, 1), unitView()), std::invalid_argument);
  REQUIRE_THROWS_AS(traceRadiance(ball, {}, evenLight(8, 8, 0), unitView()), std::invalid_argument);
  Options rough = evenLight(8, 8, 1);
  rough.roughness = -0.1;
  REQUIRE_THROWS_AS(traceRadiance(ball, {}, rough, unitView()), std::invalid_argument);
}

TEST_CASE("path tracer: a coat without any roughness is as smooth as coats can be", "[render]") {
  const auto ball = sphere(Vec3f(0.5f), 0.3f, 3, Vec4f(0.2f, 0.2f, 0.2f, 1.0f));
  Options smoothest = evenLight(16, 16, 4);
  smoothest.gloss = 1.0;
  smoothest.roughness = 0.0;
  Options nearly = smoothest;
  nearly.roughness = 0.001;
  const Picture picture = traceRadiance(ball, {}, smoothest, unitView());
  REQUIRE(picture.rgb == traceRadiance(ball, {}, nearly, unitView()).rgb);
  for (const float value : picture.rgb) REQUIRE(std::isfinite(value));
}
