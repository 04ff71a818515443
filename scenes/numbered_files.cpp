#include "scenes/numbered_files.h"

#include "sim/shape.h"

#include <charconv>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

namespace fluidtex::scenes {
namespace fs = std::filesystem;
namespace {

// Numbers of the files that the pattern names.
std::set<int> numbersOf(const sim::MeshSequence& sequence) {
  const std::string pattern = sequence.files.filename().string();
  const std::size_t begin = pattern.find('%'), end = pattern.find('d', begin) + 1;
  const std::string_view before = std::string_view(pattern).substr(0, begin),
                         after = std::string_view(pattern).substr(end);
  std::set<int> numbers;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(
           sequence.files.has_parent_path() ? sequence.files.parent_path() : fs::path("."), unreadable)) {
    const std::string name = entry.path().filename().string();
    if (name.size() <= before.size() + after.size() || !name.starts_with(before) || !name.ends_with(after))
      continue;
    const char *const from = name.data() + before.size(), *const to =
                                                              name.data() + name.size() - after.size();
    int number = 0;
    const auto [at, error] = std::from_chars(from, to, number);
    if (error != std::errc{} || at != to || number < 0) continue;
    // With as many digits as it asks for.
    if (sequence.fileOf(number).filename() == name) numbers.insert(number);
  }
  return numbers;
}

}  // namespace

NumberedFiles numberedFiles(const fs::path& pattern) {
  const sim::MeshSequence sequence{.files = pattern, .first = 0};
  const std::set<int> numbers = numbersOf(sequence);
  NumberedFiles found;
  if (numbers.empty()) return found;
  found.first = *numbers.begin();
  for (int number = found.first; numbers.contains(number); ++number)
    found.files.push_back(sequence.fileOf(number));
  if (found.files.size() < numbers.size())
    found.missing = sequence.fileOf(found.first + int(found.files.size()));
  return found;
}

bool isPattern(const fs::path& fileOrPattern) {
  const std::string name = fileOrPattern.filename().string();
  const std::size_t at = name.find('%');
  if (at == std::string::npos || name.find('d', at) == std::string::npos) return false;
  std::error_code unreadable;
  return !fs::exists(fileOrPattern, unreadable);
}

fs::path firstOf(const fs::path& fileOrPattern) {
  if (!isPattern(fileOrPattern)) return fileOrPattern;
  const NumberedFiles found = numberedFiles(fileOrPattern);
  return found.files.empty() ? fileOrPattern : found.files.front();
}

}  // namespace fluidtex::scenes
