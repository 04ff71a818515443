// texture.coherence: from fresh on each frame to kept until it breaks.
#include "tests/tools/program.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

namespace fs = std::filesystem;
using Json = nlohmann::json;

TEST_CASE("coherence: the more of it, the less is renewed and the less pops, on a sheet that is stretched",
          "[tools][slow]") {
  const Scratch scratch;
  std::vector<double> renewed, pop;
  for (const char* coherence : {"0", "0.25", "0.5", "0.75", "1"}) {
    const fs::path out = scratch.path / coherence;
    const Finished done =
        runProgram({"run", FLUIDTEX_SOURCE "/scenes/flows/stretch.toml", "--quality", "preview", "--out",
                    out.string(), "--frames", "1:16", "--no-render", "--set", "texture.points=4000", "--set",
                    "motion.rate=1.5", "--set", std::string("texture.coherence=") + coherence});
    INFO(done.err);
    REQUIRE(done.exitCode == 0);
    const fs::path json = scratch.path / "m.json";
    REQUIRE(
        runProgram({"measure", out.string(), "--json", json.string(), "--quiet", "--every", "99"}).exitCode ==
        0);
    const Json report = Json::parse(readBytes(out / "run.json")), mean = Json::parse(readBytes(json))["mean"];
    double sum = 0.0;
    for (std::size_t n = 1; n < 16; ++n) sum += report["frames"][n]["renewed"].get<double>() / 15.0;
    renewed.push_back(sum);
    pop.push_back(mean["pop"].get<double>());
  }
  CAPTURE(renewed, pop);
  CHECK(renewed[0] == Approx(1.0));
  for (std::size_t i = 1; i < renewed.size(); ++i) {
    CHECK(renewed[i] < renewed[i - 1]);
    // At the end only the rim pops, where the sheet is cut off; it does so whatever one asks for.
    if (i < 4) CHECK(pop[i] < pop[i - 1]);
  }
  CHECK(pop[2] < 0.9 * pop[0]);
  CHECK(pop[4] < pop[2]);
  // What is torn, at the rim, is renewed whatever one asks for.
  CHECK(renewed.back() < 0.7 * renewed[2]);
}
