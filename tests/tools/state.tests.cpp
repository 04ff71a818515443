#include "tools/state.h"

#include "tests/tools/sample_surface.h"
#include "tests/tools/scratch.h"

#include <catch2/catch.hpp>

#include <fstream>

using namespace fluidtex;
namespace fs = std::filesystem;

namespace {

sim::State sampleSolverState(int frame) {
  openvdb::initialize();
  sim::Options options;
  options.resolution = 16;
  options.liquid.push_back({{sim::Box{{0.2, 0.2, 0.2}, {0.6, 0.6, 0.6}}}});
  sim::Solver solver(options);
  solver.next();
  sim::State state = solver.state();
  state.frame = frame;
  return state;
}

}  // namespace

TEST_CASE("state: a surface comes back bit for bit", "[tools]") {
  const Scratch scratch;
  const texture::TexturedSurface surface = sampleSurface();
  tools::writeSurface(surface, scratch.path / "a");
  const texture::TexturedSurface back = tools::readSurface(scratch.path / "a");
  CHECK(back.positions == surface.positions);
  CHECK(back.color == surface.color);
  CHECK(back.age == surface.age);
  CHECK(back.maps == surface.maps);
  tools::writeSurface(back, scratch.path / "b");
  CHECK(readBytes(scratch.path / "a") == readBytes(scratch.path / "b"));
}

TEST_CASE("state: every shorter file is refused by a sentence that names it", "[tools]") {
  const Scratch scratch;
  tools::writeSurface(sampleSurface(), scratch.path / "whole");
  const std::string whole = readBytes(scratch.path / "whole");
  const fs::path file = scratch.path / "short";
  for (std::size_t size = 0; size < whole.size(); ++size) {
    std::ofstream(file, std::ios::binary) << whole.substr(0, size);
    CHECK_THROWS_WITH(tools::readSurface(file), Catch::Contains(file.string()));
  }
}

TEST_CASE("state: the newest whole folder is what is loaded, older ones go", "[tools]") {
  const Scratch scratch;
  CHECK_FALSE(tools::loadState(scratch.path / "state").has_value());
  for (int frame : {9, 10})
    tools::saveState({sampleSolverState(frame), sampleSurface(), "report"}, scratch.path / "state");
  CHECK_FALSE(fs::exists(scratch.path / "state" / "0009"));
  // A state that was being written, or removed, when the program died.
  fs::create_directories(scratch.path / "state" / ".tmp-0011");
  fs::create_directories(scratch.path / "state" / "0008");
  const auto state = tools::loadState(scratch.path / "state");
  REQUIRE(state.has_value());
  CHECK(state->solver.frame == 10);
  CHECK(state->report == "report");
  CHECK(state->surface.coordinate == sampleSurface().coordinate);
}
