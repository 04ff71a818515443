// texture.coherence: from fresh on each frame to kept until it breaks.
#include "tests/tools/program.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

// Of a sheet that is stretched, with as much coherence: the share renewed a frame after the first, and how
// much pops.
struct Change {
  double renewed = 0.0, pop = 0.0;
};

Change changeOf(const std::string& coherence) {
  const Scratch scratch;
  const fs::path out = scratch.path / "out", json = scratch.path / "m.json";
  const Finished done =
      runProgram({"run", FLUIDTEX_SOURCE "/scenes/flows/stretch.toml", "--quality", "preview", "--out",
                  out.string(), "--frames", "1:16", "--no-render", "--set", "texture.points=4000", "--set",
                  "motion.rate=1.5", "--set", "texture.coherence=" + coherence});
  INFO(done.err);
  REQUIRE(done.exitCode == 0);
  REQUIRE(
      runProgram({"measure", out.string(), "--json", json.string(), "--quiet", "--every", "99"}).exitCode ==
      0);
  const Json report = Json::parse(readBytes(out / "run.json"));
  Change change;
  for (std::size_t n = 1; n < 16; ++n) change.renewed += report["frames"][n]["renewed"].get<double>() / 15.0;
  change.pop = Json::parse(readBytes(json))["mean"]["pop"].get<double>();
  return change;
}

}  // namespace

TEST_CASE("coherence: the more of it, the less is renewed and the less pops, on a sheet that is stretched",
          "[tools][slow]") {
  const Change none = changeOf("0"), half = changeOf("0.5"), full = changeOf("1");
  CAPTURE(none.renewed, none.pop, half.renewed, half.pop, full.renewed, full.pop);
  CHECK(none.renewed == Approx(1.0));
  CHECK(half.renewed < none.renewed);
  // What is torn, at the rim, is renewed whatever one asks for.
  CHECK(full.renewed < 0.7 * half.renewed);
  CHECK(half.pop < 0.9 * none.pop);
  CHECK(full.pop < half.pop);
}

TEST_CASE("coherence: each quarter more of it renews less and pops less", "[tools][long]") {
  Change before = changeOf("0");
  for (const char* coherence : {"0.25", "0.5", "0.75", "1"}) {
    CAPTURE(coherence);
    const Change now = changeOf(coherence);
    CHECK(now.renewed < before.renewed);
    // At the end only the rim pops, where the sheet is cut off; it does so whatever one asks for.
    if (std::string(coherence) != "1") CHECK(now.pop < before.pop);
    before = now;
  }
}
