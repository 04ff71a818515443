#include "render/render.h"
#include "render/path_tracer.h"
#include "shapes.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::render;
using namespace fluidtex::render::shapes;

namespace {

// A scene with a bit of everything: a spotted ball, partly see-through if asked, a solid, ground and tank.
texture::TexturedSurface spottedBall(float alpha) {
  auto ball = sphere(Vec3f(0.5f, 0.5f, 0.4f), 0.35f, 4, Vec4f(1.0f));
  for (std::size_t i = 0; i < ball.color.size(); ++i)
    ball.color[i] = i % 3 ? Vec4f(0.2f, 0.5f, 0.1f, alpha) : Vec4f(0.05f, 0.1f, 0.03f, 1.0f);
  return ball;
}

Options smallPicture(int width, int height, int samples) {
  Options options;
  options.width = width;
  options.height = height;
  options.samples = samples;
  options.noise = 0.0;
  return options;
}

}  // namespace

TEST_CASE("render: the same bytes on any number of threads", "[render]") {
  const std::vector<Solid> solids{square(0.1f, 0.4f, 0.2f, Vec3d(0.3, 0.2, 0.1))};
  for (const float alpha : {1.0f, 0.6f}) {
    auto ball = spottedBall(alpha);
    Options options = smallPicture(97, 55, 40);
    options.noise = 0.05;
    if (alpha < 1.0f) {
      options.material.kind = MaterialKind::water;
      options.camera.shutter = 0.5;
      options.camera.aperture = 0.02;
      ball.velocity.assign(ball.positions.size(), Vec3f(0.5f, 0.2f, 0.0f));
    }
    std::vector<Picture> pictures;
    for (const int threads : {1, 2, 5, 5}) {
      onThreads(threads,
                [&] { pictures.push_back(fluidtex::render::render(ball, solids, options, unitView())); });
    }
    for (const Picture& picture : pictures) REQUIRE(picture.rgb == pictures[0].rgb);
  }
}

TEST_CASE("render: another frame has other noise but the same picture", "[render]") {
  const auto ball = spottedBall(1.0f);
  View view = unitView();
  const Picture a = fluidtex::render::render(ball, {}, smallPicture(64, 36, 16), view);
  view.frame = 2;
  const Picture b = fluidtex::render::render(ball, {}, smallPicture(64, 36, 16), view);
  REQUIRE(a.rgb != b.rgb);
  double difference = 0.0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) difference += std::abs(a.rgb[i] - b.rgb[i]);
  REQUIRE(difference / static_cast<double>(a.rgb.size()) < 0.02);
}

TEST_CASE("render: without liquid the surroundings are seen", "[render]") {
  const Picture picture = fluidtex::render::render({}, {}, smallPicture(64, 36, 4), unitView());
  REQUIRE(picture.rgb.size() == 64 * 36 * 3);
  const auto [darkest, brightest] = std::minmax_element(picture.rgb.begin(), picture.rgb.end());
  REQUIRE(*darkest > 0.05f);  // no black anywhere
  REQUIRE(*brightest < 1.0f);
  REQUIRE(*brightest > *darkest + 0.2f);
}

TEST_CASE("render: liquid without texture is drawn in a plain colour", "[render]") {
  auto ball = spottedBall(1.0f);
  ball.color.clear();
  const Picture picture = fluidtex::render::render(ball, {}, smallPicture(32, 18, 16), unitView());
  const Vec3f middle = pixel(picture, 16, 9);
  REQUIRE(middle[2] > middle[0] * 1.2f);
}

TEST_CASE("render: any size of picture works", "[render]") {
  const auto ball = spottedBall(1.0f);
  for (const auto& [width, height] : {std::pair{1, 1}, {17, 9}, {33, 1}, {5, 31}}) {
    const Picture picture = fluidtex::render::render(ball, {}, smallPicture(width, height, 3), unitView());
    REQUIRE(picture.width == width);
    REQUIRE(picture.height == height);
    REQUIRE(picture.rgb.size() == static_cast<std::size_t>(width * height * 3));
    for (const float value : picture.rgb) REQUIRE((value > 0.0f && value <= 1.0f));
  }
}

TEST_CASE("render: exposure scales, and only highlights are bent", "[render]") {
  Options options = evenLight(4, 4, 1);
  options.light.skyColor = options.light.horizonColor = Vec3d(0.3);
  for (const double exposure : {0.5, 1.0, 2.5}) {
    options.exposure = exposure;
    REQUIRE(pixel(fluidtex::render::render({}, {}, options, unitView()), 1, 1)[0] == Approx(0.3 * exposure));
  }
  float before = 0.0f;
  for (const double exposure : {2.6, 2.8, 3.3, 5.0, 9.0}) {
    options.exposure = exposure;
    const float now = pixel(fluidtex::render::render({}, {}, options, unitView()), 1, 1)[0];
    REQUIRE(now > before);
    REQUIRE(now <= 1.0f);
    before = now;
  }
}

TEST_CASE("develop: what another renderer gives is made as our own pictures are", "[render]") {
  fluidtex::render::Picture picture{2, 1, {0.0f, 0.3f, 0.64f, 0.8f, 2.0f, NAN}};
  develop(picture, 1.25);
  const auto bent = [](double x) { return 0.8 + 0.2 * (1.0 - std::exp(-(1.25 * x - 0.8) / 0.2)); };
  const double expected[] = {0.0, 0.375, 0.8, bent(0.8), bent(2.0), 0.0};
  for (std::size_t k = 0; k < 6; ++k) CHECK(picture.rgb[k] == Approx(expected[k]).margin(1e-6));
}

TEST_CASE("render: a texture's mid green that faces the light looks mid green", "[render]") {
  Options options = smallPicture(9, 9, 64);
  options.surroundings.ground = options.surroundings.tank = false;
  options.gloss = 0.0;
  options.camera.at = Vec3d(0.5);
  options.camera.from = options.camera.at + options.light.sunDirection * 3.0;
  const auto ball = sphere(Vec3f(0.5f), 0.4f, 3, Vec4f(0.1f, 0.3f, 0.08f, 1.0f));
  const Vec3f seen = pixel(fluidtex::render::render(ball, {}, options, unitView()), 4, 4);
  REQUIRE(seen[1] == Approx(0.3f).epsilon(0.15));
  REQUIRE(seen[0] / seen[1] == Approx(1.0f / 3.0f).epsilon(0.1));
}

TEST_CASE("render: progress grows to 1", "[render]") {
  double before = 0.0;
  fluidtex::render::render({}, {}, smallPicture(70, 40, 1), unitView(), [&](double progress) {
    if (!(progress > before && progress <= 1.0)) throw std::logic_error("progress went back");
    before = progress;
  });
  REQUIRE(before == 1.0);
}
