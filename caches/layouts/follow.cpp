#include "caches/layouts/follow.h"

#include <algorithm>
#include <chrono>
#include <system_error>

namespace fluidtex::caches {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::seconds kSettled{2};

bool mayStillBeWritten(const NumberedFiles& files, int number) {
  if (files.last() > number) return false;
  std::error_code gone;
  const fs::file_time_type changed = fs::last_write_time(files.at(number), gone);
  return gone || fs::file_time_type::clock::now() - changed < kSettled;
}

}  // namespace

std::optional<fs::path> awaitedFile(Layout& layout, int number) {
  std::optional<fs::path> awaited;
  for (NumberedFiles* files : {&layout.surface, &layout.velocity, &layout.config, &layout.blur}) {
    if (files->empty()) continue;
    *files = numberedLike(files->pattern);
    const fs::path file = files->byNumber.contains(number) ? files->at(number) : files->pattern;
    if (!awaited && (!files->byNumber.contains(number) || mayStillBeWritten(*files, number))) awaited = file;
  }
  if (!awaited) layout.last = std::max(layout.last, number);
  return awaited;
}

}  // namespace fluidtex::caches
