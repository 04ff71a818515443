// Files of a sequence: one a frame, told apart by the number in their name.
#pragma once

#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace fluidtex::caches {

// Thrown where files are missing or do not fit together: one sentence, what is wrong and what would be right.
struct LayoutError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Whether it is there and holds no byte: programs leave such files for frames without liquid.
bool isEmptyFile(const std::filesystem::path& file);

struct NumberedFiles {
  std::filesystem::path pattern;  // the number as ####, for messages
  std::map<int, std::filesystem::path> byNumber;

  bool empty() const { return byNumber.empty(); }
  int first() const { return byNumber.begin()->first; }
  int last() const { return byNumber.rbegin()->first; }
  // Throws LayoutError, which names the next files that are there, where there is no such file.
  const std::filesystem::path& at(int number) const;
};

// What stands before and after the number in a file's name: the last digits before the ending ("water2_0012
// .bobj.gz" is 12). Nothing where the name holds no number.
struct NumberedName {
  std::string before, after;
  int number = 0;
  bool operator==(const NumberedName&) const = default;
};
bool splitName(const std::string& name, NumberedName& split);

// Whether the last part of the path holds a place for a number: #, ##, ..., %d, %4d, %04d.
bool isPattern(const std::filesystem::path& path);

// All files of a pattern, or of the sequence that a file is of. Digits may be padded or not. A file without a
// number is a sequence of one, number 1. Empty files, which programs leave when they are stopped, count.
// Throws LayoutError: no such file, or two files with one number.
NumberedFiles numberedLike(const std::filesystem::path& patternOrFile);

// The sequences in a folder (not below it), by name, of files of which `isWanted` says so by their name;
// hidden files and those without a number are left out. Throws LayoutError: no such folder, or two files with
// one number.
using IsWanted = bool (*)(const std::string& name);
std::vector<NumberedFiles> sequencesIn(const std::filesystem::path& folder, IsWanted isWanted = nullptr);

}  // namespace fluidtex::caches
