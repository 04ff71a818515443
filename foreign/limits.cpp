#include "foreign/limits.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
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

constexpr rlim_t kMostMemory = 1536ull << 20;

void limit(__rlimit_resource what, rlim_t most, rlim_t hardest) {
  const rlimit value{most, hardest};
  setrlimit(what, &value);
}

rlim_t addressesNow() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * rlim_t(sysconf(_SC_PAGESIZE));
}

}  // namespace

int secondsFor(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::uintmax_t bytes = std::filesystem::file_size(file, ignored);
  return 6 + int(ignored ? 0 : std::min<std::uintmax_t>(bytes >> 20, 600));
}

void limitThisProcess(int seconds) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  limit(RLIMIT_CPU, rlim_t(seconds), rlim_t(seconds) + 1);
  alarm(unsigned(3 * seconds));
  limit(RLIMIT_CORE, 0, 0);
  limit(RLIMIT_FSIZE, 0, 0);
  const rlim_t memory = addressesNow() + kMostMemory;
  if (FLUIDTEX_LIMITS_MEMORY) limit(RLIMIT_AS, memory, memory);
}

}  // namespace fluidtex::foreign
