// How each kind of value is read: its type, then its limits.
#include "scenes/numbered_files.h"
#include "scenes/reader.h"
#include "scenes/value_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <regex>
#include <utility>

namespace fluidtex::scenes {

namespace {

// The file system's own limits, of a folder's name and of a path; pictures and videos add their endings.
constexpr std::size_t kLongestName = 200, kLongestFile = 4000;

std::string asRight(const std::string& path, const std::string& example) {
  return "write for example " + path.substr(path.rfind('.') + 1) + " = " + example;
}

// A member of a list of numbers: its faults are told at the list's key, unless it alone was overridden.
Node memberOf(const Node& list, std::size_t index) {
  Node member = std::get<List>(list.value)[index];
  if (member.origin.layer == list.origin.layer && member.origin.prefix == list.origin.prefix)
    member.origin = list.origin;
  return member;
}

std::string quoted(const std::string& text) {
  return "\"" + text + "\"";
}

std::string wantedNumber(const std::string& kind, const Limits& limits) {
  const std::string range = rangeOf(limits);
  return "give " + kind + (range.empty() ? "" : " " + range);
}

}  // namespace

void Reader::wrongType(const std::string& path, const Node& node, const std::string& wanted,
                       const std::string& example) {
  m_faults.add(node.origin, path, "wrong type, " + kindName(node) + " where " + wanted + " is wanted",
               asRight(path, example));
}

bool Reader::readNumber(const std::string& path, const Node& node, const Limits& limits,
                        const std::string& example, double& value) {
  double number = 0.0;
  if (const auto* integer = std::get_if<std::int64_t>(&node.value)) {
    number = double(*integer);
  } else if (const auto* decimal = std::get_if<double>(&node.value)) {
    number = *decimal;
  } else {
    wrongType(path, node, "a number", example);
    return false;
  }
  if (!within(limits, number)) {
    const std::string wrong = !std::isfinite(number)              ? "is not a finite number"
                              : number > limits.high              ? "is too large"
                              : limits.low == 0.0 && number < 0.0 ? "is negative"
                                                                  : "is too small";
    m_faults.add(node.origin, path, written(number) + " " + wrong, wantedNumber("a number", limits));
    return false;
  }
  value = number;
  return true;
}

bool Reader::readInteger(const std::string& path, const Node& node, const Limits& limits,
                         const std::string& example, std::int64_t& value) {
  const auto* integer = std::get_if<std::int64_t>(&node.value);
  if (!integer) {
    wrongType(path, node, "a whole number", example);
    return false;
  }
  if (!within(limits, double(*integer))) {
    m_faults.add(
        node.origin, path,
        std::to_string(*integer) + (double(*integer) > limits.high ? " is too large" : " is too small"),
        wantedNumber("a whole number", limits));
    return false;
  }
  value = *integer;
  return true;
}

void Reader::flag(const std::string& key, bool& value) {
  const Node* node = look(key, Need::optional);
  if (!node) return;
  if (const bool* flag = std::get_if<bool>(&node->value)) {
    value = *flag;
  } else {
    wrongType(pathOf(key), *node, "true or false", value ? "true" : "false");
  }
}

void Reader::integer(const std::string& key, int& value, const Limits& limits, Need need) {
  const Node* node = look(key, need, asRight(key, std::to_string(value)));
  std::int64_t number = 0;
  if (node && readInteger(pathOf(key), *node, limits, std::to_string(value), number)) value = int(number);
}

void Reader::seed(const std::string& key, std::uint64_t& value) {
  const Node* node = look(key, Need::optional);
  std::int64_t number = 0;
  if (node && readInteger(pathOf(key), *node, kNotNegative, "1", number)) value = std::uint64_t(number);
}

void Reader::number(const std::string& key, double& value, const Limits& limits, Need need) {
  const std::string example = std::isfinite(value) && within(limits, value) ? written(value) : "1.5";
  const Node* node = look(key, need, asRight(key, example));
  if (node) readNumber(pathOf(key), *node, limits, example, value);
}

void Reader::text(const std::string& key, std::string& value) {
  const Node* node = look(key, Need::optional);
  if (!node) return;
  const std::string* text = std::get_if<std::string>(&node->value);
  if (!text) {
    wrongType(pathOf(key), *node, "a string", quoted(value.empty() ? "gate" : value));
  } else if (text->empty()) {
    m_faults.add(node->origin, pathOf(key), "an empty string", "give a name or leave the key out");
  } else if (text->size() > kLongestName) {
    m_faults.add(node->origin, pathOf(key), "a string of " + std::to_string(text->size()) + " bytes",
                 "give a name of at most " + std::to_string(kLongestName));
  } else {
    value = *text;
  }
}

void Reader::vector(const std::string& key, Vec3d& value, const Limits& limits, Need need) {
  const Node* node = look(key, need, asRight(key, written(value)));
  if (!node) return;
  const std::string path = pathOf(key), example = written(value);
  const List* list = std::get_if<List>(&node->value);
  if (!list) return wrongType(path, *node, "a list of 3 numbers", example);
  if (list->size() != 3) {
    m_faults.add(node->origin, path,
                 "a list of " + std::to_string(list->size()) + " where 3 numbers are wanted",
                 asRight(path, example));
    return;
  }
  Vec3d read;
  bool good = true;
  for (int axis = 0; axis < 3; ++axis) {
    const Node member = memberOf(*node, std::size_t(axis));
    good = readNumber(path, member, limits, example, read[axis]) && good;
  }
  if (good) value = read;
}

void Reader::integers(const std::string& key, std::vector<int>& value, const Limits& limits) {
  const Node* node = look(key, Need::optional);
  if (!node) return;
  const std::string path = pathOf(key), example = written(value);
  const List* list = std::get_if<List>(&node->value);
  if (!list) return wrongType(path, *node, "a list of whole numbers", example);
  if (list->empty()) return m_faults.add(node->origin, path, "an empty list", asRight(path, example));
  std::vector<int> read;
  bool good = true;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const Node member = memberOf(*node, i);
    std::int64_t number = 0;
    good = readInteger(path, member, limits, example, number) && good;
    read.push_back(int(number));
  }
  if (good) value = std::move(read);
}

void Reader::pixels(const std::string& key, int& width, int& height, const Limits& limits) {
  const Node* node = look(key, Need::optional);
  if (!node) return;
  const std::string path = pathOf(key), example = written(std::vector<int>{width, height});
  const List* list = std::get_if<List>(&node->value);
  if (!list) return wrongType(path, *node, "a list of 2 whole numbers", example);
  if (list->size() != 2) {
    m_faults.add(node->origin, path,
                 "a list of " + std::to_string(list->size()) + " where width and height are wanted",
                 asRight(path, example));
    return;
  }
  std::int64_t read[2] = {0, 0};
  bool good = true;
  for (std::size_t i = 0; i < 2; ++i) {
    const Node member = memberOf(*node, i);
    good = readInteger(path, member, limits, example, read[i]) && good;
  }
  if (!good) return;
  width = int(read[0]);
  height = int(read[1]);
}

bool Reader::readName(const std::string& key, const std::string& example, const Node*& node,
                      std::filesystem::path& full) {
  node = look(key, Need::required, asRight(key, example));
  if (!node) return false;
  const std::string path = pathOf(key);
  const std::string* name = std::get_if<std::string>(&node->value);
  if (!name) {
    wrongType(path, *node, "a file's name", example);
    return false;
  }
  if (name->empty()) {
    m_faults.add(node->origin, path, "an empty file name", asRight(path, example));
    return false;
  }
  if (name->size() > kLongestFile) {
    m_faults.add(node->origin, path, "a file's name of " + std::to_string(name->size()) + " bytes",
                 "give one of at most " + std::to_string(kLongestFile));
    return false;
  }
  full = (folderOf(node->origin) / *name).lexically_normal();
  return true;
}

bool Reader::hasEnding(const std::string& path, const Node& node, const std::filesystem::path& full,
                       const std::vector<std::string>& endings) {
  std::string ending = full.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  if (endings.empty() || std::find(endings.begin(), endings.end(), ending) != endings.end()) return true;
  m_faults.add(node.origin, path, full.filename().string() + " is of no known kind",
               "give a file that ends in " + listed(endings, "or"));
  return false;
}

void Reader::file(const std::string& key, std::filesystem::path& value,
                  const std::vector<std::string>& endings) {
  const std::string example =
      endings.empty() ? quoted("exemplars/green_scales.png") : quoted("rock" + endings.front());
  const Node* node = nullptr;
  std::filesystem::path full;
  if (!readName(key, example, node, full)) return;
  const std::string path = pathOf(key);
  const std::string relativeTo =
      node->origin.commandLine() ? "the current folder" : "the scene file's folder";
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(full, error);
  if (status.type() == std::filesystem::file_type::not_found) {
    m_faults.add(node->origin, path, "no such file: " + full.string(),
                 "give an existing file, relative to " + relativeTo);
    return;
  }
  if (std::filesystem::is_directory(status)) {
    m_faults.add(node->origin, path, full.string() + " is a folder", "give a file in it");
    return;
  }
  if (!std::filesystem::exists(status)) {
    m_faults.add(node->origin, path, full.string() + " cannot be looked at: " + error.message(),
                 "give a file that can be read");
    return;
  }
  if (hasEnding(path, *node, full, endings)) value = full;
}

void Reader::files(const std::string& key, std::filesystem::path& value,
                   const std::vector<std::string>& endings) {
  static const std::regex kNumbered("[^%]*%(0[1-9])?d[^%]*");
  const std::string example = quoted("rock_%04d" + (endings.empty() ? ".png" : endings.front()));
  const Node* node = nullptr;
  std::filesystem::path full;
  if (!readName(key, example, node, full)) return;
  const std::string path = pathOf(key), last = full.filename().string();
  if (!std::regex_match(last, kNumbered)) {
    m_faults.add(node->origin, path,
                 last.find('%') == std::string::npos
                     ? last + " has no place for a number"
                     : last + " does not say in one place where the number is",
                 "write %d for it, or %04d where it has four digits, for example " + example);
    return;
  }
  if (hasEnding(path, *node, full, endings)) value = full;
}

void Reader::picture(const std::string& key, std::filesystem::path& value,
                     texture::AnimationOptions& sequence) {
  const Node* node = look(key, Need::optional);
  const std::string* name = node ? std::get_if<std::string>(&node->value) : nullptr;
  if (!name || !isPattern(folderOf(node->origin) / *name)) return file(key, value, {});
  files(key, sequence.pattern, {});
  const std::string path = pathOf(key);
  if (!clean(path)) return;
  const NumberedFiles found = numberedFiles(sequence.pattern);
  if (!found.missing.empty()) {
    m_faults.add(node->origin, path, found.missing.string() + " is missing, and there are later ones",
                 "give pictures of consecutive numbers");
    return;
  }
  if (found.files.size() < 2) {
    const std::string pattern = sequence.pattern.string();
    m_faults.add(node->origin, path,
                 found.files.empty() ? "no such file: " + pattern : "there is one picture only of " + pattern,
                 "give the pattern of two pictures or more, or the name of one");
    return;
  }
  sequence.first = found.first;
  sequence.files = found.files;
  value = found.files.front();
}

void Reader::path(const std::string& key, std::filesystem::path& value) {
  const Node* node = look(key, Need::optional);
  std::filesystem::path full;
  if (node && readName(key, quoted("cache_fluid"), node, full)) value = full;
}

void Reader::choice(const std::string& key, int& value, const std::vector<std::string>& words) {
  const Node* node = look(key, Need::optional);
  if (!node) return;
  const std::string path = pathOf(key);
  const std::string* word = std::get_if<std::string>(&node->value);
  if (!word) return wrongType(path, *node, "a string", quoted(words[std::size_t(value)]));
  const auto found = std::find(words.begin(), words.end(), *word);
  if (found != words.end()) {
    value = int(found - words.begin());
    return;
  }
  std::vector<std::string> known;
  known.reserve(words.size());
  for (const std::string& other : words) known.push_back(quoted(other));
  m_faults.add(node->origin, path, quoted(*word) + " is unknown", "give " + listed(known, "or"));
}

}  // namespace fluidtex::scenes
