#include "tools/report/scene_text.h"
#include "scenes/scene.h"

#include <toml++/toml.h>
#include <catch2/catch.hpp>

#include <sstream>

using namespace fluidtex;
using namespace fluidtex::tools;

namespace {

// The document as toml++ reads it.
Json parsed(const std::string& text) {
  std::ostringstream json;
  json << toml::json_formatter{toml::parse(text)};
  return Json::parse(json.str());
}

// Sorted, as toml++ sorts.
nlohmann::json plain(const Json& json) {
  return nlohmann::json::parse(json.dump());
}

Json withoutNulls(const Json& json) {
  if (!json.is_structured()) return json;
  Json kept = json.is_object() ? Json::object() : Json::array();
  for (const auto& [key, value] : json.items()) {
    if (value.is_null()) continue;
    if (json.is_object())
      kept[key] = withoutNulls(value);
    else
      kept.push_back(withoutNulls(value));
  }
  return kept;
}

}  // namespace

TEST_CASE("scene text: TOML with the same values, without nulls", "[tools]") {
  const Json scene = Json::parse(R"({
    "quality": "final", "frames": 3, "frame_rate": 24.5, "until": null, "title": "a \"b\" \\ \u00fc\n</script>",
    "camera": {"from": [1.0, -2.5e-07, 3.0], "turn": 0.0},
    "empty": {}, "none": [],
    "solid": [{"box": {"min": [0, 0, 0]}, "keyframe": [{"time": 1.0}, {"time": 2.0}]}, {"moves": true}],
    "after": {"x": 1}})");
  const std::string text = sceneText(scene);
  INFO(text);
  Json expected = scene;
  expected.erase("quality");
  expected.erase("until");
  CHECK(plain(parsed(text)) == plain(expected));
  CHECK(text.starts_with("# quality: final\n"));
}

TEST_CASE("scene text: scenes that ship, with every key", "[tools]") {
  for (const char* name : {"dam_break", "river", "spill"}) {
    const scenes::Scene scene = scenes::loadScene(std::string(FLUIDTEX_SOURCE "/scenes/") + name + ".toml");
    const Json resolved = Json::parse(scene.resolved);
    const std::string text = sceneText(resolved);
    INFO(text);
    Json expected = withoutNulls(resolved);
    expected.erase("quality");
    CHECK(plain(parsed(text)) == plain(expected));
  }
}
