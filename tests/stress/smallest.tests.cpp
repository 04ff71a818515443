#include "tools/stress_scenes/smallest.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace fluidtex::stress;

namespace {

bool has(const SceneParts& parts, const std::string& part) {
  return std::find(parts.begin(), parts.end(), part) != parts.end();
}

}  // namespace

TEST_CASE("smallest: what is left are the parts without which it would not fail, in their order",
          "[stress]") {
  const SceneParts parts = {"head", "a", "b", "c", "d", "e"};
  const auto both = [](const SceneParts& some) { return has(some, "b") && has(some, "e"); };
  CHECK(smallest(parts, both) == SceneParts{"head", "b", "e"});
  const auto never = [](const SceneParts&) { return false; };
  CHECK(smallest(parts, never) == parts);
  // The first is never left out.
  const auto always = [](const SceneParts&) { return true; };
  CHECK(smallest(parts, always) == SceneParts{"head"});
  CHECK(smallest({"head"}, never) == SceneParts{"head"});
  CHECK(smallest({}, always).empty());
}

TEST_CASE("smallest: of two that would do alone, the earlier stays, and each part is tried once",
          "[stress]") {
  std::vector<SceneParts> tried;
  const SceneParts left = smallest({"head", "a", "b", "c"}, [&](const SceneParts& some) {
    tried.push_back(some);
    return has(some, "a") || has(some, "c");
  });
  CHECK(left == SceneParts{"head", "a"});
  CHECK(tried == std::vector<SceneParts>{{"head", "a", "b"}, {"head", "a"}, {"head"}});
}
