#include "texture/transition/join_exemplars.h"

#include <catch2/catch.hpp>

#include <stdexcept>

using namespace fluidtex::texture;

namespace {

// Each pixel tells its picture, column and row.
Image numbered(int number, int width, int height) {
  Image image{width, height, 4, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.data.insert(image.data.end(), {0.1f * float(number), float(x) / 256.0f, float(y) / 256.0f, 1.0f});
  return image;
}

}  // namespace

TEST_CASE("join exemplars: side by side, as high as the lowest, each with its level") {
  const std::vector<Image> pictures{numbered(0, 60, 40), numbered(1, 90, 48), numbered(2, 50, 44)};
  const JoinedExemplars joined = joinExemplars(pictures, {.width = 20, .feature = 8, .seed = 1});
  REQUIRE(joined.height == 40);
  REQUIRE(joined.width == 60 + 90 + 50 - 2 * 20);
  const auto level = [&](int x) { return joined.guidance.at(x, 17)[0]; };
  CHECK(level(0) == 0.0f);
  CHECK(level(39) == 0.0f);
  CHECK(level(50) == Approx(0.5 * 10.5 / 20.0));
  CHECK(level(60) == 0.5f);
  CHECK(level(109) == 0.5f);
  CHECK(level(120) == Approx(0.5 + 0.5 * 10.5 / 20.0));
  CHECK(level(159) == 1.0f);
  for (int x = 1; x < joined.width; ++x) REQUIRE(level(x) >= level(x - 1));

  const Image color = joinedMap(joined, pictures);
  const auto shows = [&](int x, int number, int column, int row) {
    const float* pixel = color.at(x, 5);
    CHECK(pixel[0] == Approx(0.1f * float(number)));
    CHECK(pixel[1] == Approx(float(column) / 256.0f));
    CHECK(pixel[2] == Approx(float(row) / 256.0f));
  };
  shows(0, 0, 0, 5);
  shows(39, 0, 39, 5);
  shows(60, 1, 20, 5 + 4);
  shows(109, 1, 69, 5 + 4);
  shows(159, 2, 49, 5 + 2);
  // In transitions too every pixel is one of the two beside it.
  for (int x = 40; x < 60; ++x) CHECK((color.at(x, 5)[0] == 0.0f || color.at(x, 5)[0] == 0.1f));
}

TEST_CASE("join exemplars: maps are joined as the pictures are") {
  const std::vector<Image> pictures{numbered(0, 60, 40), numbered(1, 60, 40)};
  const JoinedExemplars joined = joinExemplars(pictures, {.width = 30, .feature = 8, .seed = 5});
  std::vector<Image> maps;
  for (const Image& picture : pictures) {
    maps.push_back({picture.width, picture.height, 1, {}});
    for (std::size_t i = 0; i < picture.data.size(); i += 4)
      maps.back().data.push_back(picture.data[i] + picture.data[i + 1] + picture.data[i + 2]);
  }
  const Image color = joinedMap(joined, pictures), map = joinedMap(joined, maps);
  for (int y = 0; y < joined.height; ++y)
    for (int x = 0; x < joined.width; ++x) {
      const float* pixel = color.at(x, y);
      REQUIRE(map.at(x, y)[0] == Approx(pixel[0] + pixel[1] + pixel[2]));
    }
}

TEST_CASE("join exemplars: what it cannot take it refuses") {
  const Image picture = numbered(0, 60, 40);
  CHECK_THROWS_AS(joinExemplars({picture}, {.width = 20}), std::invalid_argument);
  CHECK_THROWS_AS(joinExemplars({picture, picture, picture}, {.width = 31}), std::invalid_argument);
  const JoinedExemplars joined = joinExemplars({picture, picture}, {.width = 20});
  CHECK_THROWS_AS(joinedMap(joined, {picture}), std::invalid_argument);
  CHECK_THROWS_AS(joinedMap(joined, {picture, numbered(0, 60, 30)}), std::invalid_argument);
}
