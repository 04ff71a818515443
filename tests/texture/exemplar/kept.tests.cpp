#include "texture/exemplar/kept.h"

#include "tests/scratch.h"
#include "texture/exemplar/build_id.h"

#include <catch2/catch.hpp>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <chrono>
#include <set>

using namespace fluidtex::texture;
namespace fs = std::filesystem;

namespace {

std::vector<char> bytesOf(const std::string& text) {
  return {text.begin(), text.end()};
}

// What was written, without the hash at its end.
std::string textOf(const std::optional<KeptBytes>& kept) {
  REQUIRE(kept);
  REQUIRE(kept->size >= sizeof(XXH64_hash_t));
  return {kept->data.get(), kept->size - sizeof(XXH64_hash_t)};
}

}  // namespace

TEST_CASE("table cache: another build has files of its own") {
  // 64 hexadecimal digits: of the sources, the compiler and its settings.
  CHECK(buildId().size() == 64);
  CHECK(buildId().find_first_not_of("0123456789abcdef") == std::string_view::npos);
  // What the hash is made of; were the build left out, it would be this one.
  const std::int64_t settings[] = {1, 2};
  const std::vector<float> data{1.0f};
  const std::span<const float> parts[] = {data};
  XXH3_state_t state;
  XXH3_128bits_reset_withSeed(&state, XXH3_64bits(settings, sizeof settings));
  XXH3_128bits_update(&state, buildId().data(), buildId().size());
  const std::uint64_t size = 1;
  XXH3_128bits_update(&state, &size, sizeof size);
  XXH3_128bits_update(&state, data.data(), sizeof(float));
  const XXH128_hash_t hash = XXH3_128bits_digest(&state);
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  CHECK(keptName(".kind", settings, parts) == std::string(text) + ".kind");
}

TEST_CASE("kept: whatever differs, or is divided otherwise, has another name") {
  std::set<std::string> names;
  const auto add = [&](const std::string& kind, const std::vector<std::int64_t>& settings,
                       const std::vector<std::vector<float>>& data) {
    const std::vector<std::span<const float>> parts(data.begin(), data.end());
    const std::string name = keptName(kind, settings, parts);
    CHECK(keptName(kind, settings, parts) == name);
    CHECK(name.size() == 32 + kind.size());
    CHECK(name.substr(0, 32).find_first_not_of("0123456789abcdef") == std::string::npos);
    CHECK(name.substr(32) == kind);
    names.insert(name);
  };
  add(".table", {1, 2}, {{1.0f, 2.0f}, {3.0f}});
  add(".match", {1, 2}, {{1.0f, 2.0f}, {3.0f}});
  add(".table", {2, 1}, {{1.0f, 2.0f}, {3.0f}});
  add(".table", {1}, {{1.0f, 2.0f}, {3.0f}});
  add(".table", {1, 2}, {{1.0f}, {2.0f, 3.0f}});
  add(".table", {1, 2}, {{1.0f, 2.0f, 3.0f}});
  add(".table", {1, 2}, {{1.0f, 2.0f}, {3.0f}, {}});
  add(".table", {1, 2}, {{1.0f, 2.0f}, {-3.0f}});
  add(".table", {}, {});
  CHECK(names.size() == 9);
}

TEST_CASE("kept: what is written is read back, and no more than that is left in the folder") {
  const Scratch scratch;
  const CacheFolder folder(scratch.path / "new" / "folder",
                           [](const std::string& text) { FAIL_CHECK(text); });
  CHECK_FALSE(readKept(folder, "a.table"));
  writeKept(folder, "a.table", bytesOf("first"));
  writeKept(folder, "b.match", {});
  CHECK(textOf(readKept(folder, "a.table")) == "first");
  CHECK(textOf(readKept(folder, "b.match")).empty());
  writeKept(folder, "a.table", bytesOf("second"));
  CHECK(textOf(readKept(folder, "a.table")) == "second");
  CHECK(filesIn(folder.path) == std::vector<std::string>{"a.table", "b.match"});
}

TEST_CASE("kept: without a folder nothing is kept") {
  const Scratch scratch;
  writeKept({}, "a.table", bytesOf("text"));
  CHECK_FALSE(readKept({}, "a.table"));
  std::ofstream(scratch.path / "file") << "no folder";
  writeKept(scratch.path / "file", "a.table", bytesOf("text"));
  CHECK_FALSE(readKept(scratch.path / "file", "a.table"));
  CHECK(readBytes(scratch.path / "file") == "no folder");
}

TEST_CASE("kept: what is damaged or cut short is told once a reading, and not used") {
  const Scratch scratch;
  std::vector<std::string> told;
  const CacheFolder folder(scratch.path, [&](const std::string& text) { told.push_back(text); });
  writeKept(folder, "a.table", bytesOf("some text"));
  const fs::path file = scratch.path / "a.table";
  const std::string whole = readBytes(file);
  REQUIRE(whole.size() == 9 + 8);
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::string changed = whole;
    changed[i] = char(changed[i] ^ 4);
    for (const std::string& bytes : {changed, whole.substr(0, i), whole + whole.substr(0, i + 1)}) {
      told.clear();
      std::ofstream(file, std::ios::binary) << bytes;
      CHECK_FALSE(readKept(folder, "a.table"));
      REQUIRE(told.size() == 1);
      CHECK_THAT(told[0], Catch::Matchers::StartsWith(file.string() + " is damaged"));
      CHECK_FALSE(readKept(scratch.path, "a.table"));  // whom nobody listens to
    }
  }
  std::ofstream(file, std::ios::binary) << whole;
  CHECK(textOf(readKept(folder, "a.table")) == "some text");
  CHECK(told.size() == 1);
}

TEST_CASE("kept: beyond the limit, what was not used for longest goes") {
  const Scratch scratch;
  const CacheFolder folder(scratch.path);
  writeKept(folder, "used.table", bytesOf("read again and again"));
  const auto now = fs::file_time_type::clock::now();
  const auto grown = [&](const char* name, std::uintmax_t bytes, int hours) {
    std::ofstream(scratch.path / name) << "x";
    fs::resize_file(scratch.path / name, bytes);  // takes no space where nothing is written
    fs::last_write_time(scratch.path / name, now - std::chrono::hours(hours));
  };
  grown("oldest.match", kCacheBytes / 2, 300);
  grown("older.table", kCacheBytes / 4, 200);
  grown("recent.table", kCacheBytes / 2, 1);
  grown("of_others.txt", kCacheBytes, 900);
  fs::last_write_time(scratch.path / "used.table", now - std::chrono::hours(1000));
  CHECK(textOf(readKept(folder, "used.table")) == "read again and again");
  writeKept(folder, "new.table", bytesOf("the last straw"));
  CHECK(filesIn(scratch.path) ==
        std::vector<std::string>{"new.table", "of_others.txt", "older.table", "recent.table", "used.table"});
}

TEST_CASE("kept: values are read in the order in which they were put") {
  std::vector<char> bytes;
  const ByteWriter writer{bytes};
  writer(std::int32_t(-7));
  writer(std::vector<float>{1.5f, -2.5f});
  writer(std::vector<std::uint8_t>{});
  writer(2.25);
  CHECK(bytes.size() == 4 + 8 + 2 * 4 + 8 + 8);
  const char* at = bytes.data();
  const ByteReader reader{at};
  std::int32_t number = 0;
  std::vector<float> floats(9, 3.0f);
  std::vector<std::uint8_t> none(4);
  double last = 0.0;
  reader(number), reader(floats), reader(none), reader(last);
  CHECK(number == -7);
  CHECK(floats == std::vector<float>{1.5f, -2.5f});
  CHECK(none.empty());
  CHECK(last == 2.25);
  CHECK(at == bytes.data() + bytes.size());
}
