// A scene file as a tree of values that remember where they were written, so that tables can be laid over
// each other (file, quality, command line) and a fault still points at the line that caused it.
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

// Reads a TOML file into a table. A missing, unreadable or wrongly written file is a fault, and the table is
// empty.
Node readDocument(const std::filesystem::path& file, Faults& faults);

// One option of the command line as a table that can be laid over a document. KEY=VALUE: KEY dotted, VALUE as
// in TOML, or a bare word, which is taken as a string. `layer` is its place among the options.
Node readAssignment(const std::string& assignment, int layer, Faults& faults);

// Keys written as one quoted word, "domain.resolution", become tables in tables; all origins get the prefix.
Node expanded(const Node& table, const std::string& prefix, Faults& faults);

// Lays a table over another: tables are merged, everything else is replaced. A table laid over a list
// addresses its members by number, from 0. A key that excludes others (a shape, spacing or points) takes
// their place.
void overlay(Node& base, const Node& layer, Faults& faults);

}  // namespace fluidtex::scenes
