#include "render/other_program.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <csignal>
#include <stdexcept>

using fluidtex::render::Outcome;
using fluidtex::render::runOther;

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Outcome runShell(const std::string& script, const fluidtex::render::Meanwhile& meanwhile = {}) {
  return runOther({"sh", "-c", script}, {}, meanwhile);
}

// Says its own number, then waits for long.
constexpr const char* kSlow = "echo $$; echo begun; exec sleep 60";

}  // namespace

TEST_CASE("other program: what it says and how it ends come back", "[render]") {
  const Outcome outcome = runShell("echo one; echo two >&2; exit 3");
  CHECK(outcome.output == "one\n");
  CHECK(outcome.complaints == "two\n");
  CHECK(outcome.exitCode == 3);
  CHECK(runOther({"cat"}, "given").output == "given");
  CHECK(runShell("kill -KILL $$").exitCode == 128 + SIGKILL);
  CHECK_THROWS_AS(runOther({"no such program"}), std::runtime_error);
}

TEST_CASE("other program: lines come one by one, however they are written", "[render]") {
  std::vector<std::string> lines;
  const Outcome outcome = runShell("printf 'a\\nb'; sleep 0.1; printf 'c\\n\\nd\\n'; printf rest",
                                   {[&](const std::string& line) { lines.push_back(line); }, {}});
  CHECK(lines == std::vector<std::string>{"a", "bc", "", "d"});
  CHECK(outcome.output == "rest");
}

TEST_CASE("other program: it is killed once it is to stop", "[render]") {
  const auto start = Clock::now();
  bool begun = false;
  const Outcome outcome = runShell(
      kSlow, {[&](const std::string& line) { begun = begun || line == "begun"; }, [&] { return begun; }});
  CHECK(outcome.exitCode == 128 + SIGKILL);
  CHECK(secondsSince(start) < 20.0);
}

TEST_CASE("other program: it does not outlive what goes wrong with a line", "[render]") {
  const auto start = Clock::now();
  pid_t number = 0;
  const auto hear = [&](const std::string& line) {
    if (line == "begun") throw std::logic_error("wrong");
    number = std::stoi(line);
  };
  CHECK_THROWS_AS(runShell(kSlow, {hear, {}}), std::logic_error);
  CHECK(secondsSince(start) < 20.0);
  REQUIRE(number > 0);
  CHECK(kill(number, 0) != 0);
}
