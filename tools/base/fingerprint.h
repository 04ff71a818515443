// Identifies a file's content.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace fluidtex::tools {

struct Fingerprint {
  std::uint64_t bytes = 0;
  std::string hash;  // XXH3, 128 bits, 32 hexadecimal digits
  bool operator==(const Fingerprint&) const = default;
};

// Throws std::system_error that names the file if it cannot be read.
Fingerprint fingerprintOf(const std::filesystem::path& file);

// The same hash of a text.
std::string hashOf(std::string_view text);

}  // namespace fluidtex::tools
