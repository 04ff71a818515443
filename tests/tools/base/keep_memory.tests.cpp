#include "tools/base/keep_memory.h"

#include <catch2/catch.hpp>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

namespace {

// Bytes that a process has given back once it has freed a block of 64 MB: one of its own, since nothing else
// here is to keep memory. -1 where this malloc does not count.
long givenBack(bool keep) {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  if (child == 0) {
    if (keep) fluidtex::tools::keepMemory();
    constexpr std::size_t kBytes = std::size_t{64} << 20;
    const auto held = [] {
      const struct mallinfo2 info = mallinfo2();
      return long(info.arena + info.hblkhd);
    };
    auto* const block = static_cast<volatile char*>(std::malloc(kBytes));
    for (std::size_t n = 0; n < kBytes; n += 4096) block[n] = 1;
    const long full = held();
    std::free(const_cast<char*>(block));
    const long change = full > 0 ? full - held() : -1;
    _exit(write(ends[1], &change, sizeof change) == long(sizeof change) ? 0 : 1);
  }
  long change = 0;
  CHECK(read(ends[0], &change, sizeof change) == long(sizeof change));
  close(ends[0]);
  close(ends[1]);
  int status = 0;
  waitpid(child, &status, 0);
  return change;
}

}  // namespace

TEST_CASE("keep memory: what is freed stays the process's own", "[tools]") {
  const long usual = givenBack(false);
  if (usual < 0) return;  // the sanitizers have a malloc of their own
  CHECK(usual >= 64L << 20);
  CHECK(givenBack(true) == 0);
}
