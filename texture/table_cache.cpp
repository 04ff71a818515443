#include "texture/table_cache.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <type_traits>

namespace fluidtex::texture {
namespace fs = std::filesystem;
namespace {

// To be raised whenever tables are built in another way or laid out differently.
constexpr std::uint64_t kVersion = 2;
constexpr const char* kEnding = ".table";

// All that a table depends on, in 128 bits.
std::string nameOf(const Image& match, bool toroidal, int window, std::uint64_t seed, int similar) {
  const std::int64_t settings[] = {std::int64_t(kVersion),         match.width, match.height, match.channels,
                                   std::int64_t(toroidal),         window,      similar,      kDescriptorSize,
                                   static_cast<std::int64_t>(seed)};
  const XXH64_hash_t start = XXH3_64bits(settings, sizeof settings);
  const XXH128_hash_t hash =
      XXH3_128bits_withSeed(match.data.data(), match.data.size() * sizeof(float), start);
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text;
}

// Visits every part of a table in the one order that both directions share; padded is left out, and so are coarse
// codes, which are the upper bits of the fine ones.
template <typename Table, typename Visit>
void eachPart(Table& table, const Visit& visit) {
  visit(table.window), visit(table.channels), visit(table.toroidal);
  visit(table.width), visit(table.height), visit(table.margin);
  visit(table.falloff);
  visit(table.basis.size), visit(table.basis.component), visit(table.basis.offset), visit(table.basis.mean);
  visit(table.tree.firstBlock), visit(table.tree.index);
  visit(table.tree.codes.low), visit(table.tree.codes.step), visit(table.tree.codes.fine);
  visit(table.tree.leafMean);
  visit(table.stride), visit(table.similarCount), visit(table.similar);
}

// The parts as bytes, one after the other; a vector after the number of its members.
struct Writer {
  std::vector<char>& bytes;
  void put(const void* data, std::size_t size) const {
    const char* from = static_cast<const char*>(data);
    bytes.insert(bytes.end(), from, from + size);
  }
  template <typename T>
  void operator()(const T& value) const {
    put(&value, sizeof value);
  }
  template <typename T>
  void operator()(const std::vector<T>& values) const {
    (*this)(std::uint64_t(values.size()));
    put(values.data(), values.size() * sizeof(T));
  }
};

struct Reader {
  const char*& at;
  void take(void* data, std::size_t size) const {
    std::copy_n(at, size, static_cast<char*>(data));
    at += size;
  }
  template <typename T>
  void operator()(T& value) const {
    take(&value, sizeof value);
  }
  template <typename T>
  void operator()(std::vector<T>& values) const {
    std::uint64_t count = 0;
    (*this)(count);
    values.resize(count);
    take(values.data(), count * sizeof(T));
  }
};

// What is in the file was written by this version if its hash is right: then its parts need no further tests.
std::optional<SearchTable> readTable(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error || size < sizeof(XXH64_hash_t)) return std::nullopt;
  std::ifstream in(file, std::ios::binary);
  std::vector<char> bytes(size);
  if (!in.read(bytes.data(), std::streamsize(size))) return std::nullopt;
  const std::size_t body = bytes.size() - sizeof(XXH64_hash_t);
  XXH64_hash_t hash;
  std::copy_n(bytes.data() + body, sizeof hash, reinterpret_cast<char*>(&hash));
  if (hash != XXH3_64bits_withSeed(bytes.data(), body, kVersion)) return std::nullopt;
  SearchTable table;
  const char* at = bytes.data();
  eachPart(table, Reader{at});
  makeCoarse(table.tree.codes);
  fs::last_write_time(file, fs::file_time_type::clock::now(), error);  // used just now
  return table;
}

void writeTable(const SearchTable& table, const fs::path& file) {
  std::vector<char> bytes;
  eachPart(table, Writer{bytes});
  const XXH64_hash_t hash = XXH3_64bits_withSeed(bytes.data(), bytes.size(), kVersion);
  Writer{bytes}(hash);
  static std::atomic<int> count{0};
  const fs::path temporary = file.parent_path() / (".tmp-" + std::to_string(::getpid()) + "-" +
                                                   std::to_string(++count) + "-" + file.filename().string());
  std::ofstream out(temporary, std::ios::binary);
  out.write(bytes.data(), std::streamsize(bytes.size()));
  out.close();
  std::error_code error;
  if (out) fs::rename(temporary, file, error);
  if (!out || error) fs::remove(temporary, error);
}

// Removes what has not been used for longest until the rest fits.
void trim(const fs::path& folder) {
  struct Kept {
    fs::file_time_type used;
    std::uintmax_t bytes;
    fs::path file;
  };
  std::vector<Kept> all;
  std::uintmax_t sum = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() != kEnding) continue;
    const Kept kept{entry.last_write_time(error), entry.file_size(error), entry.path()};
    if (error) continue;  // another run has just removed it
    sum += kept.bytes;
    all.push_back(kept);
  }
  std::sort(all.begin(), all.end(), [](const Kept& a, const Kept& b) { return a.used < b.used; });
  for (std::size_t i = 0; i < all.size() && sum > kCacheBytes; ++i) {
    fs::remove(all[i].file, error);
    sum -= all[i].bytes;
  }
}

}  // namespace

SearchTable cachedSearchTable(const Image& match, bool toroidal, int window, std::uint64_t seed, int similar,
                              const fs::path& folder) {
  const auto built = [&] {
    SearchTable table = buildSearchTable(match, toroidal, window, seed, similar);
    table.padded = {};
    return table;
  };
  if (folder.empty()) return built();
  const fs::path file = folder / (nameOf(match, toroidal, window, seed, similar) + kEnding);
  if (std::optional<SearchTable> kept = readTable(file)) return std::move(*kept);
  const SearchTable table = built();
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) {
    writeTable(table, file);
    trim(folder);
  }
  return table;
}

}  // namespace fluidtex::texture
