#include "scenes/document.h"

#include "tests/scenes/fault_cases.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <stdexcept>

namespace fluidtex::scenes {

namespace {

// What lies at a dotted path that is there; members of lists by number.
const Node& at(const Node& node, const std::string& path) {
  const std::size_t dot = std::min(path.find('.'), path.size());
  const std::string part = path.substr(0, dot);
  const List* list = std::get_if<List>(&node.value);
  const Entry* entry = list ? nullptr : find(std::get<Table>(node.value), part);
  if (!list && !entry) throw std::out_of_range(path);
  const Node& inner = list ? list->at(std::stoul(part)) : entry->node;
  return dot == path.size() ? inner : at(inner, path.substr(dot + 1));
}

}  // namespace

TEST_CASE("scene faults: no TOML", "[scenes]") {
  const auto startsWith = [](const std::string& text, const std::string& start) {
    const std::vector<std::string> faults = faultsOf(text);
    INFO(text);
    REQUIRE(faults.size() == 1);
    CHECK_THAT(faults[0],
               Catch::StartsWith(start) && Catch::EndsWith("; write it as in https://toml.io/en/v1.0.0"));
  };
  startsWith("frames = 3\ndomain = [1, 2\n", "s.toml:2:16: error: syntax: ");
  startsWith("frames = \n", "s.toml:1:10: error: syntax: ");
  startsWith("frames 3\n", "s.toml:1:8: error: syntax: ");
  startsWith("frames = 3\nframes = 4\n", "s.toml:2:");
  startsWith("name = 'a\n", "s.toml:1:10: error: syntax: ");
  startsWith(std::string("name = '\xff\xfe'\n"), "s.toml:1:");
  startsWith("seed = 99999999999999999999\n", "s.toml:1:");
}

TEST_CASE("scene faults: every shorter version of a file is refused or read", "[scenes]") {
  const std::string text = kGoodScene + "[quality.preview]\n'domain.resolution' = 40\n";
  int refused = 0;
  for (std::size_t length = 0; length < text.size(); ++length) {
    const std::vector<std::string> faults = faultsOf(text.substr(0, length));
    refused += faults.empty() ? 0 : 1;
    for (const std::string& fault : faults)
      CHECK_THAT(fault, Catch::StartsWith("s.toml:") && Catch::Contains(": error: "));
  }
  CHECK(refused > int(kGoodScene.size()) - 3);
}

TEST_CASE("scene faults: the scene file itself", "[scenes]") {
  const SceneFolder folder;
  const auto faultOf = [&](const std::filesystem::path& file) {
    try {
      loadScene(file);
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string right = "; give a scene file, for example scenes/dam_break.toml";
  const std::string base = folder.path().string();
  CHECK(faultOf(folder.path() / "none.toml") == base + "/none.toml:1:1: error: file: no such file" + right);
  CHECK(faultOf(folder.path()) == base + ":1:1: error: file: is a folder" + right);
  CHECK(faultOf(folder.path() / "e.png" / "s.toml") ==
        base + "/e.png/s.toml:1:1: error: file: cannot be read: Not a directory" + right);
}

TEST_CASE("document: values have the kind that they are written as", "[scenes]") {
  Faults faults;
  const Node document = readDocument(
      "a = true\nb = false\nc = 3\nd = 3.0\ne = 'x'\nf = 2001-01-01\ng = [1, 'x']\nh = { i = 1 }\n", "s.toml",
      faults);
  REQUIRE(faults.empty());
  const std::vector<std::string> kinds = {"true",     "false",          "a whole number", "a decimal number",
                                          "a string", "a date or time", "a list",         "a table"};
  const Table& table = std::get<Table>(document.value);
  REQUIRE(table.size() == kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) CHECK(kindName(table[i].node) == kinds[i]);
  CHECK(kindName(document) == "a table");
  CHECK(std::get<std::int64_t>(at(document, "c").value) == 3);
  CHECK(std::get<double>(at(document, "d").value) == 3.0);
  CHECK(std::get<List>(at(document, "g").value).size() == 2);
  CHECK(find(table, "j") == nullptr);
}

TEST_CASE("document: each value knows where it was written", "[scenes]") {
  Faults faults;
  const Node document = readDocument(
      "# head\n[domain]\n  size = [\n1, { x = 2 }]\n[[liquid]]\nvelocity = 1\n", "s.toml", faults);
  CHECK(document.origin.where == "s.toml:1:1");
  CHECK(at(document, "domain").origin.where == "s.toml:2:2");
  CHECK(at(document, "domain.size").origin.where == "s.toml:3:3");
  CHECK(at(document, "domain.size.1").origin.where == "s.toml:4:4");
  CHECK(at(document, "domain.size.1.x").origin.where == "s.toml:4:6");
  CHECK(at(document, "liquid.0").origin.where == "s.toml:5:1");
  const Origin& deep = at(document, "liquid.0.velocity").origin;
  CHECK(deep.where == "s.toml:6:1");
  CHECK(deep.line == 6);
  CHECK(deep.column == 1);
  CHECK(deep.layer == 0);
  CHECK_FALSE(deep.commandLine());
}

TEST_CASE("document: an option is a table of its one key, written at the option", "[scenes]") {
  Faults faults;
  const Node option = readAssignment(" liquid.0.velocity = [1, 2.5, 'x'] ", 3, faults);
  REQUIRE(faults.empty());
  const Node& velocity = at(option, "liquid.0.velocity");
  CHECK(std::get<double>(std::get<List>(velocity.value)[1].value) == 2.5);
  for (const Node* node : {&option, &at(option, "liquid"), &velocity, &std::get<List>(velocity.value)[2]}) {
    CHECK(node->origin.layer == 3);
    CHECK(node->origin.commandLine());
    CHECK(node->origin.where == "--set  liquid.0.velocity = [1, 2.5, 'x'] ");
  }
  // What is no value is a word; what only begins like one is a fault.
  CHECK(std::get<std::string>(at(readAssignment("a=magic word", 1, faults), "a").value) == "magic word");
  CHECK(std::get<std::string>(at(readAssignment("a=1.2.3", 1, faults), "a").value) == "1.2.3");
  CHECK(std::get<std::string>(at(readAssignment("a=\"\"", 1, faults), "a").value).empty());
  CHECK(std::get<std::string>(at(readAssignment("a=b=c", 1, faults), "a").value) == "b=c");
  CHECK(faults.empty());
  for (const char* broken : {"a=[1", "a={ b = 1", "a=\"x", "a='x"}) {
    Faults found;
    CHECK(std::get<Table>(readAssignment(broken, 1, found).value).empty());
    CHECK(found.all().size() == 1);
  }
}

TEST_CASE("document: quoted keys of several parts become tables, and join those that are there", "[scenes]") {
  Faults faults;
  const Node document = readDocument(
      "'domain.resolution' = 40\nlist = [ { 'a.b' = 1 } ]\n[domain]\nsize = 1\n", "s.toml", faults);
  const Node whole = expanded(document, "quality.preview.", faults);
  REQUIRE(faults.empty());
  CHECK(std::get<std::int64_t>(at(whole, "domain.resolution").value) == 40);
  CHECK(std::get<std::int64_t>(at(whole, "domain.size").value) == 1);
  CHECK(std::get<std::int64_t>(at(whole, "list.0.a.b").value) == 1);
  CHECK(std::get<Table>(whole.value).size() == 2);
  for (const char* path : {"domain.resolution", "domain.size", "list.0", "list.0.a.b"})
    CHECK(at(whole, path).origin.prefix == "quality.preview.");
  CHECK(at(whole, "domain.resolution").origin.where == "s.toml:1:1");
}

TEST_CASE("document: a key in two spellings is told at one of them", "[scenes]") {
  for (const char* text : {"'a.b' = 1\n[a]\nb = 2\n", "a = 1\n'a.b' = 2\n", "'a.b.c' = 1\n'a.b' = 2\n"}) {
    INFO(text);
    Faults faults;
    const Node document = readDocument(text, "s.toml", faults);
    REQUIRE(faults.empty());
    expanded(document, "", faults);
    REQUIRE(faults.all().size() == 1);
    CHECK(faults.all()[0].message == "given twice; keep one of them");
  }
}

TEST_CASE("document: overlaid tables are merged, all else is replaced", "[scenes]") {
  Faults faults;
  const auto overlaid = [&](const std::string& below, const std::string& above) {
    Node base = readDocument(below, "s.toml", faults);
    overlay(base, readDocument(above, "above", faults), faults);
    return base;
  };
  const Node merged = overlaid("[a]\nx = 1\ny = 2\n[a.b]\nz = 3\n", "[a]\ny = 'new'\nw = 5\n[a.b]\nv = 6\n");
  CHECK(std::get<std::int64_t>(at(merged, "a.x").value) == 1);
  CHECK(std::get<std::string>(at(merged, "a.y").value) == "new");
  CHECK(at(merged, "a.y").origin.where == "above:2:1");
  CHECK(at(merged, "a.x").origin.where == "s.toml:2:1");
  CHECK(std::get<std::int64_t>(at(merged, "a.w").value) == 5);
  CHECK(std::get<std::int64_t>(at(merged, "a.b.z").value) == 3);
  CHECK(std::get<std::int64_t>(at(merged, "a.b.v").value) == 6);
  // A list by another, a value by a table, a table by a value.
  CHECK(std::get<List>(at(overlaid("a = [1, 2, 3]", "a = [4]"), "a").value).size() == 1);
  CHECK(std::get<std::int64_t>(at(overlaid("a = 1", "a.b = 2"), "a.b").value) == 2);
  CHECK(std::get<std::int64_t>(at(overlaid("a.b = 2", "a = 1"), "a").value) == 1);
  CHECK(faults.empty());
}

TEST_CASE("document: a table over a list goes to its members by number", "[scenes]") {
  Faults faults;
  Node base = readDocument("a = [ { x = 1, y = 2 }, { x = 3 } ]", "s.toml", faults);
  overlay(base, readAssignment("a.1.y=7", 1, faults), faults);
  overlay(base, readAssignment("a.0.x=8", 2, faults), faults);
  CHECK(std::get<std::int64_t>(at(base, "a.0.x").value) == 8);
  CHECK(std::get<std::int64_t>(at(base, "a.0.y").value) == 2);
  CHECK(std::get<std::int64_t>(at(base, "a.1.x").value) == 3);
  CHECK(std::get<std::int64_t>(at(base, "a.1.y").value) == 7);
  REQUIRE(faults.empty());
  for (const char* wrong : {"a.2.x=1", "a.-1.x=1", "a.1x.x=1", "a.first=1"}) {
    INFO(wrong);
    Faults found;
    overlay(base, readAssignment(wrong, 1, found), found);
    REQUIRE(found.all().size() == 1);
    CHECK(found.all()[0].message == "no such member; the list's members are a.0 to a.1");
  }
  Node empty = readDocument("a = []", "s.toml", faults);
  overlay(empty, readAssignment("a.0=1", 1, faults), faults);
  REQUIRE(faults.all().size() == 1);
  CHECK(faults.all()[0].message == "no such member; the list is empty");
}

TEST_CASE("document: exclusive keys displace those below, not each other", "[scenes]") {
  const auto keysOver = [](const std::string& above) {
    Faults faults;
    Node base = readDocument("points = 5\nvelocity = 1\nsphere.radius = 1\n", "s.toml", faults);
    overlay(base, readDocument(above, "above", faults), faults);
    CHECK(faults.empty());
    std::vector<std::string> keys;
    for (const Entry& entry : std::get<Table>(base.value)) keys.push_back(entry.key);
    std::sort(keys.begin(), keys.end());
    return keys;
  };
  CHECK(keysOver("spacing = 0.1") == std::vector<std::string>{"spacing", "sphere", "velocity"});
  CHECK(keysOver("mesh.file = 'm'") == std::vector<std::string>{"mesh", "points", "velocity"});
  CHECK(keysOver("sphere.center = 0") == std::vector<std::string>{"points", "sphere", "velocity"});
  CHECK(keysOver("box = 1\nmesh = 2") == std::vector<std::string>{"box", "mesh", "points", "velocity"});
}

}  // namespace fluidtex::scenes
