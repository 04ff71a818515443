// What paths meet: rounds of them, clear liquid, and what glows.
#include "render/tile_tracer.h"
#include "render/black_body.h"
#include "render/path_tracer.h"
#include "shapes.h"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>

using namespace fluidtex;
using namespace fluidtex::render;
using namespace fluidtex::render::shapes;

namespace {

double meanOf(const Picture& picture) {
  double sum = 0.0;
  for (const float value : picture.rgb) sum += value;
  return sum / double(picture.rgb.size());
}

// A closed box with flat faces.
texture::TexturedSurface box(const Vec3f& low, const Vec3f& high) {
  texture::TexturedSurface surface;
  for (int i = 0; i < 8; ++i)
    surface.positions.emplace_back(i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1],
                                   i & 4 ? high[2] : low[2]);
  for (const auto& [a, b, c, d] : {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4},
                                   std::array{2, 6, 7, 3}, std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}}) {
    surface.triangles.emplace_back(a, b, c);
    surface.triangles.emplace_back(a, c, d);
  }
  surface.color.assign(8, Vec4f(0.0f));
  return surface;
}

Options water(int size, int samples, double index) {
  Options options = evenLight(size, size, samples);
  options.camera.from = Vec3d(0.5, 0.5, 100.0);
  options.camera.at = Vec3d(0.5, 0.5, 0.0);
  options.camera.fov = 2.0 * std::atan(0.2 / 100.0) * 180.0 / 3.14159265358979;
  options.gloss = 1.0;
  options.roughness = 0.01;
  options.bounces = 6;
  options.material.kind = MaterialKind::water;
  options.material.index = index;
  options.material.absorption = Vec3d(0.0);
  return options;
}

}  // namespace

TEST_CASE("noise bound: quiet tiles are done after the first round, others go on to the end", "[render]") {
  const auto ball = sphere(Vec3f(0.5f), 0.4f, 3, Vec4f(0.5f, 0.4f, 0.3f, 1.0f));
  const auto traced = [&](int samples, double noise) {
    Options options;
    options.width = 48;
    options.height = 27;
    options.samples = samples;
    options.noise = noise;
    return traceRadiance(ball, {}, options, unitView()).rgb;
  };
  CHECK(traced(128, 0.9) == traced(16, 0.0));
  CHECK(traced(128, 1e-9) == traced(128, 0.0));
  const auto error = [&](const std::vector<float>& rgb) {
    static const std::vector<float> exact = traced(4096, 0.0);
    double sum = 0.0;
    for (std::size_t i = 0; i < rgb.size(); ++i) sum += std::pow(rgb[i] - exact[i], 2.0);
    return std::sqrt(sum / double(rgb.size()));
  };
  CHECK(error(traced(256, 0.0)) < 0.4 * error(traced(16, 0.0)));
  CHECK(error(traced(1024, 0.004)) < 0.008);  // of radiance, which is displayed brighter
}

TEST_CASE("clear liquid: a ball of it in a white sky cannot be seen", "[render]") {
  Options options = water(24, 64, 1.333);
  options.camera.fov = 30.0;
  options.camera.from = Vec3d(2.0, -1.0, 1.5);
  const Picture picture = traceRadiance(sphere(Vec3f(0.5f), 0.45f, 4, Vec4f(0.0f)), {}, options, unitView());
  CHECK(meanOf(picture) == Approx(1.0).epsilon(0.005));
}

TEST_CASE("clear liquid: a slab absorbs and mirrors as the closed form says", "[render]") {
  Options options = water(8, 4096, 1.5);
  options.material.absorption = Vec3d(0.7, 2.0, 0.0);
  const Picture picture =
      traceRadiance(box(Vec3f(-9.0f, -9.0f, 0.0f), Vec3f(9.0f, 9.0f, 0.8f)), {}, options, unitView());
  const double r = 0.04;  // ((n - 1) / (n + 1))^2
  for (int k = 0; k < 3; ++k) {
    double sum = 0.0;
    for (std::size_t i = std::size_t(k); i < picture.rgb.size(); i += 3) sum += picture.rgb[i];
    const double left = std::exp(-options.material.absorption[k] * 0.8), back = r * r * left * left;
    const double through = (1 - r) * (1 - r) * left / (1 - back);
    const double mirrored = r + (1 - r) * (1 - r) * r * left * left / (1 - back);
    CHECK(3.0 * sum / double(picture.rgb.size()) == Approx(through + mirrored).epsilon(0.01));
  }
}

TEST_CASE("clear liquid: a bed in the sun is as bright as the closed form says", "[render]") {
  // A matt bed of albedo a under water without absorption: E T a (1 - r) / (1 - a ri) / (n^2 pi), where ri is
  // the share of diffuse light inside that the surface sends back [Saunderson 1942].
  Options options = water(8, 4096, 1.333);
  options.light.skyColor = options.light.horizonColor = Vec3d(0.0);
  options.light.sunDirection = Vec3d(0.0, 0.0, 1.0);
  options.light.sunColor = Vec3d(3.14159265358979);
  options.light.sunSize = 1.0;
  options.bounces = 24;
  auto pool = box(Vec3f(-60.0f, -60.0f, 0.0f), Vec3f(60.0f, 60.0f, 0.3f));
  pool.contact.assign(8, 0);
  for (int i = 0; i < 4; ++i) pool.contact[std::size_t(i)] = 1;
  const double n = 1.333, r = std::pow((n - 1) / (n + 1), 2.0), diffuse = 0.0664;  // Duntley's, from outside
  const double inside = 1.0 - (1.0 - diffuse) / (n * n);
  // The lowest corner of the meshes' gap is far below what the scene's size allows.
  View view = unitView();
  view.domainSize = Vec3d(10.0);
  for (const double a : {0.2, 0.8}) {
    Solid bed = square(-70.0f, 70.0f, -1e-4f, Vec3d(a));
    // Not mirrored towards the camera: it looks down aslant.
    options.camera.from = Vec3d(30.5, 0.5, 100.0);
    options.camera.at = Vec3d(0.5, 0.5, 0.0);
    const double seen = meanOf(traceRadiance(pool, {bed}, options, view));
    const double out = 1.0 - r;  // at 17 degrees as straight on, to three digits
    CAPTURE(a);
    CHECK(seen == Approx(a * (1.0 - r) * out / (n * n) / (1.0 - a * inside)).epsilon(0.03));
  }
}

TEST_CASE("clear liquid: a camera in it sees what it absorbs", "[render]") {
  Options options = water(8, 1024, 1.0);
  options.material.absorption = Vec3d(1.0, 0.0, 0.0);
  options.camera.from = Vec3d(0.5, 0.5, 0.5);
  options.camera.fov = 1.0;
  const Solid bed = square(-9.0f, 10.0f, -1e-4f, Vec3d(1.0));
  auto pool = box(Vec3f(-9.0f, -9.0f, 0.0f), Vec3f(10.0f, 10.0f, 0.6f));
  pool.contact.assign(8, 0);
  for (int i = 0; i < 4; ++i) pool.contact[std::size_t(i)] = 1;
  options.bounces = 0;
  const Picture picture = traceRadiance(pool, {bed}, options, unitView());
  // Half a metre down, and 0.6 m up in all directions: 2 E3(0.6) of it.
  CHECK(pixel(picture, 4, 4)[0] == Approx(std::exp(-0.5) * 2.0 * 0.1915506).epsilon(0.04));
  CHECK(pixel(picture, 4, 4)[1] == Approx(1.0).epsilon(0.04));
}

TEST_CASE("clear liquid: of the air's own index it changes nothing, on a floor that it wets too",
          "[render]") {
  // The floor crosses the liquid's bottom.
  Solid floor = square(-2.0f, 3.0f, 0.0f, Vec3d(0.5));
  floor.positions[0][2] = floor.positions[3][2] = -2e-4f;
  floor.positions[1][2] = floor.positions[2][2] = 2e-4f;
  Options options = water(16, 256, 1.0);
  options.light.sunColor = Vec3d(1.5);
  options.light.sunDirection = Vec3d(0.3, 0.1, 1.0);
  const double without = meanOf(traceRadiance({}, {floor}, options, unitView()));
  auto pool = box(Vec3f(-1.0f, -1.0f, 0.0f), Vec3f(2.0f, 2.0f, 0.4f));
  pool.contact.assign(8, 0);
  for (int i = 0; i < 4; ++i) pool.contact[std::size_t(i)] = 1;
  const Picture with = traceRadiance(pool, {floor}, options, unitView());
  CHECK(meanOf(with) == Approx(without).epsilon(0.03));
  for (const float value : with.rgb) CHECK(value > 0.85 * without);  // no dark seam where the two cross
  // Texture on the liquid's underside, which nobody sees, shades nothing.
  for (int i = 0; i < 4; ++i) pool.color[std::size_t(i)][3] = 1.0f;
  CHECK(meanOf(traceRadiance(pool, {floor}, options, unitView())) == Approx(without).epsilon(0.03));
}

TEST_CASE("clear liquid: texture lies on it as far as its alpha and `cover` say", "[render]") {
  auto pool = box(Vec3f(-9.0f, -9.0f, 0.0f), Vec3f(9.0f, 9.0f, 0.8f));
  Options options = water(8, 256, 1.0);
  options.bounces = 0;
  const auto brightness = [&](float alpha, double cover) {
    pool.color.assign(8, Vec4f(0.0f, 0.0f, 0.0f, alpha));
    options.material.cover = cover;
    return meanOf(traceRadiance(pool, {}, options, unitView()));
  };
  CHECK(brightness(0.0f, 1.0) == Approx(1.0).epsilon(0.01));
  CHECK(brightness(1.0f, 0.0) == Approx(1.0).epsilon(0.01));
  CHECK(brightness(1.0f, 1.0) < 0.02);
  // Black texture on top and, behind it, at the bottom.
  CHECK(brightness(0.5f, 1.0) == Approx(0.25).margin(0.02));
  CHECK(brightness(1.0f, 0.5) == Approx(0.25).margin(0.02));
}

TEST_CASE("lava: glows as its map says, and lights what is near", "[render]") {
  auto ball = sphere(Vec3f(0.5f, 0.5f, 0.6f), 0.3f, 4, Vec4f(0.0f, 0.0f, 0.0f, 1.0f));
  ball.maps["heat"].assign(ball.positions.size(), 0.5f);
  Options options = evenLight(33, 33, 256);
  options.light.skyColor = options.light.horizonColor = Vec3d(0.0);
  options.bounces = 1;
  options.material = {
      .kind = MaterialKind::lava, .heat = "heat", .coldest = 1000.0, .hottest = 2000.0, .glow = 3.0};
  const Vec3f glow = blackBody(1500.0) * (3.0f / luminance(blackBody(2000.0)));
  const Vec3f seen = pixel(traceRadiance(ball, {}, options, unitView()), 16, 14);
  CHECK((seen - glow).length() < 0.01f * glow.length());

  // On a floor right below: albedo * L (r / h)^2.
  const std::vector<Solid> floor{square(-3.0f, 4.0f, 0.0f, Vec3d(0.5))};
  options.camera.from = Vec3d(0.5, -0.6, 0.25);
  options.camera.at = Vec3d(0.5, 0.5, 0.0);
  options.camera.fov = 2.0;
  const Vec3f lit = pixel(traceRadiance(ball, floor, options, unitView()), 16, 16);
  CHECK(lit[0] == Approx(0.5f * 0.25f * glow[0]).epsilon(0.05));

  options.material.heat = "none";
  const Picture dark = traceRadiance(ball, {}, options, unitView());
  CHECK(meanOf(dark) == 0.0);
}

TEST_CASE("shutter: liquid that moves is blurred along its way, and shows as much", "[render]") {
  // A black ball of radius 0.1 that moves by 0.4 m while the shutter is open, in a white sky.
  auto ball = sphere(Vec3f(0.5f, 0.5f, 0.5f), 0.1f, 3, Vec4f(0.0f, 0.0f, 0.0f, 1.0f));
  ball.velocity.assign(ball.positions.size(), Vec3f(8.0f, 0.0f, 0.0f));
  Options options = evenLight(64, 64, 256);
  options.camera.from = Vec3d(0.5, -20.0, 0.5);
  options.camera.at = Vec3d(0.5);
  options.camera.fov = 2.0 * std::atan(0.5 / 20.5) * 180.0 / 3.14159265358979;
  const double still = 1.0 - meanOf(traceRadiance(ball, {}, options, unitView()));
  options.camera.shutter = 0.5;
  View view = unitView();
  view.frameRate = 10.0;
  const Picture moved = traceRadiance(ball, {}, options, view);
  CHECK(1.0 - meanOf(moved) == Approx(still).epsilon(0.02));
  // In the middle it stands before the sky for a chord of 0.2 m of the way of 0.4 m, at 0.25 m off for a
  // quarter.
  CHECK(pixel(moved, 32, 32)[0] == Approx(0.5f).margin(0.06));
  CHECK(pixel(moved, 32 + 13, 32)[0] == Approx(0.75f).margin(0.08));
  CHECK(pixel(moved, 32 + 22, 32)[0] == 1.0f);
  ball.velocity.clear();
  CHECK(1.0 - meanOf(traceRadiance(ball, {}, options, view)) == Approx(still).epsilon(0.01));
}
