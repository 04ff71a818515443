#include "texture/search/table_cache.h"

#include "tests/scratch.h"
#include "tests/texture/exemplar/test_images.h"

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
    std::string changed = whole;
    changed[i] = char(changed[i] ^ 1);
    for (const std::string& bytes : {whole.substr(0, i), changed}) {
      write(file, bytes);
      std::vector<std::string> warnings;
      const CacheFolder folder(scratch.path, [&](const std::string& text) { warnings.push_back(text); });
      checkSame(cachedSearchTable(image, false, 7, 1, 2, folder), built);
      REQUIRE(warnings.size() == 1);
      CHECK_THAT(warnings[0], Catch::Matchers::StartsWith(file.string()));
      CHECK(readBytes(file) == whole);
      checkSame(cachedSearchTable(image, false, 7, 1, 2, folder), built);
      CHECK(warnings.size() == 1);
    }
  }
}

TEST_CASE("table cache: where nothing can be written nothing is kept, and nothing fails") {
  const Scratch scratch;
  write(scratch.path / "file", "");
  const Image image = blobImage(24, 24, 3, 8.0, 1);
  checkSame(cachedSearchTable(image, false, 7, 1, 0, scratch.path / "file" / "in"),
            cachedSearchTable(image, false, 7, 1, 0, {}));
}

TEST_CASE(
    "table cache: what windows are matched by is kept too, and made anew from what differs or is damaged") {
  const Scratch scratch;
  const auto side = [](bool alpha) {
    Image image{40, 40, 4, blobImage(40, 40, 4, 8.0, 1).data};
    for (std::size_t i = 3; i < image.data.size(); i += 4)
      image.data[i] = alpha && i % 64 == 3 ? 0.25f : 1.0f;
    return image;
  };
  const SynthesisOptions options;
  SynthesisOptions other = options;
  other.featureWeight = 0.1;
  const Image map = blobImage(40, 40, 1, 8.0, 2);
  std::size_t files = 0;
  for (const bool alpha : {false, true})
    for (const bool toroidal : {false, true})
      for (const int levels : {1, 3})
        for (const SynthesisOptions& synthesis : {options, other})
          for (const Image& guidance : {Image{}, map}) {
            const Image image = side(alpha);
            const Exemplar plain = makeExemplar(image, toroidal, synthesis, levels, guidance);
            for (int call = 0; call < 2; ++call) {
              const Exemplar kept = makeExemplar(image, toroidal, synthesis, levels, guidance, scratch.path);
              REQUIRE(kept.match.size() == plain.match.size());
              for (std::size_t l = 0; l < plain.match.size(); ++l) {
                CHECK(kept.match[l].width == plain.match[l].width);
                CHECK(kept.match[l].channels == plain.match[l].channels);
                CHECK(kept.match[l].data == plain.match[l].data);
              }
              CHECK(kept.colorChannels == plain.colorChannels);
              CHECK(kept.guided == plain.guided);
              CHECK(kept.color.data == plain.color.data);
            }
            CHECK(tablesIn(scratch.path).size() == ++files);
          }
  const fs::path file = tablesIn(scratch.path)[0];
  for (const fs::path& each : tablesIn(scratch.path))
    if (each != file) fs::remove(each);
  const std::string whole = readBytes(file);
  write(file, "something else");
  int warnings = 0;
  const CacheFolder folder(scratch.path, [&](const std::string&) { ++warnings; });
  for (const bool alpha : {false, true})
    for (const bool toroidal : {false, true})
      for (const int levels : {1, 3})
        for (const SynthesisOptions& synthesis : {options, other})
          for (const Image& guidance : {Image{}, map})
            makeExemplar(side(alpha), toroidal, synthesis, levels, guidance, folder);
  CHECK(warnings == 1);
  CHECK(readBytes(file) == whole);
}

TEST_CASE("table cache: maps that are matched make it another image, by their pixels and weights") {
  const Scratch scratch;
  const Image color = blobImage(40, 40, 4, 8.0, 1);
  std::size_t files = 0;
  for (const std::uint64_t seed : {2u, 3u})
    for (const float weight : {0.5f, 1.0f}) {
      const std::map<std::string, ExemplarMap> maps{
          {"height", {blobImage(40, 40, 1, 8.0, seed), MapHolds::values, weight}}};
      const Exemplar plain = makeExemplar(color, false, {}, 2, {}, {}, maps);
      for (int call = 0; call < 2; ++call) {
        const Exemplar kept = makeExemplar(color, false, {}, 2, {}, scratch.path, maps);
        CHECK(kept.match[0].data == plain.match[0].data);
        CHECK(kept.match[1].data == plain.match[1].data);
        CHECK(kept.mapChannels == 1);
        CHECK(kept.mapShare == plain.mapShare);
      }
      CHECK(tablesIn(scratch.path).size() == ++files);
    }
}
