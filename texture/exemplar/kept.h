// What is kept from run to run: files in a folder, each named by a hash of all that it depends on, and ending
// in a hash of what is in it.
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

// An empty path: nothing is kept. warn, where it is not empty, is told of files that are damaged, from any
// thread.
struct CacheFolder {
  CacheFolder(std::filesystem::path folder = {}, std::function<void(const std::string&)> teller = {})
      : path(std::move(folder)), warn(std::move(teller)) {}
  std::filesystem::path path;
  std::function<void(const std::string&)> warn;
};

// A file's name: the hash of this build, settings and data (128 bits, hexadecimal), then `kind`, its ending.
std::string keptName(const std::string& kind, std::span<const std::int64_t> settings,
                     std::span<const std::span<const float>> data);

struct KeptBytes {
  std::unique_ptr<char[]> data;
  std::size_t size = 0;
};

// What an earlier run has left under this name; nothing where there is no such file, or one that is damaged
// or cut short: then `warn` is told, and it is to be written anew.
std::optional<KeptBytes> readKept(const CacheFolder& folder, const std::string& name);

// Writes a file under a temporary name and renames it. Above kCacheBytes those that have not been used for
// longest are removed. A folder that cannot be written is no fault: nothing is kept then.
void writeKept(const CacheFolder& folder, const std::string& name, std::vector<char> bytes);

inline constexpr std::uintmax_t kCacheBytes = std::uintmax_t(2) << 30;

// Values as bytes, one after the other; a vector after the number of its members.
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
