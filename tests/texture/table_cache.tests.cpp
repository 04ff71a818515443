#include "texture/table_cache.h"

#include "tests/scratch.h"
#include "tests/texture/test_images.h"

#include <catch2/catch.hpp>

#include <fstream>

using namespace fluidtex;
using namespace fluidtex::texture;
using namespace fluidtex::testing;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> tablesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  if (fs::exists(folder))
    for (const auto& entry : fs::directory_iterator(folder)) files.push_back(entry.path());
  return files;
}

void write(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

void checkSame(const SearchTable& a, const SearchTable& b) {
  CHECK(a.window == b.window);
  CHECK(a.channels == b.channels);
  CHECK(a.toroidal == b.toroidal);
  CHECK(a.margin == b.margin);
  CHECK(a.stride == b.stride);
  CHECK(a.falloff == b.falloff);
  CHECK(a.basis.component == b.basis.component);
  CHECK(a.basis.offset == b.basis.offset);
  CHECK(a.basis.mean == b.basis.mean);
  CHECK(a.tree.firstBlock == b.tree.firstBlock);
  CHECK(a.tree.index == b.tree.index);
  CHECK(a.tree.codes.low == b.tree.codes.low);
  CHECK(a.tree.codes.step == b.tree.codes.step);
  CHECK(a.tree.codes.fine == b.tree.codes.fine);
  CHECK(a.tree.codes.coarse == b.tree.codes.coarse);
  CHECK(a.tree.leafMean == b.tree.leafMean);
  CHECK(a.similarCount == b.similarCount);
  CHECK(a.similar == b.similar);
}

}  // namespace

TEST_CASE("table cache: what is read back is what was built, in one file") {
  const Scratch scratch;
  const fs::path folder = scratch.path / "a" / "b";
  const Image image = blobImage(40, 36, 3, 8.0, 1);
  const bool toroidal = GENERATE(false, true);
  const SearchTable built = cachedSearchTable(image, toroidal, 9, 1, 4, {});
  CHECK(tablesIn(folder).empty());
  checkSame(cachedSearchTable(image, toroidal, 9, 1, 4, folder), built);
  REQUIRE(tablesIn(folder).size() == 1);
  const std::string bytes = readBytes(tablesIn(folder)[0]);
  checkSame(cachedSearchTable(image, toroidal, 9, 1, 4, folder), built);
  CHECK(tablesIn(folder).size() == 1);
  CHECK(readBytes(tablesIn(folder)[0]) == bytes);
}

TEST_CASE("table cache: the file is what is used, and whatever differs has one of its own") {
  const Scratch scratch;
  const Image image = blobImage(40, 36, 3, 8.0, 1);
  cachedSearchTable(image, false, 9, 1, 4, scratch.path);
  cachedSearchTable(image, true, 9, 1, 4, scratch.path);
  cachedSearchTable(image, false, 7, 1, 4, scratch.path);
  cachedSearchTable(image, false, 9, 2, 4, scratch.path);
  cachedSearchTable(image, false, 9, 1, 0, scratch.path);
  CHECK(tablesIn(scratch.path).size() == 5);
  Image other = image;
  other.data[100] += 0.01f;
  cachedSearchTable(other, false, 9, 1, 4, scratch.path);
  CHECK(tablesIn(scratch.path).size() == 6);
  // A table under another's name would be believed.
  const std::vector<fs::path> files = tablesIn(scratch.path);
  for (const fs::path& file : files) write(file, readBytes(files[0]));
  const SearchTable first = cachedSearchTable(image, false, 9, 1, 4, scratch.path),
                    second = cachedSearchTable(image, true, 9, 1, 4, scratch.path);
  CHECK(first.tree.index == second.tree.index);
}

TEST_CASE("table cache: a damaged file is ignored and replaced, cut short anywhere or changed anywhere") {
  const Scratch scratch;
  const Image image = blobImage(24, 24, 3, 8.0, 1);
  const SearchTable built = cachedSearchTable(image, false, 7, 1, 2, scratch.path);
  const fs::path file = tablesIn(scratch.path)[0];
  const std::string whole = readBytes(file);
  const std::size_t step = whole.size() / 23;
  for (std::size_t i = 0; i < whole.size(); i += step) {
    write(file, whole.substr(0, i));
    checkSame(cachedSearchTable(image, false, 7, 1, 2, scratch.path), built);
    CHECK(readBytes(file) == whole);
    std::string changed = whole;
    changed[i] = char(changed[i] ^ 1);
    write(file, changed);
    checkSame(cachedSearchTable(image, false, 7, 1, 2, scratch.path), built);
    CHECK(readBytes(file) == whole);
  }
}

TEST_CASE("table cache: where nothing can be written nothing is kept, and nothing fails") {
  const Scratch scratch;
  write(scratch.path / "file", "");
  const Image image = blobImage(24, 24, 3, 8.0, 1);
  checkSame(cachedSearchTable(image, false, 7, 1, 0, scratch.path / "file" / "in"),
            cachedSearchTable(image, false, 7, 1, 0, {}));
}
