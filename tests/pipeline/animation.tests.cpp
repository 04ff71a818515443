#include "pipeline/animation.h"

#include "tests/scratch.h"
#include "tests/texture/exemplar/test_images.h"
#include "texture/exemplar/read_image.h"
#include "texture/shown/maps.h"
#include "tools/formats/exemplar_picture.h"

#include <catch2/catch.hpp>

#include <fstream>

using namespace fluidtex;

namespace {

// Four pictures of 8 x 8 pixels.
struct Sequence {
  Scratch scratch;
  texture::AnimationOptions options;

  explicit Sequence(texture::ShowBy by) {
    options.by = by;
    options.rate = 10.0;
    options.pattern = scratch.path / "p_%d.png";
    for (int n = 0; n < 4; ++n) {
      options.files.push_back(scratch.path / ("p_" + std::to_string(n) + ".png"));
      std::ofstream(options.files.back(), std::ios::binary)
          << tools::pngOf(testing::blobImage(8, 8, 4, 5.0, std::uint64_t(n)));
    }
  }
};

texture::TexturedSurface twoVertices() {
  texture::TexturedSurface surface;
  surface.exemplarWidth = surface.exemplarHeight = 8;
  surface.positions.resize(2);
  surface.coordinate = {{2.0f, 1.0f}, {5.5f, 2.0f}};
  surface.fading = texture::noFading(2);
  surface.color.resize(2, texture::Vec4f(0.5f));
  return surface;
}

}  // namespace

TEST_CASE("animation: an exemplar of one picture changes nothing", "[pipeline]") {
  pipeline::Animation still;
  texture::TexturedSurface surface = twoVertices();
  CHECK_FALSE(still.moves());
  CHECK_FALSE(still.pictureAt(1.0).has_value());
  still.show(1.0, {}, surface);
  CHECK(surface.color[0] == texture::Vec4f(0.5f));
}

TEST_CASE("animation: time shows one picture everywhere, in whatever order frames are asked for",
          "[pipeline]") {
  const Sequence sequence(texture::ShowBy::time);
  pipeline::Animation forth(sequence.options, true), back(sequence.options, true);
  std::vector<std::vector<float>> seen;
  for (const double seconds : {0.0, 0.05, 0.3, 0.37}) seen.push_back(forth.pictureAt(seconds)->data);
  CHECK(back.pictureAt(0.37)->data == seen[3]);
  CHECK(back.pictureAt(0.3)->data == seen[2]);
  CHECK(back.pictureAt(0.05)->data == seen[1]);
  CHECK(back.pictureAt(0.0)->data == seen[0]);
  CHECK(seen[2] == texture::readImage(sequence.options.files[3]).data);

  texture::TexturedSurface shown = twoVertices(), looked = twoVertices();
  back.show(0.37, {}, shown);
  texture::lookUpColor(*forth.pictureAt(0.37), true, looked);
  CHECK(shown.color == looked.color);
}

TEST_CASE("animation: guidance shows each place its own picture", "[pipeline]") {
  const Sequence sequence(texture::ShowBy::guidance);
  pipeline::Animation animation(sequence.options, true);
  CHECK(animation.byGuidance());
  CHECK_FALSE(animation.pictureAt(0.0).has_value());
  texture::TexturedSurface shown = twoVertices(), first = twoVertices(), last = twoVertices();
  animation.show(0.0, {0.0f, 1.0f}, shown);
  texture::lookUpColor(texture::readImage(sequence.options.files[0]), true, first);
  texture::lookUpColor(texture::readImage(sequence.options.files[3]), true, last);
  CHECK(shown.color[0] == first.color[0]);
  CHECK(shown.color[1] == last.color[1]);
}

TEST_CASE("animation: a picture that has gone is named", "[pipeline]") {
  const Sequence sequence(texture::ShowBy::time);
  pipeline::Animation animation(sequence.options, true);
  std::filesystem::remove(sequence.options.files[2]);
  CHECK_NOTHROW(animation.pictureAt(0.1));
  CHECK_THROWS_WITH(animation.pictureAt(0.2), Catch::Contains("p_2.png"));
}
