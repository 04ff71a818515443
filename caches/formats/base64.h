// Bytes written as text.
#pragma once

#include <string>
#include <string_view>

namespace fluidtex::caches {

// The first `count` bytes of a text in base64 (RFC 4648), of which blanks and line ends are no part. Where it
// was written in pieces, each of which may end with '=', these are one behind the other.
// Throws std::runtime_error where the text holds fewer, or other letters before.
std::string fromBase64(std::string_view text, std::size_t count);

}  // namespace fluidtex::caches
