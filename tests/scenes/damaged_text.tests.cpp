#include "scenes/faults.h"
#include "tests/scenes/repeated.h"
#include "tests/scenes/scene_file.h"

#include <catch2/catch.hpp>

#include <chrono>

using namespace fluidtex::scenes;
using Catch::Matchers::Contains;

namespace {

// The faults come within seconds and are lines that can be read.
std::vector<std::string> soonFaultsOf(const std::string& text, const Overrides& overrides = {}) {
  const auto start = std::chrono::steady_clock::now();
  const std::vector<std::string> faults = faultsOf(text, overrides);
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(10));
  CHECK_FALSE(faults.empty());
  CHECK(faults.size() <= Faults::kMost + 1);
  for (const std::string& fault : faults) {
    CHECK(fault.size() < 3000);
    CHECK(std::none_of(fault.begin(), fault.end(), [](unsigned char letter) { return letter < ' '; }));
  }
  return faults;
}

std::vector<std::string> faultsOfSetting(const std::string& assignment) {
  Overrides overrides;
  overrides.set = {assignment};
  return soonFaultsOf(kGoodScene, overrides);
}

}  // namespace

TEST_CASE("damaged text: keys of very many parts are refused at their place", "[scenes]") {
  const std::string deep = repeated("a.", 10000) + "a";
  for (const std::string& text : {deep + " = 1", "[" + deep + "]", "[[" + deep + "]]",
                                  "x = { " + deep + " = 1 }", "[quality.preview]\n" + deep + " = 1"}) {
    const std::vector<std::string> faults = soonFaultsOf(kGoodScene + text);
    REQUIRE(faults.size() == 1);
    CHECK_THAT(faults[0], Contains("nested more than 64 deep"));
  }
  CHECK_THAT(soonFaultsOf(kGoodScene + "\"" + deep + "\" = 1")[0], Contains("nested more than 64 deep"));
  CHECK_THAT(faultsOfSetting(deep + "=1")[0], Contains("nested more than 64 deep"));
  CHECK_THAT(faultsOfSetting("a={ " + deep + " = 1 }")[0], Contains("nested more than 64 deep"));
  // Half a million levels, and brackets and dots together.
  soonFaultsOf(repeated("a.", 500000) + "a = 1");
  soonFaultsOf("a = " + repeated("{ b.c.d.e.f.g.h = ", 200) + "1" + repeated(" }", 200));
  soonFaultsOf("a = " + repeated("[", 100000));
}

TEST_CASE("damaged text: what is very long is told shortened, and no name is guessed for it", "[scenes]") {
  const std::string much(1 << 20, 'k');
  CHECK_THAT(soonFaultsOf(kGoodScene + much + " = 1")[0], Contains("unknown key") && Contains(" ... "));
  CHECK_THAT(faultsOfSetting(much + "=1")[0], Contains("unknown key") && Contains(" ... "));
  soonFaultsOf(kGoodScene + "name = '" + much + "'");
  soonFaultsOf(kGoodScene + "texture.method = '" + much + "'");
  soonFaultsOf("texture.exemplar = '" + much + "'\ndomain.size = [2, 1, 1]");
  soonFaultsOf(kGoodScene + "[[solid]]\nmesh_sequence = { file = '" + much + "%d.obj' }");
  soonFaultsOf(kGoodScene + "frames = " + std::string(1 << 20, '9'));
  faultsOfSetting("frames=\"" + much + "\"");
  faultsOfSetting("texture.method=\x1b[2Jred\x07");
}

TEST_CASE("damaged text: very many keys, members and faults end soon", "[scenes]") {
  std::string keys, members;
  for (int i = 0; i < 200000; ++i) keys += repeated("k", 1) + std::to_string(i) + " = 1\n";
  for (int i = 0; i < 100000; ++i) members += "[[liquid]]\nx = 1\n";
  CHECK_THAT(soonFaultsOf(keys + kGoodScene)[0], Contains("keys in one table"));
  CHECK_THAT(soonFaultsOf(kGoodScene + members)[0], Contains("members in one list"));
  soonFaultsOf(kGoodScene + "texture.windows = [" + repeated("'a', ", 5000) + "1]");
  std::string some;
  for (int i = 0; i < 900; ++i) some += repeated("k", 1) + std::to_string(i) + " = 1\n";
  CHECK_THAT(soonFaultsOf(some + kGoodScene).back(), Contains("there may be more faults"));
  CHECK_THAT(soonFaultsOf(std::string(5 << 20, '#'))[0], Contains("larger than 4 MB"));
}
