// Pictures of a run that were drawn by other processes than textured it, several at once.
#include "tests/tools/program.h"

#include <catch2/catch.hpp>

#include <fstream>

namespace fs = std::filesystem;

namespace {

void well(const Finished& done) {
  INFO(done.all());
  REQUIRE(done.exitCode == 0);
}

}  // namespace

TEST_CASE("fluidtex render --part: the run's own bytes, from several processes in one folder", "[tools]") {
  const Scratch scratch;
  const std::string whole = (scratch.path / "whole").string(), out = (scratch.path / "out").string();
  // Each way to a vertex's colour, and what is looked up between the vertices.
  const std::string between =
      GENERATE(as<std::string>(), "texture.between=points", "texture.between=exemplar");
  const std::vector<std::string> scene{kSmallScene, "--set", "frames=3", "--set", between};
  const auto with = [&](std::vector<std::string> args, const std::vector<std::string>& more) {
    args.insert(args.begin() + 1, scene.begin(), scene.end());
    return plus(std::move(args), more);
  };
  well(runProgram(with({"run"}, {"--out", whole})));
  well(runProgram(with({"run"}, {"--no-render", "--out", out})));
  const std::vector<std::string> render = with({"render"}, {"--from", out, "--out", out});
  const auto part = [&](const std::string& frames) {
    std::vector<std::string> args = render;
    args.insert(args.end(), {"--part", "--frames", frames});
    return args;
  };
  const RunningProgram first(part("1:2")), second(part("3"));
  well(first.wait());
  well(second.wait());
  CHECK_FALSE(fs::exists(fs::path(out) / "small.mp4"));
  CHECK_FALSE(fs::exists(fs::path(out) / ".fluidtex-lock"));
  CHECK(resultsIn(out) == resultsIn(whole));

  // What is there is not drawn again; what is missing is, and the video made of all.
  const fs::path mine = fs::path(out) / "frames" / "0001.png";
  const auto before = fs::last_write_time(mine);
  fs::remove(fs::path(out) / "frames" / "0002.png");
  std::vector<std::string> missing = render;
  missing.push_back("--missing");
  well(runProgram(missing));
  CHECK(fs::last_write_time(mine) == before);
  CHECK(resultsIn(out) == resultsIn(whole));
  CHECK(readBytes(fs::path(out) / "small.mp4") == readBytes(fs::path(whole) / "small.mp4"));
}

TEST_CASE("fluidtex video: the run's own video of the run's pictures", "[tools]") {
  const Scratch scratch;
  const fs::path out = scratch.path / "o & ü";
  well(runProgram({"run", kSmallScene, "--frames", "1:3", "--quiet", "--out", out.string()}));
  for (const char* end : {"", "."}) {
    const Finished done = runProgram({"video", (out / "frames" / end).string()});
    well(done);
    CHECK(done.out == (out / "frames.mp4").string() + "\n");
  }
  CHECK(readBytes(out / "frames.mp4") == readBytes(out / "small.mp4"));
  const fs::path slow = scratch.path / "slow.mp4";
  well(runProgram({"video", (out / "frames").string(), "--rate", "5", "--out", slow.string()}));
  CHECK(readBytes(slow) != readBytes(out / "small.mp4"));

  const auto refused = [&](const fs::path& pictures, const std::string& sentence) {
    const Finished wrong = runProgram({"video", pictures.string()});
    CHECK(wrong.exitCode == 1);
    CHECK_THAT(wrong.err, Catch::Contains(sentence));
  };
  refused(out / "surface", "holds no pictures");
  fs::copy(out / "frames", scratch.path / "alone");
  refused(scratch.path / "alone", "give --rate N");
  fs::remove(scratch.path / "alone" / "0002.png");
  refused(scratch.path / "alone", "0002.png: is missing between 0001.png and 0003.png");
}
