// fluidtex apply: further maps on a finished run.
#include "tests/tools/program.h"
#include "tools/base/errors.h"
#include "tools/formats/ply.h"
#include "tools/formats/read_ply.h"

#include <OpenImageIO/imageio.h>
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

namespace fs = std::filesystem;
using namespace fluidtex;

namespace {

// Bright in the middle, dark at the edges, where a toroidal exemplar leads over: `channels` of 8 bits each,
// the later ones darker unless it is grey.
void writeImage(const fs::path& file, int size, int channels, bool grey = false) {
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x)
      for (int c = 0; c < channels; ++c)
        pixels.push_back(std::uint8_t(std::lround(255.0 * std::sin(M_PI * (x + 0.5) / size) *
                                                  std::sin(M_PI * (y + 0.5) / size) / (grey ? 1 : c + 1))));
  const auto out = OIIO::ImageOutput::create(file.string());
  REQUIRE(out);
  REQUIRE(out->open(file.string(), OIIO::ImageSpec(size, size, channels, OIIO::TypeDesc::UINT8)));
  REQUIRE(out->write_image(OIIO::TypeDesc::UINT8, pixels.data()));
  out->close();
}

texture::TexturedSurface surfaceOf(const fs::path& out, int frame) {
  return tools::readPly(out / "surface" / ("000" + std::to_string(frame) + ".ply"), 256, 256);
}

void well(const std::vector<std::string>& args) {
  const Finished done = runProgram(args);
  INFO(done.err);
  REQUIRE(done.exitCode == 0);
}

std::vector<std::uint8_t> pixels(const fs::path& out, int frame) {
  const auto in =
      OIIO::ImageInput::open((out / "frames" / ("000" + std::to_string(frame) + ".png")).string());
  REQUIRE(in);
  std::vector<std::uint8_t> values(std::size_t(in->spec().width) * std::size_t(in->spec().height) * 3);
  REQUIRE(in->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, values.data()));
  return values;
}

texture::Vec3f bumpAt(const texture::TexturedSurface& surface, std::size_t v) {
  const texture::Vec3f bump(surface.maps.at("bump_x")[v], surface.maps.at("bump_y")[v],
                            surface.maps.at("bump_z")[v]);
  REQUIRE(bump.length() == Approx(1.0f));
  return bump;
}

}  // namespace

TEST_CASE("fluidtex apply: later gives what the run itself would have written, in any resolution",
          "[tools][slow]") {
  const Scratch scratch;
  const fs::path with = scratch.path / "with", after = scratch.path / "after";
  writeImage(scratch.path / "shade.png", 256, 1);
  writeImage(scratch.path / "fine.png", 1024, 3);
  const auto run = [&](const fs::path& out, const std::vector<std::string>& more) {
    well(plus({"run", kSmallScene, "--out", out.string(), "--frames", "1:3", "--no-render"}, more));
  };
  run(with, {"--set", "texture.map=[{ name = 'shade', file = '" + (scratch.path / "shade.png").string() +
                          "' }, { name = 'fine', file = '" + (scratch.path / "fine.png").string() +
                          "' }, { name = 'bump', holds = 'normals', file = '" +
                          (scratch.path / "fine.png").string() + "' }]"});
  run(after, {});
  const std::string exemplar = FLUIDTEX_SOURCE "/scenes/exemplars/green_scales.png";
  well({"apply", after.string(), "shade=" + (scratch.path / "shade.png").string(),
        "fine=" + (scratch.path / "fine.png").string(), "color=" + exemplar,
        "bump:normals=" + (scratch.path / "fine.png").string()});
  for (int frame = 1; frame <= 3; ++frame) {
    const texture::TexturedSurface a = surfaceOf(with, frame), b = surfaceOf(after, frame);
    CHECK(a.positions == b.positions);
    CHECK(a.triangles == b.triangles);
    REQUIRE(a.maps.size() == 7);
    REQUIRE(b.maps.size() == 7);
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
    // Vectors need the gradient, which apply finds from the coordinates again.
    double agreement = 0.0;
    for (std::size_t v = 0; v < a.positions.size(); ++v)
      agreement += double(bumpAt(a, v).dot(bumpAt(b, v))) / double(a.positions.size());
    CHECK(agreement > 0.95);
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
  const Finished twice = runProgram({"apply", scratch.path.string(), "bump:normals=a.png", "bump_x=a.png"});
  CHECK(twice.exitCode == 1);
  CHECK_THAT(twice.err, Catch::Contains("bump_x: is the name of an earlier map too"));
  refused("bump:bumps=a.png", "a map of bumps is not known");
  refused("height=a.png", "run.json: cannot be read");
}

TEST_CASE("fluidtex check: relief is refused of a coloured map, not of a grey one, however it is stored",
          "[tools]") {
  const Scratch scratch;
  const std::string file = (scratch.path / "height.png").string();
  const auto check = [&] {
    return runProgram({"check", kSmallScene, "--set",
                       "texture.map=[{ name = 'height', file = '" + file + "' }]", "--set",
                       "render.bump={ map = 'height' }"});
  };
  writeImage(file, 64, 3);
  const Finished colored = check();
  CHECK(colored.exitCode == 1);
  CHECK_THAT(colored.err, Catch::Contains("render.bump.map: height has 3 channels"));
  writeImage(file, 64, 3, true);
  CHECK(check().exitCode == 0);
  writeImage(file, 64, 1);
  CHECK(check().exitCode == 0);
}

TEST_CASE("fluidtex render: the exemplar is looked up in files as in the run, across joints too",
          "[tools][slow]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out", again = scratch.path / "again";
  const std::string looksUp = "texture.between=exemplar";
  well({"run", kSmallScene, "--out", out.string(), "--frames", "1:4", "--set", looksUp});
  well({"render", kSmallScene, "--from", out.string(), "--out", again.string(), "--frames", "4:4", "--set",
        looksUp});
  const std::vector<std::uint8_t> wanted = pixels(out, 4), found = pixels(again, 4);
  REQUIRE(wanted.size() == found.size());
  int largest = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    largest = std::max(largest, std::abs(int(wanted[i]) - int(found[i])));
  CHECK(largest <= 1);  // coordinates and gradients went through shares of the exemplar's size
}

TEST_CASE("fluidtex render: shows what the run has shown, and other colours once they are applied",
          "[tools][slow]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "out", again = scratch.path / "again";
  const auto difference = [](const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b) {
    REQUIRE(a.size() == b.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(int(a[i]) - int(b[i])) / double(a.size());
    return sum;
  };
  well({"run", kSmallScene, "--out", out.string(), "--frames", "1:2"});
  well({"render", kSmallScene, "--from", out.string(), "--out", again.string(), "--frames", "1:2"});
  CHECK(fs::exists(again / "small.mp4"));
  const std::vector<std::uint8_t> before = pixels(out, 2), same = pixels(again, 2);
  CHECK(difference(before, same) < 0.5);  // colours went through eight bits
  writeImage(scratch.path / "grey.png", 64, 1);
  well({"apply", out.string(), "color=" + (scratch.path / "grey.png").string()});
  well({"render", kSmallScene, "--from", out.string(), "--out", again.string(), "--frames", "1:2"});
  CHECK(difference(before, pixels(again, 2)) > 2.0);

  // Relief, once its map is there.
  const std::string height = (scratch.path / "height.png").string();
  writeImage(height, 64, 1);
  const std::vector<std::string> bumped = {
      "render",   kSmallScene,
      "--from",   out.string(),
      "--out",    again.string(),
      "--frames", "1:2",
      "--set",    "texture.map=[{ name = 'height', file = '" + height + "' }]",
      "--set",    "render.bump={ map = 'height', height = 20 }"};
  const Finished without = runProgram(bumped);
  CHECK(without.exitCode == 1);
  CHECK_THAT(without.err, Catch::Contains("0001.ply: has no height") && Catch::Contains("fluidtex apply"));
  const std::vector<std::uint8_t> smooth = pixels(again, 2);
  well({"apply", out.string(), "height=" + height});
  fs::rename(out / "run.json", out / "gone.json");  // relief needs no report
  well(bumped);
  CHECK(difference(smooth, pixels(again, 2)) > 0.1);

  const Finished missing =
      runProgram({"render", kSmallScene, "--from", out.string(), "--out", again.string(), "--frames", "1:3"});
  CHECK(missing.exitCode == 1);
  CHECK_THAT(missing.err, Catch::Contains("0003.ply: is not there"));
}
