#include "foreign/grid_heads.h"

#include <cstring>
#include <type_traits>

namespace fluidtex::foreign {
namespace {

template <class Number>
void put(std::string& bytes, const Number& number) {
  static_assert(std::is_trivially_copyable_v<Number>);
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void put(std::string& bytes, const std::string& text) {
  put(bytes, text.size());
  bytes += text;
}

constexpr const char* kFailed = "cannot be read: the program that reads it failed";

std::string_view taken(std::string_view& bytes, std::size_t count) {
  if (bytes.size() < count) throw Unreadable(kFailed);
  const std::string_view piece = bytes.substr(0, count);
  bytes.remove_prefix(count);
  return piece;
}

template <class Number>
void take(std::string_view& bytes, Number& number) {
  std::memcpy(&number, taken(bytes, sizeof number).data(), sizeof number);
}

// Any other byte in a bool is none.
void take(std::string_view& bytes, bool& flag) {
  unsigned char byte = 0;
  take(bytes, byte);
  if (byte > 1) throw Unreadable(kFailed);
  flag = byte == 1;
}

void take(std::string_view& bytes, std::string& text) {
  std::size_t size = 0;
  take(bytes, size);
  text = taken(bytes, size);
}

}  // namespace

std::string packed(const std::vector<GridHead>& heads) {
  std::string bytes;
  for (const GridHead& head : heads) {
    put(bytes, head.name);
    put(bytes, head.type);
    put(bytes, head.gridClass);
    put(bytes, head.half);
    put(bytes, head.readable);
    put(bytes, head.vectors);
    put(bytes, head.activeVoxels);
    put(bytes, head.transform.has_value());
    if (head.transform) put(bytes, *head.transform);
  }
  return bytes;
}

std::vector<GridHead> unpacked(std::string_view bytes) {
  std::vector<GridHead> heads;
  while (!bytes.empty()) {
    GridHead head;
    take(bytes, head.name);
    take(bytes, head.type);
    take(bytes, head.gridClass);
    take(bytes, head.half);
    take(bytes, head.readable);
    take(bytes, head.vectors);
    take(bytes, head.activeVoxels);
    bool affine = false;
    take(bytes, affine);
    if (affine) take(bytes, head.transform.emplace());
    heads.push_back(std::move(head));
  }
  return heads;
}

}  // namespace fluidtex::foreign
