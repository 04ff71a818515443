#include "tools/base/stop_signal.h"

#include "tests/scratch.h"
#include "tools/base/errors.h"

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

using namespace fluidtex::tools;

namespace {

struct Ended {
  int exitCode = -1;
  double seconds = 0.0;
  std::string err;
};

// A program that gets a signal; `looks`: it looks at the flag now and then, and is done a little later.
Ended endedBy(int number, bool looks) {
  const Scratch scratch;
  const pid_t child = fork();
  if (child == 0) {
    dup2(open((scratch.path / "err").c_str(), O_WRONLY | O_CREAT, 0644), STDERR_FILENO);
    const std::atomic<bool>& stop = stopOnSignals();
    raise(number);
    const auto start = std::chrono::steady_clock::now();
    while (std::chrono::steady_clock::now() - start < std::chrono::seconds(20))
      if (looks && stop) _exit(7);
    _exit(1);
  }
  const auto start = std::chrono::steady_clock::now();
  int status = 0;
  waitpid(child, &status, 0);
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, seconds.count(), readBytes(scratch.path / "err")};
}

}  // namespace

TEST_CASE("stop signals: work that looks stops by itself, all other is ended", "[tools]") {
  for (const int number : {SIGINT, SIGTERM}) {
    CHECK(endedBy(number, true).exitCode == 7);
    const Ended ended = endedBy(number, false);
    CHECK(ended.exitCode == kInterrupted);
    CHECK(ended.seconds > 0.3);
    CHECK(ended.seconds < 5.0);
    CHECK(ended.err == std::string(Interrupted().what()) + "\n");
  }
}
