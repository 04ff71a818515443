#include "texture/exemplar/kept.h"

#include "texture/exemplar/build_id.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdio>
#include <fstream>
#include <string_view>
#include <system_error>

namespace fluidtex::texture {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kSeed = 2;  // of content hashes
constexpr std::array<const char*, 2> kEndings{".table", ".match"};

// Removes the least recently used files until the rest fits.
void trim(const fs::path& folder) {
  struct File {
    fs::file_time_type used;
    std::uintmax_t bytes;
    fs::path path;
  };
  std::vector<File> all;
  std::uintmax_t sum = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    if (std::find(kEndings.begin(), kEndings.end(), entry.path().extension()) == kEndings.end()) continue;
    const File file{entry.last_write_time(error), entry.file_size(error), entry.path()};
    if (error) continue;  // removed by another run meanwhile
    sum += file.bytes;
    all.push_back(file);
  }
  std::sort(all.begin(), all.end(), [](const File& a, const File& b) { return a.used < b.used; });
  for (std::size_t i = 0; i < all.size() && sum > kCacheBytes; ++i) {
    fs::remove(all[i].path, error);
    sum -= all[i].bytes;
  }
}

}  // namespace

std::string keptName(const std::string& kind, std::span<const std::int64_t> settings,
                     std::span<const std::span<const float>> data) {
  XXH3_state_t state;
  XXH3_128bits_reset_withSeed(&state, XXH3_64bits(settings.data(), settings.size_bytes()));
  const std::string_view build = buildId();
  XXH3_128bits_update(&state, build.data(), build.size());
  for (const std::span<const float>& part : data) {
    const std::uint64_t size = part.size();
    XXH3_128bits_update(&state, &size, sizeof size);
    XXH3_128bits_update(&state, part.data(), part.size_bytes());
  }
  const XXH128_hash_t hash = XXH3_128bits_digest(&state);
  char text[33];
  std::snprintf(text, sizeof text, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                static_cast<unsigned long long>(hash.low64));
  return text + kind;
}

std::optional<KeptBytes> readKept(const CacheFolder& folder, const std::string& name) {
  if (folder.path.empty()) return std::nullopt;
  const fs::path file = folder.path / name;
  std::error_code error;
  const std::uintmax_t size = fs::file_size(file, error);
  if (error) return std::nullopt;
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  // The hash shows that this program wrote it completely: its parts need no further checks.
  KeptBytes bytes{std::make_unique_for_overwrite<char[]>(size), size};
  XXH64_hash_t hash;
  const bool whole =
      size >= sizeof hash && in.read(bytes.data.get(), std::streamsize(size)) &&
      (std::copy_n(bytes.data.get() + size - sizeof hash, sizeof hash, reinterpret_cast<char*>(&hash)),
       hash == XXH3_64bits_withSeed(bytes.data.get(), size - sizeof hash, kSeed));
  if (!whole) {
    if (folder.warn) folder.warn(file.string() + " is damaged; it is made anew.");
    return std::nullopt;
  }
  fs::last_write_time(file, fs::file_time_type::clock::now(), error);  // marks it as used
  return bytes;
}

void writeKept(const CacheFolder& folder, const std::string& name, std::vector<char> bytes) {
  if (folder.path.empty()) return;
  std::error_code error;
  fs::create_directories(folder.path, error);
  if (error) return;
  const XXH64_hash_t hash = XXH3_64bits_withSeed(bytes.data(), bytes.size(), kSeed);
  ByteWriter{bytes}(hash);
  static std::atomic<int> count{0};
  const fs::path temporary =
      folder.path / (".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(++count) + "-" + name);
  std::ofstream out(temporary, std::ios::binary);
  out.write(bytes.data(), std::streamsize(bytes.size()));
  out.close();
  if (out) fs::rename(temporary, folder.path / name, error);
  if (!out || error) fs::remove(temporary, error);
  trim(folder.path);
}

}  // namespace fluidtex::texture
