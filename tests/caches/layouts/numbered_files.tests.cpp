#include "caches/layouts/numbered_files.h"

#include "tests/caches/layouts/folder_files.h"

using namespace fluidtex::caches;
using Catch::Matchers::Contains;

namespace {

std::vector<int> numbersOf(const NumberedFiles& files) {
  std::vector<int> result;
  for (const auto& [number, file] : files.byNumber) result.push_back(number);
  return result;
}

NumberedName split(const std::string& name) {
  NumberedName result;
  REQUIRE(splitName(name, result));
  return result;
}

}  // namespace

TEST_CASE("numbered_files: the number is the last one before the ending", "[caches]") {
  CHECK(split("water_0012.vdb") == NumberedName{"water_", ".vdb", 12});
  CHECK(split("water2_0012.bobj.gz") == NumberedName{"water2_", ".bobj.gz", 12});
  CHECK(split("water_0012.bgeo.sc") == NumberedName{"water_", ".bgeo.sc", 12});
  CHECK(split("000123.bobj") == NumberedName{"", ".bobj", 123});
  CHECK(split("7.gz") == NumberedName{"", ".gz", 7});
  CHECK(split("surface.0012.vdb") == NumberedName{"surface.", ".vdb", 12});
  CHECK(split("surface.0012.gz") == NumberedName{"surface.", ".gz", 12});
  CHECK(split("surface.0012.mesh.ply") == NumberedName{"surface.", ".mesh.ply", 12});
  CHECK(split("take 3 & more-005 final.ply") == NumberedName{"take 3 & more-", " final.ply", 5});
  CHECK(split("wasser_\xc3\xa4_09.obj") == NumberedName{"wasser_\xc3\xa4_", ".obj", 9});
  CHECK(split("a999999999.ply").number == 999999999);
  NumberedName none;
  for (const char* name : {"water.vdb", "water.mp4", "water", ".vdb", "", "a1234567890.ply"}) {
    INFO(name);
    CHECK_FALSE(splitName(name, none));
  }
}

TEST_CASE("numbered_files: what is a pattern", "[caches]") {
  for (const char* name : {"w_####.vdb", "w#.ply", "w_%04d.vdb", "%d.ply", "w%4d.ply", "100%_%03d.ply"}) {
    INFO(name);
    CHECK(isPattern(fs::path("some") / name));
  }
  for (const char* name : {"w_0001.vdb", "w_%04f.vdb", "w%.ply", "100%", ""}) {
    INFO(name);
    CHECK_FALSE(isPattern(fs::path("so####me") / name));
  }
}

TEST_CASE("numbered_files: files of a pattern, padded or not", "[caches]") {
  const Scratch scratch;
  for (const char* name : {"w_8.ply", "w_9.ply", "w_10.ply", "w_0011.ply", "w_x.ply", "w_.ply", "w_12.obj",
                           "v_13.ply", "w_14.ply.gz", "w_1x5.ply"})
    writeFile(scratch.path / name);
  fs::create_directory(scratch.path / "w_20.ply");
  for (const char* pattern : {"w_####.ply", "w_#.ply", "w_%04d.ply", "w_%d.ply", "w_9.ply", "w_0011.ply"}) {
    INFO(pattern);
    const NumberedFiles files = numberedLike(scratch.path / pattern);
    CHECK(numbersOf(files) == std::vector{8, 9, 10, 11});
    CHECK(files.pattern == scratch.path / "w_####.ply");
    CHECK(files.at(11) == scratch.path / "w_0011.ply");
    CHECK(files.first() == 8);
    CHECK(files.last() == 11);
  }
  CHECK(numbersOf(numberedLike(scratch.path / "w_##.ply.gz")) == std::vector{14});
}

TEST_CASE("numbered_files: files whose names hold what patterns are made of", "[caches]") {
  const Scratch scratch;
  for (const char* name : {"take #2 (%d)_01.ply", "take #2 (%d)_02.ply"}) writeFile(scratch.path / name);
  CHECK(numbersOf(numberedLike(scratch.path / "take #2 (%d)_01.ply")) == std::vector{1, 2});
  CHECK(numbersOf(numberedLike(scratch.path / "take #2 (%d)_##.ply")) == std::vector{1, 2});
}

TEST_CASE("numbered_files: a file without a number is a sequence of one", "[caches]") {
  const Scratch scratch;
  writeFile(scratch.path / "water.ply");
  writeFile(scratch.path / "water_1.ply");
  CHECK(numbersOf(numberedLike(scratch.path / "water.ply")) == std::vector{1});
  CHECK(numberedLike(scratch.path / "water.ply").at(1) == scratch.path / "water.ply");
}

TEST_CASE("numbered_files: empty files count", "[caches]") {
  const Scratch scratch;
  writeFile(scratch.path / "a_1.ply", "");
  writeFile(scratch.path / "a_2.ply");
  CHECK(numbersOf(numberedLike(scratch.path / "a_#.ply")) == std::vector{1, 2});
}

TEST_CASE("numbered_files: two files of one number", "[caches]") {
  const Scratch scratch;
  for (const char* name : {"a_1.ply", "a_01.ply", "b_1.ply"}) writeFile(scratch.path / name);
  const std::string sentence = refusal([&] { numberedLike(scratch.path / "a_#.ply"); });
  CHECK_THAT(sentence, Contains("a_01.ply") && Contains("a_1.ply") && Contains("both number 1"));
  CHECK(numbersOf(numberedLike(scratch.path / "b_#.ply")) == std::vector{1});
}

TEST_CASE("numbered_files: what is missing is named, and what is there", "[caches]") {
  const Scratch scratch;
  for (const char* name : {"a_3.ply", "a_7.ply"}) writeFile(scratch.path / name);
  const NumberedFiles files = numberedLike(scratch.path / "a_3.ply");
  CHECK_THAT(refusal([&] { files.at(5); }),
             Contains("a_####.ply") && Contains("number 5 is missing (3 is there, and then 7)"));
  CHECK_THAT(refusal([&] { files.at(8); }), Contains("number 8 is missing (7 is there)"));
  CHECK_THAT(refusal([&] { files.at(1); }), Contains("number 1 is missing (3 is the first)"));
}

TEST_CASE("numbered_files: nothing there", "[caches]") {
  const Scratch scratch;
  CHECK_THAT(refusal([&] { numberedLike(scratch.path / "a_####.ply"); }),
             Contains("no file of this pattern"));
  CHECK_THAT(refusal([&] { numberedLike(scratch.path / "a.ply"); }), Contains("no such file"));
  CHECK_THAT(refusal([&] { numberedLike(scratch.path / "none" / "a_####.ply"); }),
             Contains("cannot be listed"));
  CHECK(sequencesIn(scratch.path).empty());
  CHECK_THAT(refusal([&] { sequencesIn(scratch.path / "none"); }), Contains("cannot be listed"));
}

TEST_CASE("numbered_files: sequences in a folder", "[caches]") {
  const Scratch scratch;
  for (const char* name : {"a_1.ply", "a_2.ply", "b_2.vdb", ".a_3.ply", "notes.txt"})
    writeFile(scratch.path / name);
  writeFile(scratch.path / "below" / "c_1.ply");
  const std::vector<NumberedFiles> sequences = sequencesIn(scratch.path);
  REQUIRE(sequences.size() == 2);
  CHECK(sequences[0].pattern == scratch.path / "a_####.ply");
  CHECK(numbersOf(sequences[0]) == std::vector{1, 2});
  CHECK(sequences[1].pattern == scratch.path / "b_####.vdb");
}
