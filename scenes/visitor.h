// Interface between the schema (scenes/schema.h) and its visitors. The schema names every key once with the
// variable behind it; a reader fills the variable from a file, a writer puts it into the resolved scene.
#pragma once

#include "sim/options.h"
#include "texture/options.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace fluidtex::scenes {

using sim::Vec3d;

// Range of a number; of vectors and lists, of every member.
struct Limits {
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool aboveLow = false;  // low itself is not allowed
  bool infinite = false;  // plus infinity is allowed
};
inline constexpr Limits kAny{};
inline constexpr Limits kPositive{.low = 0.0, .aboveLow = true};
inline constexpr Limits kNotNegative{.low = 0.0};
inline constexpr Limits kShare{.low = 0.0, .high = 1.0};

enum class Need { optional, required };

class Visitor {
 public:
  virtual ~Visitor() = default;

  virtual void flag(const std::string& key, bool& value) = 0;
  virtual void integer(const std::string& key, int& value, const Limits& limits,
                       Need need = Need::optional) = 0;
  virtual void seed(const std::string& key, std::uint64_t& value) = 0;
  virtual void number(const std::string& key, double& value, const Limits& limits,
                      Need need = Need::optional) = 0;
  virtual void text(const std::string& key, std::string& value) = 0;
  virtual void vector(const std::string& key, Vec3d& value, const Limits& limits,
                      Need need = Need::optional) = 0;
  virtual void integers(const std::string& key, std::vector<int>& value, const Limits& limits) = 0;
  virtual void pixels(const std::string& key, int& width, int& height, const Limits& limits) = 0;
  // An existing file. endings: allowed extensions, in lower case; empty: any.
  virtual void file(const std::string& key, std::filesystem::path& value,
                    const std::vector<std::string>& endings) = 0;
  // A sequence of files, numbered by %d or %04d (four digits) in the last part of the name. Their existence
  // is not checked.
  virtual void files(const std::string& key, std::filesystem::path& value,
                     const std::vector<std::string>& endings) = 0;
  // An existing file, or a sequence as above: then its first file and what there is of it.
  virtual void picture(const std::string& key, std::filesystem::path& value,
                       texture::AnimationOptions& sequence) = 0;
  // A file, a folder or a pattern of files. Its existence is not checked.
  virtual void path(const std::string& key, std::filesystem::path& value) = 0;
  // One of a few words, by index.
  virtual void choice(const std::string& key, int& value, const std::vector<std::string>& words) = 0;

  // Which of several exclusive keys is given; `current` is the one that the value holds. The key is then
  // visited as usual. A reader that finds none keeps `current`, and adds a fault if one is required.
  virtual int alternative(int current, const std::vector<std::string>& keys, Need need) = 0;
  // The key that an alternative replaces.
  virtual void absent(const std::string& key) = 0;

  // Everything up to the matching leave() is inside the table.
  virtual void enter(const std::string& key, Need need) = 0;
  // A list of tables: returns their number; each is entered by its index.
  virtual std::size_t enterList(const std::string& key, std::size_t size, Need need) = 0;
  virtual void enterMember(std::size_t index) = 0;
  virtual void leave() = 0;

  void table(const std::string& key, const auto& body, Need need = Need::optional) {
    enter(key, need);
    body();
    leave();
  }

  template <class Member>
  void list(const std::string& key, std::vector<Member>& members, const auto& body,
            Need need = Need::optional) {
    members.resize(enterList(key, members.size(), need));
    for (std::size_t i = 0; i < members.size(); ++i) {
      enterMember(i);
      body(members[i]);
      leave();
    }
    leave();
  }
};

// One of an enumeration whose values stand in the order of the words.
template <class Enum>
void choice(Visitor& visitor, const std::string& key, Enum& value, const std::vector<std::string>& words) {
  int index = int(value);
  visitor.choice(key, index, words);
  value = Enum(index);
}

}  // namespace fluidtex::scenes
