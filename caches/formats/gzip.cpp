#include "caches/formats/gzip.h"

#include <zlib.h>

#include <algorithm>
#include <new>
#include <stdexcept>

namespace fluidtex::caches {

namespace {

// zlib counts in 32 bits what is given to it at once.
constexpr std::size_t kPiece = std::size_t{1} << 30;

Bytef* bytesOf(const char* at) {
  // It reads only, but says so nowhere.
  return reinterpret_cast<Bytef*>(const_cast<char*>(at));
}

struct Inflating {
  z_stream stream{};
  explicit Inflating(int windowBits) {
    if (inflateInit2(&stream, windowBits) != Z_OK) throw std::bad_alloc();
  }
  ~Inflating() { inflateEnd(&stream); }
  Inflating(const Inflating&) = delete;
  Inflating& operator=(const Inflating&) = delete;
};

}  // namespace

bool isGzip(std::string_view bytes) {
  return bytes.starts_with("\x1f\x8b");
}

bool canHold(std::uint64_t packed, std::uint64_t unpacked) {
  constexpr std::uint64_t kMostRatio = 1032;
  return unpacked / kMostRatio <= packed;
}

std::string unpackedGzip(std::string_view bytes) {
  constexpr int kGzip = 16;
  Inflating inflating(MAX_WBITS + kGzip);
  z_stream& stream = inflating.stream;
  std::string result(std::max<std::size_t>(4096, 4 * bytes.size()), '\0');
  std::size_t written = 0;
  for (;;) {
    if (written == result.size()) result.resize(2 * result.size());
    stream.next_in = bytesOf(bytes.data());
    stream.avail_in = static_cast<uInt>(std::min(bytes.size(), kPiece));
    stream.next_out = bytesOf(result.data() + written);
    stream.avail_out = static_cast<uInt>(std::min(result.size() - written, kPiece));
    const int outcome = inflate(&stream, Z_NO_FLUSH);
    if (outcome == Z_MEM_ERROR) throw std::bad_alloc();
    if (outcome != Z_OK && outcome != Z_STREAM_END && outcome != Z_BUF_ERROR)
      throw std::runtime_error("its gzip data is damaged; write or copy it anew");
    bytes.remove_prefix(static_cast<std::size_t>(reinterpret_cast<char*>(stream.next_in) - bytes.data()));
    written = static_cast<std::size_t>(reinterpret_cast<char*>(stream.next_out) - result.data());
    if (outcome == Z_STREAM_END) {
      // Another member may follow. Some programs fill the last block of a file with zeros.
      if (bytes.find_first_not_of('\0') == std::string_view::npos) break;
      if (!isGzip(bytes)) throw std::runtime_error("holds bytes behind its gzip data; write or copy it anew");
      inflateReset(&stream);
    } else if (bytes.empty() && stream.avail_out > 0) {
      throw std::runtime_error("is cut short: its gzip data has no end; write or copy it anew");
    }
  }
  result.resize(written);
  return result;
}

void unpackZlib(std::string_view bytes, char* result, std::size_t size) {
  uLongf written = size;
  const int outcome = uncompress(bytesOf(result), &written, bytesOf(bytes.data()), bytes.size());
  if (outcome != Z_OK || written != size)
    throw std::runtime_error("data packed by zlib is damaged; write or copy it anew");
}

}  // namespace fluidtex::caches
