#include "scenes/visitor.h"

#include "tests/scenes/recorder.h"

#include <catch2/catch.hpp>

namespace fluidtex::scenes {

namespace {

// Its lists have so many members, whatever the value has.
class OfLength : public Recorder {
 public:
  explicit OfLength(std::size_t length) : m_length(length) {}
  std::size_t enterList(const std::string& key, std::size_t size, Need need) override {
    Recorder::enterList(key, size, need);
    return m_length;
  }

 private:
  std::size_t m_length;
};

// It knows the word with this index.
class Choosing : public Recorder {
 public:
  explicit Choosing(int index) : m_index(index) {}
  void choice(const std::string&, int& value, const std::vector<std::string>& words) override {
    shown = words.at(std::size_t(value));
    value = m_index;
  }
  std::string shown;

 private:
  int m_index;
};

}  // namespace

TEST_CASE("visitor: a table is open while its body runs", "[scenes]") {
  Recorder visitor;
  bool flag = false;
  visitor.table("outer", [&] {
    visitor.flag("first", flag);
    visitor.table("inner", [&] { visitor.flag("second", flag); });
    visitor.flag("third", flag);
  });
  CHECK(visitor.calls ==
        std::vector<std::string>{"enter outer", "first", "enter inner", "second", "leave", "third", "leave"});
  CHECK(visitor.keys == std::vector<std::string>{"outer.first", "outer.inner.second", "outer.third"});
}

TEST_CASE("visitor: a list gets as many members as the visitor has, those there were first", "[scenes]") {
  for (const std::size_t length : {std::size_t{0}, std::size_t{1}, std::size_t{3}}) {
    OfLength visitor(length);
    std::vector<int> members{7, 8};
    std::vector<int> seen;
    visitor.list("numbers", members, [&](int& member) {
      visitor.integer("n", member, kAny, Need::optional);
      seen.push_back(member);
      member += 100;
    });
    std::vector<int> before{7, 8};
    before.resize(length);
    CHECK(seen == before);
    REQUIRE(members.size() == length);
    for (std::size_t i = 0; i < length; ++i) CHECK(members[i] == before[i] + 100);
    std::vector<std::string> calls{"enter numbers"};
    for (std::size_t i = 0; i < length; ++i)
      for (const std::string& call : {"enter " + std::to_string(i), std::string("n"), std::string("leave")})
        calls.push_back(call);
    calls.emplace_back("leave");
    CHECK(visitor.calls == calls);
  }
}

TEST_CASE("visitor: a choice is shown as it is and becomes the word that was found", "[scenes]") {
  enum class Fruit { apple, pear, plum };
  for (const int index : {0, 1, 2}) {
    Choosing visitor(index);
    Fruit fruit = Fruit::pear;
    choice(visitor, "fruit", fruit, {"apple", "pear", "plum"});
    CHECK(visitor.shown == "pear");
    CHECK(fruit == Fruit(index));
  }
}

}  // namespace fluidtex::scenes
