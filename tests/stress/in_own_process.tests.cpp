#include "tools/stress_scenes/in_own_process.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <csignal>
#include <fstream>

#include <pthread.h>
#include <unistd.h>

using namespace fluidtex;

namespace {

// What becomes of each process that is started: nothing else, or its end.
void (*s_inChild)() = nullptr;

// Runs on in a new process in such a way; none of these scenes is one that a solver would get.
std::vector<stress::Failure> checkedWhere(void (*inChild)(), const std::string& scene, double seconds) {
  static const int registered = pthread_atfork(nullptr, nullptr, [] {
    if (s_inChild != nullptr) s_inChild();
  });
  REQUIRE(registered == 0);
  const Scratch scratch;
  const auto file = scratch.path / "scene.toml";
  std::ofstream(file) << scene;
  s_inChild = inChild;
  const std::vector<stress::Failure> failures = stress::checkInOwnProcess(file, scratch.path, seconds);
  s_inChild = nullptr;
  return failures;
}

}  // namespace

TEST_CASE("in own process: what fails there is told here, each failure in one line", "[stress]") {
  const Scratch scratch;
  const auto file = scratch.path / "scene.toml";
  std::ofstream(file) << "frames = 0\nsead = 1\n";
  const std::vector<stress::Failure> here = stress::checkScene(file, scratch.path),
                                     there = stress::checkInOwnProcess(file, scratch.path, 60.0);
  REQUIRE(here.size() == 1);
  REQUIRE(there.size() == 1);
  CHECK(there[0].invariant == "loader");
  CHECK(there[0].frame == here[0].frame);
  std::string line = here[0].what;
  REQUIRE(std::count(line.begin(), line.end(), '\n') > 1);
  std::replace(line.begin(), line.end(), '\n', ' ');
  CHECK(there[0].what == line);
}

TEST_CASE("in own process: one that crashes is a failure like another", "[stress]") {
  const auto killed = checkedWhere([] { raise(SIGKILL); }, "frames = 0\n", 60.0);
  REQUIRE(killed.size() == 1);
  CHECK(killed[0].invariant == "crash");
  CHECK(killed[0].frame == 0);
  CHECK_THAT(killed[0].what, Catch::StartsWith("ended by signal 9 ("));
  const auto ended = checkedWhere([] { _exit(3); }, "frames = 0\n", 60.0);
  REQUIRE(ended.size() == 1);
  CHECK(ended[0].invariant == "crash");
  CHECK(ended[0].what == "ended with status 3");
}

TEST_CASE("in own process: one that does not end is ended, and failed", "[stress]") {
  const auto late = checkedWhere(
      [] {
        for (;;) pause();
      },
      "frames = 0\n", 0.2);
  REQUIRE(late.size() == 1);
  CHECK(late[0].invariant == "time");
  CHECK(late[0].what == "not done after 0 s");
}
