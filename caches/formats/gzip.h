// What zlib packs.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace fluidtex::caches {

// Whether bytes begin as those of a gzip file do.
bool isGzip(std::string_view bytes);

// A gzip file unpacked, of any number of members. Memory stays within a multiple of the result, which deflate
// bounds to 1032 times what it is packed in (zlib, "Technical details").
// Throws std::runtime_error where it is cut short or damaged, as its checksums show.
std::string unpackedGzip(std::string_view bytes);

// A zlib stream of which it is known how many bytes it holds. Throws std::runtime_error for any other number.
void unpackZlib(std::string_view bytes, char* result, std::size_t size);

// Whether so many bytes can hold so many others packed.
bool canHold(std::uint64_t packed, std::uint64_t unpacked);

}  // namespace fluidtex::caches
