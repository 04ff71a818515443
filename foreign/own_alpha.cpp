#include "foreign/own_alpha.h"

#include <array>
#include <cstdint>
#include <fstream>

namespace fluidtex::foreign {

bool saysAlpha(const std::filesystem::path& file, const std::string& kind) {
  if (kind != "bmp" && kind != "targa") return true;
  std::array<unsigned char, 70> head{};
  std::ifstream(file, std::ios::binary).read(reinterpret_cast<char*>(head.data()), head.size());
  const auto word = [&](std::size_t at) {
    return std::uint32_t(head[at]) | std::uint32_t(head[at + 1]) << 8 | std::uint32_t(head[at + 2]) << 16 |
           std::uint32_t(head[at + 3]) << 24;
  };
  if (kind == "targa") return (head[17] & 0x0f) != 0;  // "attribute bits per pixel"
  // BITMAPV3INFOHEADER and later ones have a mask of alpha; the earlier header calls the byte reserved.
  constexpr std::size_t kHeader = 14;
  return word(kHeader) >= 56 && word(kHeader + 52) != 0;
}

}  // namespace fluidtex::foreign
