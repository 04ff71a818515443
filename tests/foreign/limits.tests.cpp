#include "foreign/limits.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <ctime>
#include <functional>

using namespace fluidtex::foreign;

namespace {

// What holds in a process that gives itself limits: the number of the first that does not, 0 where all do.
int firstWrong(const std::function<int()>& inProcess) {
  const pid_t child = fork();
  if (child == 0) _exit(inProcess());
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFEXITED(status));
  return WEXITSTATUS(status);
}

rlim_t limitOf(__rlimit_resource what) {
  rlimit now{};
  getrlimit(what, &now);
  return now.rlim_cur;
}

// Whether so many bytes of memory can be had.
[[maybe_unused]] bool canTake(std::size_t bytes) {
  void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return false;
  munmap(memory, bytes);
  return true;
}

std::filesystem::path fileOf(const Scratch& scratch, std::uintmax_t bytes) {
  const std::filesystem::path file = scratch.path / "a.png";
  std::ofstream(file).close();
  std::filesystem::resize_file(file, bytes);
  return file;
}

}  // namespace

TEST_CASE("limits: time by the size of the file, three times as much by the clock", "[foreign]") {
  const Scratch scratch;
  const auto file = fileOf(scratch, (3 << 20) + 1000);
  CHECK(firstWrong([&] {
          limitThisProcess(file, kMostMemory);
          // Seconds that this process has already had are its own.
          const rlim_t seconds = rlim_t(std::clock() / CLOCKS_PER_SEC) + 6 + 3;
          if (limitOf(RLIMIT_CPU) != seconds) return 1;
          const rlim_t left = alarm(0);
          return left == 3 * seconds || left == 3 * seconds - 1 ? 0 : 2;
        }) == 0);
  CHECK(firstWrong([] {
          limitThisProcess("/nowhere/a.png", kMostMemory);
          return limitOf(RLIMIT_CPU) == rlim_t(std::clock() / CLOCKS_PER_SEC) + 6 ? 0 : 1;
        }) == 0);
}

TEST_CASE("limits: nothing is written, no core is left, and the end of the parent is its own", "[foreign]") {
  const Scratch scratch;
  const auto file = fileOf(scratch, 10);
  CHECK(firstWrong([&] {
          limitThisProcess(file, kMostMemory);
          if (limitOf(RLIMIT_CORE) != 0) return 1;
          std::signal(SIGXFSZ, SIG_IGN);
          std::ofstream out(scratch.path / "b.png");
          out << "a byte" << std::flush;
          if (out.good()) return 2;
          int atEnd = 0;
          prctl(PR_GET_PDEATHSIG, &atEnd);
          return atEnd == SIGKILL ? 0 : 3;
        }) == 0);
  CHECK(std::filesystem::file_size(scratch.path / "b.png") == 0);
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_CASE("limits: so much more memory than it has, and no more", "[foreign]") {
  const Scratch scratch;
  const auto file = fileOf(scratch, 10);
  constexpr std::size_t kMegabyte = 1 << 20;
  CHECK(firstWrong([&] {
          limitThisProcess(file, 64 * kMegabyte);
          if (canTake(65 * kMegabyte)) return 1;
          if (!canTake(48 * kMegabyte)) return 2;
          // The next file may need more.
          limitThisProcess(file, 256 * kMegabyte);
          return canTake(200 * kMegabyte) ? 0 : 3;
        }) == 0);
}
#endif

TEST_CASE("limits: a second more for each five million pixels, where time is limited", "[foreign]") {
  CHECK(firstWrong([] {
          allowTimeFor(50'000'000);
          if (limitOf(RLIMIT_CPU) != RLIM_INFINITY) return 1;
          limitThisProcess("/nowhere/a.png", kMostMemory);
          const rlim_t before = limitOf(RLIMIT_CPU);
          allowTimeFor(4'999'999);
          if (limitOf(RLIMIT_CPU) != before) return 2;
          allowTimeFor(50'000'000);
          return limitOf(RLIMIT_CPU) == before + 10 ? 0 : 3;
        }) == 0);
}
