// fluidtex apply: further maps on a finished run.
#include "tests/tools/program.h"
#include "tools/errors.h"
#include "tools/ply.h"

#include <OpenImageIO/imageio.h>
#include <catch2/catch.hpp>

#include <cmath>

namespace fs = std::filesystem;
using namespace fluidtex;

namespace {

// Bright in the middle, dark at the edges, where a toroidal exemplar leads over: `channels` of 8 bits each.
void writeImage(const fs::path& file, int size, int channels) {
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (int c = 0; c < channels; ++c)
        pixels.push_back(std::uint8_t(std::lround(255.0 * std::sin(M_PI * (x + 0.5) / size) *
                                                  std::sin(M_PI * (y + 0.5) / size) / (c + 1))));
  const auto out = OIIO::ImageOutput::create(file.string());
  REQUIRE(out);
  REQUIRE(out->open(file.string(), OIIO::ImageSpec(size, size, channels, OIIO::TypeDesc::UINT8)));
  REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, pixels.data()));
  out->close();
}

texture::TexturedSurface surfaceOf(const fs::path& out, int frame) {
  return tools::readPly(out / "surface" / ("000" + std::to_string(frame) + ".ply"), 256, 256);
}

}  // namespace

TEST_CASE("fluidtex apply: later gives what the run itself would have written, in any resolution",
          "[tools][slow]") {
  const Scratch scratch;
  const fs::path with = scratch.path / "with", after = scratch.path / "after";
  writeImage(scratch.path / "shade.png", 256, 1);
  writeImage(scratch.path / "fine.png", 1024, 3);
  const auto run = [&](const fs::path& out, const std::vector<std::string>& more) {
    std::vector<std::string> args{"run", kSmallScene, "--out", out.string(), "--frames", "1:3", "--no-render"};
    args.insert(args.end(), more.begin(), more.end());
    const Finished done = runProgram(args);
    INFO(done.err);
    REQUIRE(done.exitCode == 0);
  };
  run(with, {"--set", "texture.map=[{ name = 'shade', file = '" + (scratch.path / "shade.png").string() +
                          "' }, { name = 'fine', file = '" + (scratch.path / "fine.png").string() + "' }]"});
  run(after, {});
  const std::string exemplar = FLUIDTEX_SOURCE "/scenes/exemplars/green_scales.png";
  const Finished done =
      runProgram({"apply", after.string(), "shade=" + (scratch.path / "shade.png").string(),
                  "fine=" + (scratch.path / "fine.png").string(), "color=" + exemplar});
  INFO(done.err);
  REQUIRE(done.exitCode == 0);
  for (int frame = 1; frame <= 3; ++frame) {
    const texture::TexturedSurface a = surfaceOf(with, frame), b = surfaceOf(after, frame);
    CHECK(a.positions == b.positions);
    CHECK(a.triangles == b.triangles);
    REQUIRE(a.maps.size() == 4);
    REQUIRE(b.maps.size() == 4);
    for (const char* name : {"shade", "fine_red", "fine_green", "fine_blue"}) {
      const std::vector<float>&here = a.maps.at(name), &there = b.maps.at(name);
      REQUIRE(here.size() == there.size());
      double difference = 0.0, mean = 0.0, most = 0.0;
      for (std::size_t v = 0; v < here.size(); ++v) {
        difference = std::max(difference, double(std::abs(here[v] - there[v])));
        mean += double(here[v]) / double(here.size());
        most = std::max(most, double(here[v]));
      }
      CHECK(difference < 1e-3);
      CHECK(most > mean + 0.1);
    }
    // The colours were looked up in the same image.
    for (std::size_t v = 0; v < a.color.size(); ++v)
      for (int c = 0; c < 3; ++c) CHECK(std::abs(a.color[v][c] - b.color[v][c]) < 0.02f);
  }
}

TEST_CASE("fluidtex apply: what is no map is refused in one sentence", "[tools]") {
  const Scratch scratch;
  const auto refused = [&](const std::string& map, const std::string& why) {
    const Finished done = runProgram({"apply", scratch.path.string(), map});
    CHECK(done.exitCode == 1);
    CHECK_THAT(done.err, Catch::StartsWith("error: ") && Catch::Contains(why));
    CHECK(std::count(done.err.begin(), done.err.end(), '\n') == 1);
  };
  refused("height", "is no map; write NAME=FILE");
  refused("=a.png", "is no map; write NAME=FILE");
  refused("a b=a.png", "a b: cannot be the name of a vertex's property");
  refused("trust=a.png", "trust: is what every vertex has anyway");
  refused("height=a.png", "run.json: cannot be read");
}
