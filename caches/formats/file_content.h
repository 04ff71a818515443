// Files as a whole.
#pragma once

#include "caches/formats/format_error.h"

#include <filesystem>
#include <string>

namespace fluidtex::caches {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what);

// The bytes of a file, unpacked where they are packed by gzip. Throws FormatError: missing, unreadable,
// empty, damaged.
std::string contentOf(const std::filesystem::path& file);

}  // namespace fluidtex::caches
