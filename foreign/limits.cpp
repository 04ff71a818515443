#include "foreign/limits.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <fstream>
#include <system_error>

// Sanitizers take up terabytes of addresses, which are no memory.
#ifndef __has_feature
#define __has_feature(feature) 0  // clang's way to tell
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || __has_feature(address_sanitizer)
#define FLUIDTEX_LIMITS_MEMORY false
#else
#define FLUIDTEX_LIMITS_MEMORY true
#endif

namespace fluidtex::foreign {
namespace {

void limit(__rlimit_resource what, rlim_t most, rlim_t hardest) {
  const rlimit value{most, hardest};
  setrlimit(what, &value);
}

rlim_t addressesNow() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * rlim_t(sysconf(_SC_PAGESIZE));
}

// Not for good, since the next file may take more.
void limitMemory(rlim_t addresses) {
  rlimit now{};
  if (getrlimit(RLIMIT_AS, &now) == 0) limit(RLIMIT_AS, std::min(addresses, now.rlim_max), now.rlim_max);
}

constexpr rlim_t kLongest = 1200;  // s, beyond which nothing can be asked for

void limitSeconds(rlim_t seconds) {
  limit(RLIMIT_CPU, std::min(seconds, kLongest), kLongest);
  alarm(unsigned(3 * std::min(seconds, kLongest)));
}

}  // namespace

void limitThisProcess(const std::filesystem::path& file, std::uint64_t memory) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  std::error_code unknown;
  const std::uintmax_t bytes = std::filesystem::file_size(file, unknown);
  limitSeconds(rlim_t(std::clock() / CLOCKS_PER_SEC) + 6 + (unknown ? 0 : rlim_t(bytes >> 20)));
  limit(RLIMIT_CORE, 0, 0);
  limit(RLIMIT_FSIZE, 0, 0);
  if (FLUIDTEX_LIMITS_MEMORY) limitMemory(addressesNow() + memory);
}

void allowTimeFor(std::int64_t pixels) {
  rlimit now{};
  if (getrlimit(RLIMIT_CPU, &now) == 0 && now.rlim_cur != RLIM_INFINITY)
    limitSeconds(now.rlim_cur + rlim_t(pixels / 5'000'000));
}

}  // namespace fluidtex::foreign
