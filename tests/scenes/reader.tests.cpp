#include "scenes/reader.h"

#include <catch2/catch.hpp>

#include <limits>

namespace fluidtex::scenes {

namespace {

// A text to be read, in the folder scenes/set.
struct ReadText {
  Faults faults;
  Node document;
  Reader reader;

  explicit ReadText(const std::string& text)
      : document(readDocument(text, "s.toml", faults)), reader(document, "scenes/set", faults) {
    REQUIRE(faults.empty());
  }
  void override(const std::string& assignment) {
    overlay(document, readAssignment(assignment, 1, faults), faults);
  }
};

}  // namespace

TEST_CASE("reader: what is faulty or missing leaves the value as it was", "[scenes]") {
  ReadText text("a = 5\nb = 'x'\nc = 2.5\nd = [1, 2]\ne = [1, 2, nan]\nf = 'magic'\ng = [640, 0]\nh = ''\n");
  int a = 1, b = 2, none = 3, width = 4, height = 5, word = 1;
  double c = 6.0;
  Vec3d d(7.0), e(8.0);
  std::string h = "kept";
  text.reader.integer("a", a, {.high = 4.0}, Need::optional);
  text.reader.integer("b", b, kAny, Need::optional);
  text.reader.number("c", c, kShare, Need::optional);
  text.reader.vector("d", d, kAny, Need::optional);
  text.reader.vector("e", e, kAny, Need::optional);
  text.reader.choice("f", word, {"no", "yes"});
  text.reader.pixels("g", width, height, kPositive);
  text.reader.text("h", h);
  text.reader.integer("none", none, kAny, Need::required);
  CHECK(text.faults.all().size() == 9);
  CHECK((a == 1 && b == 2 && none == 3 && width == 4 && height == 5 && word == 1));
  CHECK(c == 6.0);
  CHECK(d == Vec3d(7.0));
  CHECK(e == Vec3d(8.0));
  CHECK(h == "kept");
}

TEST_CASE("reader: values are taken up to their limits, whole numbers as decimal ones too", "[scenes]") {
  ReadText text("a = 4\nb = 3\nseed = 9223372036854775807\nlist = [1, 4]\nforever = inf\nflag = true\n");
  int a = 0;
  double b = 0.0, forever = 0.0;
  std::uint64_t seed = 0;
  std::vector<int> list;
  bool flag = false;
  text.reader.integer("a", a, {.low = 4.0, .high = 4.0}, Need::optional);
  text.reader.number("b", b, {.low = 3.0, .high = 3.0}, Need::optional);
  text.reader.seed("seed", seed);
  text.reader.integers("list", list, {.low = 1.0, .high = 4.0});
  text.reader.number("forever", forever, {.infinite = true}, Need::optional);
  text.reader.flag("flag", flag);
  CHECK(text.faults.empty());
  CHECK(a == 4);
  CHECK(b == 3.0);
  CHECK(seed == std::uint64_t(std::numeric_limits<std::int64_t>::max()));
  CHECK(list == std::vector<int>{1, 4});
  CHECK(forever == std::numeric_limits<double>::infinity());
  CHECK(flag);
}

TEST_CASE("reader: names are as long as a file's can be", "[scenes]") {
  for (const int length : {200, 201}) {
    ReadText text("name = '" + std::string(std::size_t(length), 'n') + "'\n");
    std::string name;
    text.reader.text("name", name);
    CHECK(text.faults.empty() == (length == 200));
    CHECK(name.size() == (length == 200 ? 200 : 0));
  }
}

TEST_CASE("reader: files are found from the scene's folder, those of the command line from here",
          "[scenes]") {
  const auto placeOf = [](bool commandLine) {
    ReadText text("path = '../cache/./liquid'\n");
    if (commandLine) text.override("path=../cache/./liquid");
    std::filesystem::path path;
    text.reader.path("path", path);
    CHECK(text.faults.empty());
    return path;
  };
  CHECK(placeOf(false) == "scenes/cache/liquid");
  CHECK(placeOf(true) == "../cache/liquid");
  ReadText none("");
  std::filesystem::path path = "kept";
  none.reader.path("path", path);
  CHECK(none.faults.empty());
  CHECK(path == "kept");
}

TEST_CASE("reader: endings of files count in capitals too", "[scenes]") {
  const SceneFolder folder;
  folder.write("ROCK.OBJ", "");
  ReadText text("a = '" + (folder.path() / "ROCK.OBJ").string() + "'\nb = 'rock_%04d.Obj'\n");
  std::filesystem::path file, files;
  text.reader.file("a", file, {".ply", ".obj"});
  text.reader.files("b", files, {".ply", ".obj"});
  CHECK(text.faults.empty());
  CHECK(file == folder.path() / "ROCK.OBJ");
  CHECK(files == "scenes/set/rock_%04d.Obj");
}

TEST_CASE("reader: of keys that exclude each other the one that was written first is taken", "[scenes]") {
  const std::vector<std::string> keys = {"box", "sphere", "mesh"};
  ReadText both("mesh = 1\nbox = 2\n"), none("x = 1\n");
  CHECK(both.reader.alternative(1, keys, Need::required) == 2);
  REQUIRE(both.faults.all().size() == 1);
  CHECK(both.faults.all()[0].key == "box");
  CHECK(both.faults.all()[0].message == "given besides mesh; give only one of box, sphere and mesh");
  CHECK(none.reader.alternative(1, keys, Need::optional) == 1);
  CHECK(none.faults.empty());
  CHECK(none.reader.alternative(1, keys, Need::required) == -1);
  CHECK(none.faults.all().size() == 1);
}

TEST_CASE("reader: nothing is asked for inside of what is no table, or was left out", "[scenes]") {
  ReadText text("a = 3\nlist = [ 3, { x = 1 } ]\n");
  int x = 0;
  for (const char* key : {"a", "none"})
    text.reader.table(key, [&] {
      text.reader.integer("x", x, kAny, Need::required);
      text.reader.enter("deeper", Need::required);
      text.reader.integer("y", x, kAny, Need::required);
      text.reader.leave();
    });
  std::vector<int> members;
  text.reader.list("list", members,
                   [&](int& member) { text.reader.integer("x", member, kAny, Need::required); });
  text.reader.reportUnknownKeys();
  CHECK(members == std::vector<int>{0, 1});
  REQUIRE(text.faults.all().size() == 2);
  CHECK(text.faults.all()[0].key == "a");
  CHECK(text.faults.all()[1].key == "list.0");
  // What is required is asked for by its full name.
  text.reader.table(
      "none", [&] { text.reader.integer("x", x, kAny, Need::required); }, Need::required);
  REQUIRE(text.faults.all().size() == 3);
  CHECK(text.faults.all()[2].key == "none.x");
}

TEST_CASE("reader: whether a key was given, and where, is told for any path", "[scenes]") {
  ReadText text("[domain]\nsize = 1\n[[liquid]]\nbox.min = 2\n[[liquid]]\n");
  for (const char* path : {"domain", "domain.size", "liquid", "liquid.0", "liquid.0.box.min", "liquid.1"})
    CHECK(text.reader.given(path));
  for (const char* path : {"size", "domain.sides", "domain.size.0", "liquid.2", "liquid.1.box", "liquid.x"})
    CHECK_FALSE(text.reader.given(path));
  const auto whereOf = [&](const std::string& path) { return text.reader.originOf(path).where; };
  CHECK(whereOf("liquid.0.box.min") == "s.toml:4:5");
  CHECK(whereOf("liquid.0.box.max") == "s.toml:4:1");
  CHECK(whereOf("liquid.0.sphere.radius") == "s.toml:3:1");
  CHECK(whereOf("domain.sides.x_low") == "s.toml:1:2");
  CHECK(whereOf("camera.from") == "s.toml:1:1");
  text.reader.fault("liquid.0.box.max", "is wrong", "mend it");
  CHECK(text.faults.lines() ==
        std::vector<std::string>{"s.toml:4:1: error: liquid.0.box.max: is wrong; mend it"});
  CHECK_FALSE(text.reader.clean("liquid"));
  CHECK(text.reader.clean("liquid.1"));
}

TEST_CASE("reader: a key is known once it was asked for, or is named as absent", "[scenes]") {
  ReadText text("a = 1\nb = 2\nc = 3\nd = 4\n");
  int value = 0;
  text.reader.integer("a", value, kAny, Need::optional);
  text.reader.absent("b");
  text.reader.alternative(0, {"c", "e"}, Need::optional);
  text.reader.reportUnknownKeys();
  REQUIRE(text.faults.all().size() == 1);
  CHECK(text.faults.all()[0].key == "d");
}

}  // namespace fluidtex::scenes
