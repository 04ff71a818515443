#include "caches/formats/base64.h"

#include <array>
#include <cstdint>
#include <stdexcept>

namespace fluidtex::caches {

namespace {

constexpr std::uint8_t kOther = 255, kBlank = 254, kPadding = 253;

constexpr std::array<std::uint8_t, 256> meanings() {
  std::array<std::uint8_t, 256> of{};
  of.fill(kOther);
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  for (std::size_t n = 0; n < kDigits.size(); ++n)
    of[static_cast<unsigned char>(kDigits[n])] = std::uint8_t(n);
  for (const char blank : {' ', '\t', '\n', '\r'}) of[static_cast<unsigned char>(blank)] = kBlank;
  of[static_cast<unsigned char>('=')] = kPadding;
  return of;
}

}  // namespace

std::string fromBase64(std::string_view text, std::size_t count) {
  static constexpr std::array<std::uint8_t, 256> kMeaning = meanings();
  std::string bytes;
  if (count <= text.size()) bytes.reserve(count + 3);
  std::uint32_t bits = 0;
  int digits = 0, padding = 0;
  for (std::size_t n = 0; n < text.size() && bytes.size() < count; ++n) {
    const std::uint8_t meaning = kMeaning[static_cast<unsigned char>(text[n])];
    if (meaning == kBlank) continue;
    if (meaning == kOther || (meaning == kPadding && digits < 2) || (meaning < 64 && padding > 0)) break;
    if (meaning == kPadding) ++padding;
    bits = bits << 6 | (meaning == kPadding ? 0u : meaning);
    if (++digits < 4) continue;
    const std::array<char, 3> three{char(bits >> 16), char(bits >> 8), char(bits)};
    bytes.append(three.data(), std::size_t(3 - padding));
    bits = 0;
    digits = padding = 0;
  }
  if (bytes.size() < count)
    throw std::runtime_error("an array in base64 has " + std::to_string(bytes.size()) + " of the " +
                             std::to_string(count) + " bytes that it needs; write or copy it anew");
  bytes.resize(count);
  return bytes;
}

}  // namespace fluidtex::caches
