// How the schema (scenes/schema.h) and those who go through it talk: it names every key, once, and hands over
// the variable behind it; a reader fills the variable from a file, a writer puts it into the resolved scene.
#pragma once

#include "sim/options.h"

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace fluidtex::scenes {

using sim::Vec3d;

// What values a number may take; of vectors and lists, every member.
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
  // A file that exists. `endings`: what its name may end in, in small letters; empty: anything.
  virtual void file(const std::string& key, std::filesystem::path& value,
                    const std::vector<std::string>& endings) = 0;
  // Files whose names differ in a number, whose place is %d in the last part of the name, or %04d for one of
  // four digits. Whether they exist is not asked.
  virtual void files(const std::string& key, std::filesystem::path& value,
                     const std::vector<std::string>& endings) = 0;
  // One of a few words, by number.
  virtual void choice(const std::string& key, int& value, const std::vector<std::string>& words) = 0;

  // Which one of several keys that exclude each other is there; `current` says which one the value holds. The
  // key itself is then visited as usual. A reader that finds none keeps the current one; that is a fault
  // where one is required.
  virtual int alternative(int current, const std::vector<std::string>& keys, Need need) = 0;
  // The key that an alternative replaces.
  virtual void absent(const std::string& key) = 0;

  // All up to the matching leave() is inside the table.
  virtual void enter(const std::string& key, Need need) = 0;
  // A list of tables: returns how many there are; each is entered by its number.
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

}  // namespace fluidtex::scenes
