// The cache between runs: files in a folder, each named by a hash of all that it depends on and ending in a
// hash of its contents.
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace fluidtex::texture {

// Empty path: no cache. warn, unless empty, is called for damaged files, from any thread.
struct CacheFolder {
  CacheFolder(std::filesystem::path folder = {}, std::function<void(const std::string&)> teller = {})
      : path(std::move(folder)), warn(std::move(teller)) {}
  std::filesystem::path path;
  std::function<void(const std::string&)> warn;
};

// File name: hash of this build, the settings and the data (128 bits, hexadecimal), then `kind` as extension.
std::string keptName(const std::string& kind, std::span<const std::int64_t> settings,
                     std::span<const std::span<const float>> data);

struct KeptBytes {
  std::unique_ptr<char[]> data;
  std::size_t size = 0;
};

// Contents of a file of an earlier run. Nothing if there is none; nothing, and a call of `warn`, if it is
// damaged or truncated.
std::optional<KeptBytes> readKept(const CacheFolder& folder, const std::string& name);

// Writes a file under a temporary name and renames it. Beyond kCacheBytes in total, the least recently used
// files are removed. A folder that cannot be written is not an error: nothing is cached.
void writeKept(const CacheFolder& folder, const std::string& name, std::vector<char> bytes);

inline constexpr std::uintmax_t kCacheBytes = std::uintmax_t(2) << 30;

// Serialises values in order; a vector after its size.
struct ByteWriter {
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

struct ByteReader {
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

}  // namespace fluidtex::texture
