#include "scenes/document.h"

#include "scenes/nesting.h"
#include "scenes/schema.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <fstream>
#include <optional>
#include <sstream>
#include <utility>

namespace fluidtex::scenes {

namespace {

Origin inFile(const std::string& file, int line, int column) {
  return {0, line, column, file + ":" + std::to_string(line) + ":" + std::to_string(column), ""};
}

// No scene comes near these: tables are searched key by key, and each member of a list takes its time.
constexpr std::size_t kMostKeys = 1000, kMostMembers = 10000;
constexpr std::size_t kLargestFile = 4 << 20;  // bytes
constexpr std::size_t kLongestAssignment = 160;

const std::string kTooDeep = "is nested more than " + std::to_string(kDeepest) + " deep";
const std::string kNotSoDeep = "no key of a scene has more than 8 parts";
const std::string kGiveScene = "give a scene file, for example scenes/dam_break.toml";

// `place` turns a position into an origin: lines and columns mean something in a file only.
template <class Place>
Node converted(const toml::node& source, const Origin& origin, const std::string& path, const Place& place,
               Faults& faults) {
  Node node{{}, origin};
  const auto tooMany = [&](std::size_t count, std::size_t most, const char* what) {
    if (count <= most) return false;
    faults.add(origin, path.empty() ? "file" : path, std::to_string(count) + what,
               "give at most " + std::to_string(most));
    return true;
  };
  const auto below = [&](std::string_view key) {
    return (path.empty() ? "" : path + ".") + shortened(std::string(key), kLongestAssignment);
  };
  if (const toml::table* table = source.as_table()) {
    Table entries;
    if (!tooMany(table->size(), kMostKeys, " keys in one table"))
      for (const auto& [key, value] : *table)
        entries.push_back(
            {std::string(key.str()), converted(value, place(key.source()), below(key.str()), place, faults)});
    node.value = std::move(entries);
  } else if (const toml::array* array = source.as_array()) {
    List members;
    if (!tooMany(array->size(), kMostMembers, " members in one list"))
      for (const toml::node& value : *array)
        members.push_back(
            converted(value, place(value.source()), below(std::to_string(members.size())), place, faults));
    node.value = std::move(members);
  } else if (const auto* flag = source.as_boolean()) {
    node.value = flag->get();
  } else if (const auto* integer = source.as_integer()) {
    node.value = integer->get();
  } else if (const auto* number = source.as_floating_point()) {
    node.value = number->get();
  } else if (const auto* text = source.as_string()) {
    node.value = text->get();
  } else {
    node.value = Moment{};
  }
  return node;
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

std::vector<std::string> splitAtDots(const std::string& key) {
  std::vector<std::string> parts;
  std::istringstream stream(key);
  for (std::string part; std::getline(stream, part, '.');) parts.push_back(part);
  if (key.empty() || key.back() == '.') parts.emplace_back();
  return parts;
}

void insertAt(Table& table, const std::vector<std::string>& path, Node node, const std::string& fullKey,
              Faults& faults) {
  Table* here = &table;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    Entry* entry = find(*here, path[i]);
    if (!entry) {
      here->push_back({path[i], Node{Table{}, node.origin}});
      entry = &here->back();
    }
    here = std::get_if<Table>(&entry->node.value);
    if (!here) break;
  }
  Entry* existing = here ? find(*here, path.back()) : nullptr;
  if (here && !existing) {
    here->push_back({path.back(), std::move(node)});
    return;
  }
  Table* tables[] = {existing ? std::get_if<Table>(&existing->node.value) : nullptr,
                     std::get_if<Table>(&node.value)};
  if (!tables[0] || !tables[1]) {
    faults.add(node.origin, fullKey, "given twice", "keep one of them");
    return;
  }
  for (Entry& entry : *tables[1])
    insertAt(*tables[0], {entry.key}, std::move(entry.node), fullKey + "." + entry.key, faults);
}

Node expandedAt(const Node& source, const std::string& path, const std::string& prefix, Faults& faults) {
  Node node = source;
  node.origin.prefix = prefix;
  if (const Table* table = std::get_if<Table>(&source.value)) {
    Table entries;
    for (const Entry& entry : *table) {
      const std::string key = path.empty() ? entry.key : path + "." + entry.key;
      const std::vector<std::string> parts = splitAtDots(entry.key);
      if (parts.size() > std::size_t(kDeepest))
        faults.add(entry.node.origin, key, kTooDeep, kNotSoDeep);
      else
        insertAt(entries, parts, expandedAt(entry.node, key, prefix, faults), key, faults);
    }
    node.value = std::move(entries);
  } else if (List* list = std::get_if<List>(&node.value)) {
    for (std::size_t i = 0; i < list->size(); ++i)
      (*list)[i] = expandedAt((*list)[i], path + "." + std::to_string(i), prefix, faults);
  }
  return node;
}

void overlayEntry(Node& base, const Entry& entry, const std::string& path, Faults& faults);

void overlayTable(Node& base, const Table& layer, const std::string& path, Faults& faults) {
  if (Table* table = std::get_if<Table>(&base.value)) {
    // First all that is displaced, so that two exclusive keys of one layer both stay, to be found wrong
    // later.
    for (const Entry& entry : layer) {
      for (const auto* keys : {&kShapeKeys, &kDensityKeys}) {
        const auto in = [&](const std::string& key) {
          return std::find(keys->begin(), keys->end(), key) != keys->end();
        };
        if (!in(entry.key)) continue;
        std::erase_if(*table, [&](const Entry& other) { return other.key != entry.key && in(other.key); });
      }
    }
  }
  for (const Entry& entry : layer) overlayEntry(base, entry, path, faults);
}

void overlayNode(Node& base, const Node& layer, const std::string& path, Faults& faults) {
  const Table* table = std::get_if<Table>(&layer.value);
  const bool open = std::holds_alternative<Table>(base.value) || std::holds_alternative<List>(base.value);
  if (table && open) {
    overlayTable(base, *table, path, faults);
  } else {
    base = layer;
  }
}

void overlayEntry(Node& base, const Entry& entry, const std::string& path, Faults& faults) {
  const std::string fullKey = path.empty() ? entry.key : path + "." + entry.key;
  if (Table* table = std::get_if<Table>(&base.value)) {
    if (Entry* existing = find(*table, entry.key)) {
      overlayNode(existing->node, entry.node, fullKey, faults);
    } else {
      table->push_back(entry);
    }
    return;
  }
  List& list = std::get<List>(base.value);
  std::size_t index = 0;
  const char* end = entry.key.data() + entry.key.size();
  const auto [last, error] = std::from_chars(entry.key.data(), end, index);
  if (error != std::errc{} || last != end || index >= list.size()) {
    const std::string right =
        list.empty() ? "the list is empty"
                     : "the list's members are " + path + ".0" +
                           (list.size() > 1 ? " to " + path + "." + std::to_string(list.size() - 1) : "");
    faults.add(entry.node.origin, fullKey, "no such member", right);
    return;
  }
  overlayNode(list[index], entry.node, fullKey, faults);
}

}  // namespace

std::string kindName(const Node& node) {
  struct Names {
    std::string operator()(bool value) const { return value ? "true" : "false"; }
    std::string operator()(std::int64_t) const { return "a whole number"; }
    std::string operator()(double) const { return "a decimal number"; }
    std::string operator()(const std::string&) const { return "a string"; }
    std::string operator()(Moment) const { return "a date or time"; }
    std::string operator()(const List&) const { return "a list"; }
    std::string operator()(const Table&) const { return "a table"; }
  };
  return std::visit(Names{}, node.value);
}

Entry* find(Table& table, const std::string& key) {
  return const_cast<Entry*>(find(std::as_const(table), key));
}

const Entry* find(const Table& table, const std::string& key) {
  const auto found =
      std::find_if(table.begin(), table.end(), [&](const Entry& entry) { return entry.key == key; });
  return found == table.end() ? nullptr : &*found;
}

Node readDocument(const std::filesystem::path& file, Faults& faults) {
  const Origin top = inFile(file.string(), 1, 1);
  Node nothing{Table{}, top};
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    faults.add(top, "file", "is a folder", kGiveScene);
    return nothing;
  }
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text(kLargestFile + 1, '\0');
  stream.read(text.data(), std::streamsize(text.size()));
  if (stream.bad() || (stream.fail() && !stream.eof())) {
    const int reason = errno;
    faults.add(top, "file",
               reason == ENOENT ? "no such file" : std::string("cannot be read: ") + std::strerror(reason),
               kGiveScene);
    return nothing;
  }
  text.resize(std::size_t(stream.gcount()));
  return readDocument(text, file.string(), faults);
}

Node readDocument(const std::string& text, const std::string& name, Faults& faults) {
  const Origin top = inFile(name, 1, 1);
  Node document{Table{}, top};
  if (text.size() > kLargestFile) {
    faults.add(top, "file", "is larger than " + std::to_string(kLargestFile >> 20) + " MB", kGiveScene);
    return document;
  }
  if (const auto deep = tooDeep(text)) {
    faults.add(inFile(name, deep->line, deep->column), "syntax", kTooDeep, kNotSoDeep);
    return document;
  }
  try {
    const toml::table table = toml::parse(text, name);
    const auto place = [&](const toml::source_region& region) {
      return inFile(name, int(region.begin.line), int(region.begin.column));
    };
    document = converted(table, top, "", place, faults);
    document.origin = top;
  } catch (const toml::parse_error& error) {
    const auto& begin = error.source().begin;
    faults.add(inFile(name, std::max(1, int(begin.line)), std::max(1, int(begin.column))), "syntax",
               std::string(error.description()), "write it as in https://toml.io/en/v1.0.0");
  }
  return document;
}

Node readAssignment(const std::string& assignment, int layer, Faults& faults) {
  const Origin origin{layer, 1, 1, "--set " + shortened(assignment, kLongestAssignment), ""};
  Node result{Table{}, origin};
  const std::size_t equals = assignment.find('=');
  const std::string key = trimmed(assignment.substr(0, equals));
  const std::vector<std::string> path = splitAtDots(key);
  if (equals == std::string::npos || std::find(path.begin(), path.end(), "") != path.end()) {
    faults.add(origin, "--set", "not of the form KEY=VALUE", "write for example --set domain.resolution=64");
    return result;
  }
  const std::string text = trimmed(assignment.substr(equals + 1));
  if (path.size() > std::size_t(kDeepest) || tooDeep(text)) {
    faults.add(origin, key, kTooDeep, kNotSoDeep);
    return result;
  }
  Node value{text, origin};
  try {
    const toml::table table = toml::parse("value = " + text + "\n");
    if (table.size() != 1) {
      faults.add(origin, key, "more than one value", "give one --set for each key");
      return result;
    }
    value = converted(
        *table.get("value"), origin, key, [&](const toml::source_region&) { return origin; }, faults);
  } catch (const toml::parse_error& error) {
    if (text.empty()) {
      faults.add(origin, key, "no value", "write KEY=VALUE; an empty string is \"\"");
      return result;
    }
    // What opens like a list, a table or a quoted string was meant as one; anything else is a bare word.
    if (std::strchr("[{\"'", text.front())) {
      faults.add(origin, key, std::string(error.description()),
                 "write the value as in https://toml.io/en/v1.0.0");
      return result;
    }
  }
  insertAt(std::get<Table>(result.value), path, std::move(value), key, faults);
  return result;
}

Node expanded(const Node& node, const std::string& prefix, Faults& faults) {
  return expandedAt(node, "", prefix, faults);
}

void overlay(Node& base, const Node& layer, Faults& faults) {
  if (const Table* table = std::get_if<Table>(&layer.value)) overlayTable(base, *table, "", faults);
}

}  // namespace fluidtex::scenes
