// Files as a whole.
#pragma once

#include "caches/formats/format_error.h"

#include <filesystem>
#include <string>

namespace fluidtex::caches {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what);

// The bytes of a file. Throws FormatError: missing, unreadable, empty.
std::string bytesOf(const std::filesystem::path& file);

// The bytes, unpacked where they are packed by gzip. Throws FormatError: damaged.
std::string unpacked(const std::filesystem::path& file, std::string bytes);

// Both.
inline std::string contentOf(const std::filesystem::path& file) {
  return unpacked(file, bytesOf(file));
}

}  // namespace fluidtex::caches
