#include "caches/layouts/numbered_files.h"

#include <algorithm>
#include <cctype>
#include <system_error>

namespace fluidtex::caches {
namespace fs = std::filesystem;
namespace {

// More digits are no number of a frame.
constexpr std::size_t kMostDigits = 9;

bool isDigit(char c) {
  return c >= '0' && c <= '9';
}

// Where the ending begins: at the last dot, or at that before two endings of which the second is .gz or .sc.
// "0012.gz" has one.
std::size_t endingOf(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  if (dot == std::string::npos || dot == 0) return name.size();
  const std::string last = name.substr(dot);
  if (last != ".gz" && last != ".sc") return dot;
  const std::size_t before = name.rfind('.', dot - 1);
  if (before == std::string::npos || before == 0) return dot;
  const bool isNumber =
      std::all_of(name.begin() + std::ptrdiff_t(before) + 1, name.begin() + std::ptrdiff_t(dot), isDigit);
  return isNumber ? dot : before;
}

// The place for a number in a pattern: where it begins, and how long it is; 0 where there is none.
std::pair<std::size_t, std::size_t> placeIn(const std::string& name) {
  if (const std::size_t end = name.rfind('#'); end != std::string::npos) {
    std::size_t begin = end;
    while (begin > 0 && name[begin - 1] == '#') --begin;
    return {begin, end - begin + 1};
  }
  for (std::size_t begin = name.rfind('%'); begin != std::string::npos;
       begin = begin == 0 ? std::string::npos : name.rfind('%', begin - 1)) {
    std::size_t end = begin + 1;
    while (end < name.size() && isDigit(name[end])) ++end;
    if (end < name.size() && name[end] == 'd') return {begin, end - begin + 1};
  }
  return {0, 0};
}

std::string patternOf(const NumberedName& name) {
  return name.before + "####" + name.after;
}

std::vector<std::string> namesIn(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (fs::directory_iterator entry(folder.empty() ? "." : folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code unknown;
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(".") && entry->is_regular_file(unknown)) names.push_back(name);
  }
  if (error)
    throw LayoutError(folder.string() + ": cannot be listed (" + error.message() +
                      "); give a folder that can be read");
  std::sort(names.begin(), names.end());
  return names;
}

void add(const fs::path& folder, const std::string& name, int number, NumberedFiles& files) {
  const auto [place, isNew] = files.byNumber.emplace(number, folder / name);
  if (!isNew)
    throw LayoutError(place->second.string() + " and " + (folder / name).string() + ": are both number " +
                      std::to_string(number) + "; leave one of them");
}

NumberedFiles filesBetween(const fs::path& folder, const std::string& before, const std::string& after) {
  NumberedFiles files;
  files.pattern = folder / (before + "####" + after);
  for (const std::string& name : namesIn(folder)) {
    if (name.size() <= before.size() + after.size() || !name.starts_with(before) || !name.ends_with(after))
      continue;
    const std::string digits = name.substr(before.size(), name.size() - before.size() - after.size());
    if (digits.size() <= kMostDigits && std::all_of(digits.begin(), digits.end(), isDigit))
      add(folder, name, std::stoi(digits), files);
  }
  return files;
}

}  // namespace

bool isEmptyFile(const fs::path& file) {
  std::error_code unknown;
  return fs::file_size(file, unknown) == 0 && !unknown;
}

const fs::path& NumberedFiles::at(int number) const {
  if (const auto found = byNumber.find(number); found != byNumber.end()) return found->second;
  const auto after = byNumber.upper_bound(number);
  std::string there;
  if (after != byNumber.begin()) there = std::to_string(std::prev(after)->first) + " is there";
  if (after != byNumber.end())
    there += (there.empty() ? "" : ", and then ") + std::to_string(after->first) +
             (there.empty() ? " is the first" : "");
  throw LayoutError(pattern.string() + ": number " + std::to_string(number) + " is missing" +
                    (there.empty() ? "" : " (" + there + ")") +
                    "; write it again, or choose frames that are all there");
}

bool splitName(const std::string& name, NumberedName& split) {
  std::size_t end = endingOf(name);
  while (end > 0 && !isDigit(name[end - 1])) --end;
  std::size_t begin = end;
  while (begin > 0 && isDigit(name[begin - 1])) --begin;
  if (begin == end || end - begin > kMostDigits) return false;
  split = {name.substr(0, begin), name.substr(end), std::stoi(name.substr(begin, end - begin))};
  return true;
}

bool isPattern(const fs::path& path) {
  return placeIn(path.filename().string()).second > 0;
}

NumberedFiles numberedLike(const fs::path& patternOrFile) {
  const fs::path folder = patternOrFile.parent_path();
  const std::string name = patternOrFile.filename().string();
  std::error_code unknown;
  const bool isFile = fs::is_regular_file(patternOrFile, unknown);
  if (const auto [begin, length] = placeIn(name); length > 0 && !isFile) {
    NumberedFiles files = filesBetween(folder, name.substr(0, begin), name.substr(begin + length));
    if (files.empty())
      throw LayoutError(patternOrFile.string() +
                        ": there is no file of this pattern; #### stands for the number");
    return files;
  }
  if (!isFile)
    throw LayoutError(patternOrFile.string() +
                      ": there is no such file; give a folder, a file of the sequence, or a pattern such as "
                      "water_####.vdb");
  NumberedName split;
  if (!splitName(name, split)) return {patternOrFile, {{1, patternOrFile}}};
  return filesBetween(folder, split.before, split.after);
}

std::vector<NumberedFiles> sequencesIn(const fs::path& folder, IsWanted isWanted) {
  std::map<std::string, NumberedFiles> sequences;
  for (const std::string& name : namesIn(folder)) {
    NumberedName split;
    if ((isWanted && !isWanted(name)) || !splitName(name, split)) continue;
    NumberedFiles& files = sequences[patternOf(split)];
    files.pattern = folder / patternOf(split);
    add(folder, name, split.number, files);
  }
  std::vector<NumberedFiles> result;
  result.reserve(sequences.size());
  for (auto& [pattern, files] : sequences) result.push_back(std::move(files));
  return result;
}

}  // namespace fluidtex::caches
