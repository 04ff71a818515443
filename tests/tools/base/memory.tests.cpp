// Where memory runs out, and what is foretold of it.
#include "tests/tools/program.h"

#include <catch2/catch.hpp>

#include <sys/resource.h>
#include <algorithm>

namespace fs = std::filesystem;

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kLimited = false;  // the sanitizers take all addresses for themselves
#else
constexpr bool kLimited = true;
#endif

std::function<void()> within(rlim_t megabytes) {
  return [=] {
    const rlimit limit{megabytes << 20, megabytes << 20};
    setrlimit(RLIMIT_AS, &limit);
  };
}

}  // namespace

TEST_CASE("memory: where it runs out one sentence says at what, and what to lower", "[tools]") {
  if (!kLimited) return;
  const Scratch scratch;
  const Words run{"run",     kSmallScene,   "--frames",
                  "1:2",     "--no-render", "--threads",
                  "2",       "--out",       (scratch.path / "out").string(),
                  "--quiet", "--set"};
  for (const auto& [setting, words] :
       std::vector<std::pair<std::string, std::string>>{{"domain.resolution=400", "lower domain.resolution"},
                                                        {"texture.points=3000000", "lower texture.points"}}) {
    Words args = run;
    args.push_back(setting);
    const Finished ended = runProgramWith(within(900), args);
    INFO(setting << ": " << ended.all());
    CHECK(ended.exitCode == 2);
    CHECK(std::count(ended.err.begin(), ended.err.end(), '\n') == 1);
    CHECK_THAT(ended.err, Catch::StartsWith("error: out of memory") && Catch::Contains(words));
  }
}

TEST_CASE("memory: a thread that cannot be started ends the program with one sentence", "[tools]") {
  if (!kLimited) return;
  const Scratch scratch;
  const Words run{"run",         kSmallScene, "--frames",
                  "1:1",         "--threads", "4",
                  "--no-render", "--out",     (scratch.path / "out").string()};
  const Finished ended = runProgramWith(
      [] {
        setenv("LD_PRELOAD", FLUIDTEX_FAIL_WRITES, 1);
        setenv("FAIL_THREADS", "libtbb", 1);
      },
      run);
  INFO(ended.all());
  CHECK(ended.exitCode == 2);
  CHECK(std::count(ended.err.begin(), ended.err.end(), '\n') == 1);
  CHECK_THAT(ended.err, Catch::StartsWith("error: ") && Catch::Contains("give fewer with --threads"));
  CHECK(runProgram(run).exitCode == 0);
}

TEST_CASE("memory: what a scene needs is foretold with next to none", "[tools]") {
  const Scratch scratch;
  const Finished plan = runProgramWith(kLimited ? within(900) : std::function<void()>(),
                                       {"check", kSmallScene, "--set", "domain.resolution=1024"});
  INFO(plan.all());
  CHECK(plan.exitCode == 0);
  CHECK_THAT(plan.out, Catch::Contains("1024 x 640 x 640 cells") && Catch::Contains("memory    about"));
}
