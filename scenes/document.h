// A scene file as a tree of values with their source locations, so that tables can be overlaid (file,
// quality, command line) and a fault still points at the line that caused it.
#pragma once

#include "scenes/faults.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace fluidtex::scenes {

struct Entry;
struct Node;
using Table = std::vector<Entry>;
using List = std::vector<Node>;
struct Moment {};  // a date or a time, which no key takes

struct Node {
  std::variant<bool, std::int64_t, double, std::string, Moment, List, Table> value;
  Origin origin;  // of the key it was given by; of the opening bracket for members of a list
};

struct Entry {
  std::string key;
  Node node;
};

// "a whole number", "a list", ...
std::string kindName(const Node& node);

Entry* find(Table& table, const std::string& key);
const Entry* find(const Table& table, const std::string& key);

// Parses a TOML file into a table. If it is missing, unreadable or not valid TOML, adds a fault and returns
// an empty table.
Node readDocument(const std::filesystem::path& file, Faults& faults);

// The same of text that was read already; `name`: what it is called in faults.
Node readDocument(const std::string& text, const std::string& name, Faults& faults);

// Parses one option of the command line into a table for overlay(). KEY=VALUE: KEY dotted, VALUE as in TOML,
// or a bare word, taken as a string. layer: its index among the options.
Node readAssignment(const std::string& assignment, int layer, Faults& faults);

// Expands keys written as one quoted word, "domain.resolution", into nested tables; prepends the prefix to
// all origins.
Node expanded(const Node& table, const std::string& prefix, Faults& faults);

// Overlays a table: tables are merged, everything else is replaced. A table over a list addresses its members
// by index, from 0. A key that excludes others (a shape, spacing or points) replaces them.
void overlay(Node& base, const Node& layer, Faults& faults);

}  // namespace fluidtex::scenes
