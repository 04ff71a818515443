// Faults of a scene, with their source locations.
#pragma once

#include <string>
#include <vector>

namespace fluidtex::scenes {

// Source location of a key: in the scene file or on the command line.
struct Origin {
  int layer = 0;             // 0: the file; 1, 2, ...: the options of the command line, as they were given
  int line = 1, column = 1;  // of the key, in the file
  std::string where;         // as it is printed: "FILE:LINE:COLUMN" or "--set KEY=VALUE"
  std::string prefix;        // "quality.preview." for a key written there
  std::string extended{};    // the file, where it is one that the scene file extends
  bool commandLine() const { return layer > 0; }
};

struct Fault {
  Origin origin;
  std::string key;      // dotted, without the origin's prefix
  std::string message;  // what is wrong; what would be right
};

class Faults {
 public:
  // Further faults are counted but not kept: a damaged file has millions.
  static constexpr std::size_t kMost = 100;

  // Adds a fault, unless the same one is there for the same location.
  void add(const Origin& origin, const std::string& key, const std::string& wrong, const std::string& right);
  void add(const Fault& fault);

  bool has(const Fault& fault) const;

  // Whether neither the key nor anything below it has a fault.
  bool clean(const std::string& key) const;
  bool empty() const { return m_faults.empty(); }
  bool full() const { return m_faults.size() >= kMost; }
  const std::vector<Fault>& all() const { return m_faults; }

  // One line per fault: those of each file by line and column, then those of the command line. Names from the
  // scene are shortened and stripped of control characters.
  std::vector<std::string> lines() const;

 private:
  std::vector<Fault> m_faults;
};

// The text, or the beginning and end of a long one, about `most` bytes; UTF-8 characters are kept whole.
std::string shortened(const std::string& text, std::size_t most);

// Edit distance of a and b with insertion, deletion, replacement and transposition of neighbours (optimal
// string alignment), case-insensitive.
int editDistance(const std::string& a, const std::string& b);

// The name nearest to a wrong one; empty if none is near enough, or the wrong one is longer than any name.
std::string nearestName(const std::string& wrong, const std::vector<std::string>& names);

// "a, b and c", with another word for "and" where wanted.
std::string listed(const std::vector<std::string>& names, const std::string& last = "and");

}  // namespace fluidtex::scenes
