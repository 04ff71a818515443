// Where a setting was written, and what is wrong with it.
#pragma once

#include <string>
#include <vector>

namespace fluidtex::scenes {

// The place of one key: in the scene file or on the command line.
struct Origin {
  int layer = 0;             // 0: the file; 1, 2, ...: the options of the command line, as they were given
  int line = 1, column = 1;  // of the key, in the file
  std::string where;         // as it is printed: "FILE:LINE:COLUMN" or "--set KEY=VALUE"
  std::string prefix;        // "quality.preview." for a key written there
  bool commandLine() const { return layer > 0; }
};

struct Fault {
  Origin origin;
  std::string key;      // dotted, without the origin's prefix
  std::string message;  // what is wrong; what would be right
};

class Faults {
 public:
  // More are counted and not kept: nobody reads them, and a damaged file has millions.
  static constexpr std::size_t kMost = 100;

  // Kept once, however often the same place is found wrong in the same way.
  void add(const Origin& origin, const std::string& key, const std::string& wrong, const std::string& right);
  void add(const Fault& fault);

  bool has(const Fault& fault) const;

  // Neither the key nor anything below it has a fault.
  bool clean(const std::string& key) const;
  bool empty() const { return m_faults.empty(); }
  bool full() const { return m_faults.size() >= kMost; }
  const std::vector<Fault>& all() const { return m_faults; }

  // One line a fault: the file's in order of line and column, then the command line's. What a scene names is
  // told shortened and without control characters.
  std::vector<std::string> lines() const;

 private:
  std::vector<Fault> m_faults;
};

// The text itself, or of a long one its beginning and its end, about `most` bytes; no letter is cut in two.
std::string shortened(const std::string& text, std::size_t most);

// How many letters must be inserted, left out, replaced or swapped with their neighbour to turn a into b
// (optimal string alignment; capitals count as their small letters).
int editDistance(const std::string& a, const std::string& b);

// The name most like the wrong one; empty if none is near enough to be what was meant, or the wrong one is
// longer than any name.
std::string nearestName(const std::string& wrong, const std::vector<std::string>& names);

// "a, b and c", with another word for "and" where wanted.
std::string listed(const std::vector<std::string>& names, const std::string& last = "and");

}  // namespace fluidtex::scenes
