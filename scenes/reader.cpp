#include "scenes/reader.h"

#include "scenes/format.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <tuple>
#include <utility>

namespace fluidtex::scenes {

namespace {

std::string joined(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}

std::string lastOf(const std::string& path) {
  return path.substr(path.rfind('.') + 1);
}

std::string asRight(const std::string& path, const std::string& example) {
  return "write for example " + lastOf(path) + " = " + example;
}

// A member of a list of numbers: its faults are told at the list's key, unless it alone was overridden.
Node memberOf(const Node& list, std::size_t index) {
  Node member = std::get<List>(list.value)[index];
  if (member.origin.layer == list.origin.layer && member.origin.prefix == list.origin.prefix)
    member.origin = list.origin;
  return member;
}

std::string wantedNumber(const std::string& kind, const Limits& limits) {
  const std::string range = rangeOf(limits);
  return "give " + kind + (range.empty() ? "" : " " + range);
}

}  // namespace

Reader::Reader(const Node& document, std::filesystem::path folder, Faults& faults)
    : m_document(document), m_folder(std::move(folder)), m_faults(faults) {
  Level root;
  root.table = std::get_if<Table>(&document.value);
  root.origin = document.origin;
  m_levels.push_back(std::move(root));
}

std::string Reader::pathOf(const std::string& key) const {
  return joined(m_levels.back().path, key);
}

const Node* Reader::look(const std::string& key, Need need, const std::string& right) {
  Level& here = level();
  here.known.push_back(key);
  const std::string path = pathOf(key);
  remember(path);
  if (here.broken) return nullptr;
  if (here.table) {
    if (const Entry* entry = find(*here.table, key)) return &entry->node;
  }
  if (need == Need::required) m_faults.add(here.origin, path, "missing key", right);
  return nullptr;
}

void Reader::remember(const std::string& path) {
  if (!level().insideList && std::find(m_paths.begin(), m_paths.end(), path) == m_paths.end())
    m_paths.push_back(path);
}

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

void Reader::integer(const std::string& key, int& value, const Limits& limits) {
  const Node* node = look(key, Need::optional);
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
    wrongType(pathOf(key), *node, "a string", "\"" + (value.empty() ? std::string("gate") : value) + "\"");
  } else if (text->empty()) {
    m_faults.add(node->origin, pathOf(key), "an empty string", "give a name or leave the key out");
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

void Reader::file(const std::string& key, std::filesystem::path& value,
                  const std::vector<std::string>& endings) {
  const std::string example =
      endings.empty() ? "\"exemplars/green_scales.png\"" : "\"rock" + endings.front() + "\"";
  const Node* node = look(key, Need::required, asRight(key, example));
  if (!node) return;
  const std::string path = pathOf(key);
  const std::string* name = std::get_if<std::string>(&node->value);
  if (!name) return wrongType(path, *node, "a file's name", example);
  if (name->empty()) return m_faults.add(node->origin, path, "an empty file name", asRight(path, example));
  const std::filesystem::path full =
      (node->origin.commandLine() ? std::filesystem::path(*name) : m_folder / *name).lexically_normal();
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
  std::string ending = full.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  if (!endings.empty() && std::find(endings.begin(), endings.end(), ending) == endings.end()) {
    m_faults.add(node->origin, path, full.filename().string() + " is of no known kind",
                 "give a file that ends in " + listed(endings, "or"));
    return;
  }
  value = full;
}

void Reader::choice(const std::string& key, int& value, const std::vector<std::string>& words) {
  const Node* node = look(key, Need::optional);
  if (!node) return;
  const std::string path = pathOf(key);
  const std::string* word = std::get_if<std::string>(&node->value);
  if (!word) return wrongType(path, *node, "a string", "\"" + words[std::size_t(value)] + "\"");
  const auto found = std::find(words.begin(), words.end(), *word);
  if (found != words.end()) {
    value = int(found - words.begin());
    return;
  }
  std::vector<std::string> quoted;
  for (const std::string& known : words) quoted.push_back("\"" + known + "\"");
  m_faults.add(node->origin, path, "\"" + *word + "\" is unknown", "give " + listed(quoted, "or"));
}

int Reader::alternative(int current, const std::vector<std::string>& keys, Need need) {
  Level& here = level();
  for (const std::string& key : keys) {
    here.known.push_back(key);
    remember(pathOf(key));
  }
  if (!here.table || here.broken) return need == Need::required ? -1 : current;
  std::vector<const Entry*> found;
  for (const std::string& key : keys) {
    if (const Entry* entry = find(*here.table, key)) found.push_back(entry);
  }
  if (found.empty()) {
    if (need == Need::optional) return current;
    m_faults.add(here.origin, here.path, "no shape", "give one of " + listed(keys, "or"));
    return -1;
  }
  const auto before = [](const Entry* a, const Entry* b) {
    const Origin &one = a->node.origin, &other = b->node.origin;
    return std::tie(one.layer, one.line, one.column) < std::tie(other.layer, other.line, other.column);
  };
  std::stable_sort(found.begin(), found.end(), before);
  for (std::size_t i = 1; i < found.size(); ++i) {
    m_faults.add(found[i]->node.origin, pathOf(found[i]->key), "given besides " + found.front()->key,
                 "give only one of " + listed(keys, "and"));
  }
  return int(std::find(keys.begin(), keys.end(), found.front()->key) - keys.begin());
}

void Reader::absent(const std::string& key) {
  level().known.push_back(key);
}

void Reader::enter(const std::string& key, Need need) {
  const bool wasBroken = level().broken;
  const Node* node = look(key, Need::optional);
  Level inner;
  inner.path = pathOf(key);
  inner.insideList = level().insideList;
  inner.origin = node ? node->origin : level().origin;
  // A table that is left out and whose keys all have defaults is as good as an empty one; so is a required
  // table, but its required keys are then found missing one by one, each by its full name.
  inner.broken = wasBroken;
  if (node) {
    inner.table = std::get_if<Table>(&node->value);
    if (!inner.table) {
      m_faults.add(
          node->origin, inner.path, "wrong type, " + kindName(*node) + " where a table is wanted",
          inner.insideList ? "write for example " + key + " = { ... }" : "head it with [" + inner.path + "]");
      inner.broken = true;
    }
  } else if (need == Need::optional) {
    inner.broken = true;
  }
  m_levels.push_back(std::move(inner));
}

std::size_t Reader::enterList(const std::string& key, std::size_t, Need need) {
  const Node* node = look(key, need, "give at least one [[" + key + "]]");
  Level inner;
  inner.path = pathOf(key);
  inner.insideList = true;
  inner.origin = node ? node->origin : level().origin;
  inner.broken = !node;
  const bool outer = !level().insideList;
  if (node) {
    inner.list = std::get_if<List>(&node->value);
    if (!inner.list || (need == Need::required && inner.list->empty())) {
      const std::string wrong = inner.list
                                    ? "an empty list"
                                    : "wrong type, " + kindName(*node) + " where a list of tables is wanted";
      m_faults.add(node->origin, inner.path, wrong,
                   outer ? "head each member with [[" + key + "]]"
                         : "write for example " + key + " = [ { ... }, { ... } ]");
      inner.broken = true;
    }
  }
  m_levels.push_back(std::move(inner));
  return level().list ? level().list->size() : 0;
}

void Reader::enterMember(std::size_t index) {
  const Node& node = (*level().list)[index];
  Level inner;
  inner.path = pathOf(std::to_string(index));
  inner.insideList = true;
  inner.origin = node.origin;
  inner.table = std::get_if<Table>(&node.value);
  if (!inner.table) {
    m_faults.add(node.origin, inner.path, "wrong type, " + kindName(node) + " where a table is wanted",
                 "write for example { box = { min = [0, 0, 0], max = [1, 1, 1] } }");
    inner.broken = true;
  }
  m_levels.push_back(std::move(inner));
}

void Reader::leave() {
  collectUnknown(m_levels.back());
  m_levels.pop_back();
}

void Reader::collectUnknown(const Level& done) {
  if (!done.table) return;
  for (const Entry& entry : *done.table) {
    if (std::find(done.known.begin(), done.known.end(), entry.key) == done.known.end())
      m_unknown.push_back({entry.node.origin, done.path, entry.key, done.known});
  }
}

void Reader::reportUnknownKeys() {
  collectUnknown(level());
  for (const UnknownKey& unknown : m_unknown) {
    // The very word in another table, then a similar one here, then a similar one elsewhere.
    std::vector<std::string> sameWord, lastWords;
    for (const std::string& path : m_paths) {
      lastWords.push_back(lastOf(path));
      if (lastOf(path) == unknown.key) sameWord.push_back(unknown.origin.prefix + path);
    }
    std::string right;
    const std::string near = nearestName(unknown.key, unknown.siblings),
                      far = nearestName(unknown.key, lastWords);
    if (!sameWord.empty()) {
      right = "did you mean " + listed(sameWord, "or") + "?";
    } else if (!near.empty()) {
      right = "did you mean " + unknown.origin.prefix + joined(unknown.path, near) + "?";
    } else if (!far.empty()) {
      const auto found = std::find(lastWords.begin(), lastWords.end(), far);
      right = "did you mean " + unknown.origin.prefix + m_paths[std::size_t(found - lastWords.begin())] + "?";
    } else {
      right = "known here: " + listed(unknown.siblings);
    }
    m_faults.add(unknown.origin, joined(unknown.path, unknown.key), "unknown key", right);
  }
}

const Node* Reader::findPath(const std::string& path, Origin* origin) const {
  const Node* node = &m_document;
  if (origin) *origin = node->origin;
  std::size_t start = 0;
  while (start <= path.size()) {
    const std::size_t dot = std::min(path.find('.', start), path.size());
    const std::string part = path.substr(start, dot - start);
    const Node* next = nullptr;
    if (const Table* table = std::get_if<Table>(&node->value)) {
      const Entry* entry = find(*table, part);
      if (entry) next = &entry->node;
    } else if (const List* list = std::get_if<List>(&node->value)) {
      std::size_t index = list->size();
      std::from_chars(part.data(), part.data() + part.size(), index);
      if (index < list->size()) next = &(*list)[index];
    }
    if (!next) return nullptr;
    node = next;
    if (origin) *origin = node->origin;
    start = dot + 1;
  }
  return node;
}

bool Reader::given(const std::string& path) const {
  return findPath(path, nullptr) != nullptr;
}

Origin Reader::originOf(const std::string& path) const {
  Origin origin;
  findPath(path, &origin);
  return origin;
}

void Reader::fault(const std::string& path, const std::string& wrong, const std::string& right) {
  m_faults.add(originOf(path), path, wrong, right);
}

}  // namespace fluidtex::scenes
