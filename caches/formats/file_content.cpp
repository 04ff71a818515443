#include "caches/formats/file_content.h"

#include "caches/formats/gzip.h"

#include <fstream>

namespace fluidtex::caches {

void fail(const std::filesystem::path& file, const std::string& what) {
  throw FormatError(file.string() + ": " + what);
}

std::string bytesOf(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error)) fail(file, "no such file");
  if (!std::filesystem::is_regular_file(file, error)) fail(file, "not a file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  std::ifstream in(file, std::ios::binary);
  if (error || !in) fail(file, "cannot be opened or read");
  if (size == 0) fail(file, "the file is empty; write or copy it anew");
  std::string bytes(static_cast<std::size_t>(size), '\0');
  in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (!in) fail(file, "cannot be opened or read");
  return bytes;
}

std::string unpacked(const std::filesystem::path& file, std::string bytes) {
  if (!isGzip(bytes)) return bytes;
  try {
    return unpackedGzip(bytes);
  } catch (const std::runtime_error& fault) {
    fail(file, fault.what());
  }
}

}  // namespace fluidtex::caches
