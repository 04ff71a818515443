#include "caches/layouts/follow.h"

#include <algorithm>
#include <chrono>
#include <string>
#include <system_error>

namespace fluidtex::caches {
namespace fs = std::filesystem;
namespace {

constexpr std::chrono::seconds kSettled{2};

bool mayStillBeWritten(const NumberedFiles& files, int number) {
  if (files.last() > number) return false;
  if (isEmptyFile(files.at(number))) return true;
  std::error_code gone;
  const fs::file_time_type changed = fs::last_write_time(files.at(number), gone);
  return gone || fs::file_time_type::clock::now() - changed < kSettled;
}

// What the file of this number will be called, with as many digits as the first one.
fs::path expectedFile(const NumberedFiles& files, int number) {
  const std::string pattern = files.pattern.filename().string(), mark = "####";
  const std::size_t place = pattern.rfind(mark);
  if (place == std::string::npos) return files.pattern;
  const std::size_t digits =
      files.byNumber.begin()->second.filename().string().size() - (pattern.size() - mark.size());
  std::string text = std::to_string(number);
  if (text.size() < digits) text.insert(0, digits - text.size(), '0');
  return files.pattern.parent_path() / std::string(pattern).replace(place, mark.size(), text);
}

}  // namespace

std::optional<fs::path> awaitedFile(Layout& layout, int number) {
  std::optional<fs::path> awaited;
  for (NumberedFiles* files : {&layout.surface, &layout.velocity, &layout.config, &layout.blur}) {
    if (files->empty()) continue;
    *files = numberedLike(files->pattern);
    const fs::path file = files->byNumber.contains(number) ? files->at(number) : expectedFile(*files, number);
    if (!awaited && (!files->byNumber.contains(number) || mayStillBeWritten(*files, number))) awaited = file;
  }
  if (!awaited) layout.last = std::max(layout.last, number);
  return awaited;
}

}  // namespace fluidtex::caches
