// scenes/README.md against the schema.
#include "scenes/schema.h"
#include "tests/scenes/full_scene.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <map>
#include <sstream>

namespace fluidtex::scenes {

namespace {

// A row of one of the guide's tables of keys.
struct GuideRow {
  std::string section;  // "domain", "texture.surface", "liquid"; "shape" for the shapes; empty for the whole
  std::string key;
  std::vector<std::string> cells;  // without the blanks around them
};

// Heads: ## `[domain]` or ## `[[liquid]]`: ...; rows: | `key` | type | `default` | what it is |
std::vector<GuideRow> guideRows() {
  std::istringstream guide(textOf(FLUIDTEX_SOURCE_DIR "/scenes/README.md"));
  std::vector<GuideRow> rows;
  std::string section;
  for (std::string line; std::getline(guide, line);) {
    if (line.starts_with("##")) {
      section = line.substr(0, line.rfind(']') + 1);
      section = section.substr(std::min(section.find('[') + 1, section.size()));
      std::erase_if(section, [](char c) { return c == '[' || c == ']'; });
      if (line == "## Shapes") section = "shape";
    }
    if (!line.starts_with("| `")) continue;
    GuideRow row{section, "", {}};
    std::istringstream stream(line.substr(1));
    for (std::string cell; std::getline(stream, cell, '|');) {
      cell.erase(0, cell.find_first_not_of(' '));
      cell.erase(cell.find_last_not_of(' ') + 1);
      row.cells.push_back(cell);
    }
    row.key = row.cells[0].substr(1, row.cells[0].size() - 2);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

TEST_CASE("scene: the guide tells every key in its own table, and no other", "[scenes]") {
  // Keys that the guide tells elsewhere: those inside shapes, and the quality, which is no key of a file.
  const auto elsewhere = [](const std::string& key) {
    const auto inside = [&](const std::string& shape) {
      return ("." + key + ".").find("." + shape + ".") != key.npos;
    };
    return key == "quality" || std::any_of(kShapeKeys.begin(), kShapeKeys.end(), inside);
  };
  std::set<std::string> keys;
  collectKeys(Json::parse(sceneOf(kFullScene).resolved), "", keys);
  std::erase_if(keys, elsewhere);
  std::set<std::string> told;
  for (const GuideRow& row : guideRows())
    if (row.section != "shape") told.insert(row.section.empty() ? row.key : row.section + "." + row.key);
  CHECK(keys.size() > 50);
  CHECK(told == keys);
}

TEST_CASE("scene: the guide tells every shape and what is inside it", "[scenes]") {
  std::map<std::string, std::string> shapes;
  for (const GuideRow& row : guideRows())
    if (row.section == "shape") shapes[row.key] = row.cells[1];
  const std::map<std::string, std::vector<std::string>> inside = {
      {"box", {"min", "max"}},
      {"sphere", {"center", "radius"}},
      {"union", {}},
      {"half_space", {"point", "normal"}},
      {"difference", {}},
      {"mesh", {"file", "scale", "translate"}},
      {"mesh_sequence", {"files", "first", "last", "frame_rate", "start", "scale", "translate"}},
      {"cylinder", {"from", "to", "radius"}},
      {"height_field", {"file", "pixel", "low", "high", "translate"}}};
  CHECK(shapes.size() == kShapeKeys.size());
  for (const std::string& shape : kShapeKeys) {
    INFO(shape);
    REQUIRE(shapes.contains(shape));
    for (const std::string& key : inside.at(shape))
      CHECK_THAT(shapes[shape], Catch::Contains(std::string("`").append(key).append("`")));
  }
}

TEST_CASE("scene: the guide's defaults are the ones that are used", "[scenes]") {
  const std::string box = "box = { min = [0, 0, 0], max = [1, 1, 1] }\n";
  const Json resolved = Json::parse(sceneOf(kGoodScene + "[[solid]]\nmesh = { file = 'm.obj' }\n" +
                                            "keyframe = [ { time = 1 } ]\n[[source]]\n" + box +
                                            "rate = [ { time = 0, factor = 1 } ]\n[[drain]]\n" + box +
                                            "[[wall]]\n[[texture.map]]\nname = 'height'\nfile = 'e.png'\n")
                                        .resolved);
  int compared = 0;
  for (const GuideRow& row : guideRows()) {
    if (row.cells.size() != 4 || !row.cells[2].starts_with("`")) continue;
    const Json expected = Json::parse(row.cells[2].substr(1, row.cells[2].size() - 2), nullptr, false);
    if (expected.is_discarded()) continue;  // told in words
    INFO(row.section << " " << row.key);
    Json table = resolved;
    std::istringstream parts(row.section);
    for (std::string part; std::getline(parts, part, '.');) {
      REQUIRE(table.contains(part));
      table = Json(table[part].is_array() ? table[part][0] : table[part]);
    }
    REQUIRE(table.contains(row.key));
    CHECK(table[row.key] == expected);
    ++compared;
  }
  CHECK(compared > 40);
}

TEST_CASE("scene: the guide's smallest scene is read", "[scenes]") {
  const std::string guide = textOf(FLUIDTEX_SOURCE_DIR "/scenes/README.md");
  const std::size_t start = guide.find("```toml\n") + 8;
  std::string text = guide.substr(start, guide.find("```", start) - start);
  text.replace(text.find("exemplars/green_scales.png"), 26, "e.png");
  CHECK(faultsOf(text).empty());
}

}  // namespace fluidtex::scenes
