#include "tools/run_folder/state.h"

#include "tests/scratch.h"
#include "tests/tools/formats/sample_surface.h"

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
  texture::TexturedSurface surface = sampleSurface();
  for (int v = 0; v < 4; ++v) surface.vectors["bend"].emplace_back(0.0f, float(v), 1.0f);
  tools::writeSurface(surface, scratch.path / "a");
  const texture::TexturedSurface back = tools::readSurface(scratch.path / "a");
  CHECK(back.positions == surface.positions);
  CHECK(back.color == surface.color);
  CHECK(back.fading.coordinate == surface.fading.coordinate);
  CHECK(back.fading.weight == surface.fading.weight);
  CHECK(back.fading.speed == surface.fading.speed);
  CHECK(back.age == surface.age);
  CHECK(back.maps == surface.maps);
  CHECK(back.vectors == surface.vectors);
  tools::writeSurface(back, scratch.path / "b");
  CHECK(readBytes(scratch.path / "a") == readBytes(scratch.path / "b"));
}

TEST_CASE("state: what fuzzing begins with is a surface of this version", "[tools]") {
  // Else every input is refused by its first bytes. To make it anew: writeSurface(sampleSurface(), ...).
  const texture::TexturedSurface seed =
      tools::readSurface(FLUIDTEX_SOURCE "/tests/fuzz/corpus/state/begin.bin");
  CHECK(seed.coordinate == sampleSurface().coordinate);
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

TEST_CASE("state: a surface that does not fit together, or goes on after its end, is refused", "[tools]") {
  const Scratch scratch;
  const fs::path file = scratch.path / "surface.bin";
  const auto refused = [&](const texture::TexturedSurface& surface) {
    tools::writeSurface(surface, file);
    CHECK_THROWS_WITH(tools::readSurface(file), Catch::Contains(file.string() + ": is damaged"));
  };
  texture::TexturedSurface surface = sampleSurface();
  surface.age.pop_back();
  refused(surface);
  surface = sampleSurface();
  surface.contact.push_back(0);
  refused(surface);
  surface = sampleSurface();
  surface.maps["height"].clear();
  refused(surface);
  surface = sampleSurface();
  surface.vectors["bend"].resize(3);
  refused(surface);
  surface = sampleSurface();
  surface.triangles[3][2] = 4;
  refused(surface);
  tools::writeSurface(sampleSurface(), file);
  std::ofstream(file, std::ios::binary | std::ios::app) << 'x';
  CHECK_THROWS_WITH(tools::readSurface(file), Catch::Contains(file.string() + ": goes on after its end"));
  tools::writeSurface({}, file);
  CHECK(tools::readSurface(file).empty());
}

TEST_CASE("state: a file that is cut, changed or missing is refused by a sentence that names it", "[tools]") {
  const Scratch scratch;
  const fs::path states = scratch.path / "state", folder = states / "0003";
  tools::saveState(sampleSolverState(3), sampleSurface(), "report", states);
  REQUIRE(tools::loadState(states).has_value());
  for (const char* name : {"solver.vdb", "surface.bin", "run.json", "manifest.txt"}) {
    const std::string whole = readBytes(folder / name);
    const auto refused = [&] {
      CHECK_THROWS_WITH(tools::loadState(states),
                        Catch::Contains((folder / name).string() + ": ") &&
                            Catch::EndsWith("; remove the state folder to start anew"));
    };
    // The solver's grids end in bytes that their own reader does not miss.
    for (const std::size_t cut : {1, 3}) {
      if (std::string(name) == "manifest.txt") break;
      std::ofstream(folder / name, std::ios::binary) << whole.substr(0, whole.size() - cut);
      refused();
    }
    std::string changed = whole;
    changed[whole.size() / 2] ^= 1;
    std::ofstream(folder / name, std::ios::binary) << changed;
    if (std::string(name) == "manifest.txt")
      CHECK_THROWS_WITH(tools::loadState(states), Catch::Contains(": is damaged"));
    else
      refused();
    fs::remove(folder / name);
    refused();
    std::ofstream(folder / name, std::ios::binary) << whole;
    REQUIRE(tools::loadState(states).has_value());
  }
}

TEST_CASE("state: the newest whole folder is what is loaded, older ones go", "[tools]") {
  const Scratch scratch;
  CHECK_FALSE(tools::loadState(scratch.path / "state").has_value());
  for (int frame : {9, 10})
    tools::saveState(sampleSolverState(frame), sampleSurface(), "report", scratch.path / "state");
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

TEST_CASE("state: only folders with a frame's name are states, and only they are removed", "[tools]") {
  const Scratch scratch;
  const fs::path states = scratch.path / "state";
  for (const char* name : {"99999999999999999999", "7", "notes"}) {
    fs::create_directories(states / name);
    std::ofstream(states / name / "x") << "mine";
  }
  CHECK_FALSE(tools::loadState(states).has_value());
  tools::saveState(sampleSolverState(7), sampleSurface(), "report", states);
  CHECK(tools::loadState(states)->solver.frame == 7);
  tools::removeStates(states);
  CHECK(filesIn(states) == std::vector<std::string>{"7/x", "99999999999999999999/x", "notes/x"});
  tools::removeStates(states / "not there");
  fs::create_directories(scratch.path / "empty" / "0001");
  tools::removeStates(scratch.path / "empty");
  CHECK_FALSE(fs::exists(scratch.path / "empty"));
}
