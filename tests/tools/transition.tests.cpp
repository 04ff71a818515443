// fluidtex transition: several exemplars as one.
#include "tests/tools/program.h"
#include "texture/exemplar/read_image.h"
#include "tools/formats/exemplar_picture.h"
#include "tools/formats/read_ply.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <fstream>
#include <string>

namespace fs = std::filesystem;
using namespace fluidtex;

namespace {

// Squares of one colour on black, and the same as a map.
void writePicture(const fs::path& file, const fs::path& map, int channel, int width, int height) {
  texture::Image color{width, height, 4, {}}, number{width, height, 1, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float value = (x / 4 + y / 4) % 2 == 0 ? 1.0f : 0.0f;
      for (int c = 0; c < 3; ++c) color.data.push_back(c == channel ? value : 0.0f);
      color.data.push_back(1.0f);
      number.data.push_back(value);
    }
  std::ofstream(file, std::ios::binary) << tools::pngOf(color);
  std::ofstream(map, std::ios::binary) << tools::pngOfNumbers(number);
}

struct Pictures {
  Scratch scratch;
  std::string red = (scratch.path / "red.png").string(), blue = (scratch.path / "blue.png").string();
  std::string redMap = (scratch.path / "red_h.png").string(),
              blueMap = (scratch.path / "blue_h.png").string();
  fs::path both = scratch.path / "both.png";
  Pictures() {
    writePicture(red, redMap, 0, 64, 48);
    writePicture(blue, blueMap, 2, 80, 40);
  }
};

// Shares of the vertices, of mixture below 0.05 and above 0.95, that show the other exemplar.
struct Astray {
  double first = 0.0, second = 0.0;
  std::size_t between = 0;  // vertices of other mixtures
};

Astray astrayOn(const texture::TexturedSurface& surface, const texture::Image& guidance) {
  Astray result;
  std::size_t first = 0, second = 0;
  for (std::size_t v = 0; v < surface.positions.size(); ++v) {
    const int x = std::clamp(int(surface.coordinate[v][0]), 0, guidance.width - 1);
    const int y = std::clamp(int(surface.coordinate[v][1]), 0, guidance.height - 1);
    const float shown = guidance.at(x, y)[0], wanted = surface.guidance[v];
    if (wanted < 0.05f) {
      ++first;
      result.first += shown > 0.5f;
    } else if (wanted > 0.95f) {
      ++second;
      result.second += shown < 0.5f;
    } else {
      ++result.between;
    }
  }
  result.first /= double(std::max<std::size_t>(first, 1));
  result.second /= double(std::max<std::size_t>(second, 1));
  return result;
}

}  // namespace

TEST_CASE("fluidtex transition: the picture, its guidance and its maps agree", "[tools]") {
  const Pictures pictures;
  const Finished done = runProgram({"transition", pictures.red, pictures.blue, "--out",
                                    pictures.both.string(), "--width", "40", "--feature", "8", "--map",
                                    "height=" + pictures.redMap, "--map", "height=" + pictures.blueMap});
  INFO(done.err);
  REQUIRE(done.exitCode == 0);
  const texture::Image color = texture::readImage(pictures.both);
  const texture::Image guidance = texture::readMap(pictures.scratch.path / "both_guidance.png");
  const texture::Image height = texture::readMap(pictures.scratch.path / "both_height.png");
  REQUIRE(color.width == 64 + 80 - 40);
  REQUIRE(color.height == 40);
  REQUIRE(guidance.width == color.width);
  REQUIRE(height.width == color.width);
  for (int y = 0; y < color.height; ++y)
    for (int x = 0; x < color.width; ++x) {
      const float* pixel = color.at(x, y);
      REQUIRE(height.at(x, y)[0] == Approx(pixel[0] + pixel[2]).margin(0.01));
      if (x < 24) {
        REQUIRE(pixel[2] == 0.0f);
        REQUIRE(guidance.at(x, y)[0] == 0.0f);
      }
      if (x >= 64) {
        REQUIRE(pixel[0] == 0.0f);
        REQUIRE(guidance.at(x, y)[0] == 1.0f);
      }
    }
  for (const char* line :
       {"by = \"mixture\"", "both_guidance.png\"", "name = \"height\"", "both_height.png\""})
    CHECK_THAT(done.out, Catch::Contains(line));
}

TEST_CASE("fluidtex transition: what cannot be joined is refused in one sentence, and nothing is written",
          "[tools]") {
  const Pictures pictures;
  const auto refused = [&](const Words& more, const std::string& why) {
    const Finished done = runProgram(plus({"transition"}, more));
    CHECK(done.exitCode == 1);
    CHECK_THAT(done.err, Catch::StartsWith("error: ") && Catch::Contains(why));
    CHECK(std::count(done.err.begin(), done.err.end(), '\n') == 1);
    CHECK(!fs::exists(pictures.both));
  };
  const std::string out = pictures.both.string();
  const Words two{pictures.red, pictures.blue, "--out", out, "--width", "40"};
  refused({pictures.red, "--out", out}, "is one picture; give two or more");
  refused({pictures.red, pictures.blue, "--out", out}, "and its part of the transitions alone 160");
  refused(plus(two, {"--map", "height=" + pictures.redMap}), "is given for 1 of 2 pictures");
  refused(plus(two, {"--map", "height=" + pictures.redMap, "--map", "height=" + pictures.redMap}),
          "has 64 x 48 pixels, and its picture");
  refused(plus(two, {"--map", "a=" + pictures.redMap, "--map", "a:normals=" + pictures.blueMap}),
          "holds something else than the earlier map");
  refused(plus(two, {"--map", "guidance=" + pictures.redMap}), "give another name");
  refused(plus(two, {"--map", "x=" + pictures.redMap}), "is what every vertex has anyway");
  const std::string before = readBytes(pictures.blue);
  refused({pictures.red, pictures.blue, "--out", pictures.blue, "--width", "40"},
          "is one of the pictures to join");
  CHECK(readBytes(pictures.blue) == before);
}

TEST_CASE("scene of two liquids: each shows its own exemplar, before they meet and after", "[tools][slow]") {
  const Scratch scratch;
  const Finished done =
      runProgram({"run", FLUIDTEX_SOURCE "/scenes/mix.toml", "--quality", "preview", "--out",
                  scratch.path.string(), "--frames", "1:24", "--no-render", "--no-report", "--set",
                  "domain.resolution=32", "--set", "texture.points=3000"});
  INFO(done.err);
  REQUIRE(done.exitCode == 0);
  const texture::Image guidance =
      texture::readMap(FLUIDTEX_SOURCE "/scenes/exemplars/scales_and_lava_guidance.png");
  for (const int frame : {1, 6, 12, 24}) {
    CAPTURE(frame);
    const Astray astray = astrayOn(
        tools::readPly(scratch.path / "surface" /
                           ("00" + std::string(frame < 10 ? "0" : "") + std::to_string(frame) + ".ply"),
                       guidance.width, guidance.height),
        guidance);
    CHECK(astray.first < 0.02);
    CHECK(astray.second < 0.02);
    CHECK((frame == 1) == (astray.between == 0));
  }
}
