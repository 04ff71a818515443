// Arrays of VTK's XML files.
#pragma once

#include "caches/formats/numbers.h"

#include <pugixml.hpp>

#include <string>
#include <string_view>

namespace fluidtex::caches {

// What the whole file says of its arrays.
struct XmlArrays {
  std::endian order = std::endian::little;
  NumberType headerType = NumberType::uint32;  // of the lengths before the values
  bool isPacked = false;                       // in blocks, by zlib
  bool appendedIsBase64 = false;
  std::string_view appended;  // what is behind '_', which offsets count from
  std::uint64_t room = 0;     // bytes that arrays can still take, each having its own
};

// The numbers of a DataArray, in text or not. Throws std::runtime_error where they are damaged, or packed in
// a way that is not read.
template <class To>
std::vector<To> numbersOf(const pugi::xml_node& array, XmlArrays& file);

// An attribute that is a whole number of 0 or more. Throws std::runtime_error.
std::uint64_t countOf(const pugi::xml_node& node, const char* attribute);

}  // namespace fluidtex::caches
