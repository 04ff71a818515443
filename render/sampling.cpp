// Based on: Burley, Practical hash-based Owen scrambling, JCGT 2020; Ahmed and Wonka, Screen-space blue-noise
// diffusion of Monte Carlo sampling error via hierarchical ordering of pixels, 2020 (here with scrambling in
// base 2); Laine and Karras, Stratified sampling for stochastic transparency, 2011, with the better constants
// published by Vegdahl.
// The disc: Shirley and Chiu, A low distortion map between disk and square, 1997.
#include "render/sampling.h"

#include <array>
#include <bit>

namespace fluidtex::render {
namespace {

std::uint32_t reverseBits(std::uint32_t x) {
  x = __builtin_bswap32(x);
  x = ((x & 0x0f0f0f0fu) << 4) | ((x >> 4) & 0x0f0f0f0fu);
  x = ((x & 0x33333333u) << 2) | ((x >> 2) & 0x33333333u);
  return ((x & 0x55555555u) << 1) | ((x >> 1) & 0x55555555u);
}

// Owen scrambling of a number whose bits are in reverse order: each bit is flipped depending on the lower
// ones only.
std::uint32_t scrambleReversed(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeau;
  x += seed;
  x *= (seed >> 16) | 1u;
  x ^= x * 0x05526c56u;
  x ^= x * 0x53a22864u;
  return x;
}

// Second component of the Sobol sequence, one table a byte of the index. Bits in reverse order.
using ByteTables = std::array<std::array<std::uint32_t, 256>, 4>;

constexpr ByteTables makeSobolTables() {
  std::array<std::uint32_t, 32> column{};
  std::uint32_t direction = 1u;  // reversed: the sequence's most significant bit
  for (std::uint32_t& c : column) {
    c = direction;
    direction ^= direction << 1;
  }
  ByteTables tables{};
  for (int byte = 0; byte < 4; ++byte)
    for (int value = 0; value < 256; ++value)
      for (int bit = 0; bit < 8; ++bit)
        if (value >> bit & 1) tables[byte][value] ^= column[8 * byte + bit];
  return tables;
}

constexpr ByteTables kSobol = makeSobolTables();

std::uint32_t spreadBits(std::uint32_t x) {
  x &= 0xffffu;
  x = (x | x << 8) & 0x00ff00ffu;
  x = (x | x << 4) & 0x0f0f0f0fu;
  x = (x | x << 2) & 0x33333333u;
  return (x | x << 1) & 0x55555555u;
}

float unitFloat(std::uint32_t x) {
  return static_cast<float>(x >> 8) * 0x1p-24f;
}

}  // namespace

std::uint32_t hash(std::uint32_t a, std::uint32_t b) {
  std::uint32_t x = a * 0x9e3779b9u ^ (b + 0x7f4a7c15u) * 0x85ebca6bu;
  x ^= x >> 16;
  x *= 0x7feb352du;
  x ^= x >> 15;
  x *= 0x846ca68bu;
  return x ^ x >> 16;
}

PixelSamples::PixelSamples(int x, int y, int samples, std::uint32_t frame) {
  const int bits = std::bit_width(static_cast<std::uint32_t>(samples - 1));
  const std::uint64_t order = static_cast<std::uint64_t>(spreadBits(static_cast<std::uint32_t>(x)) |
                                                         spreadBits(static_cast<std::uint32_t>(y)) << 1)
                              << bits;
  m_base = static_cast<std::uint32_t>(order);
  // A picture too large for 32 bits of index starts a new sequence in every block that overflows them.
  m_seed = hash(frame, static_cast<std::uint32_t>(order >> 32));
}

Vec2f PixelSamples::point(int sample, int dimension) const {
  const std::uint32_t seed = hash(m_seed, static_cast<std::uint32_t>(dimension));
  const std::uint32_t index = m_base + static_cast<std::uint32_t>(sample);
  const std::uint32_t shuffled = reverseBits(scrambleReversed(reverseBits(index), seed));
  const std::uint32_t second = kSobol[0][shuffled & 0xff] ^ kSobol[1][shuffled >> 8 & 0xff] ^
                               kSobol[2][shuffled >> 16 & 0xff] ^ kSobol[3][shuffled >> 24];
  return Vec2f(unitFloat(reverseBits(scrambleReversed(shuffled, seed * 0x9e3779b9u + 1u))),
               unitFloat(reverseBits(scrambleReversed(second, seed * 0x85ebca6bu + 2u))));
}

Vec2f tentOffset(const Vec2f& u, float radius) {
  const auto warp = [radius](float x) {
    return x < 0.5f ? radius * (std::sqrt(2.0f * x) - 1.0f) : radius * (1.0f - std::sqrt(2.0f - 2.0f * x));
  };
  return Vec2f(warp(u[0]), warp(u[1]));
}

Vec2f uniformDisc(const Vec2f& u) {
  const float x = 2.0f * u[0] - 1.0f, y = 2.0f * u[1] - 1.0f;
  if (x == 0.0f && y == 0.0f) return Vec2f(0.0f);
  const bool flat = std::abs(x) > std::abs(y);
  const float r = flat ? x : y;
  const float angle = flat ? 0.25f * kPi * (y / x) : 0.5f * kPi - 0.25f * kPi * (x / y);
  return Vec2f(r * std::cos(angle), r * std::sin(angle));
}

Vec3f cosineHemisphere(const Vec2f& u) {
  const Vec2f p = uniformDisc(u);
  return Vec3f(p[0], p[1], std::sqrt(std::max(0.0f, 1.0f - p.dot(p))));
}

Vec3f uniformCone(const Vec2f& u, float cosMax) {
  const float z = 1.0f - u[0] * (1.0f - cosMax), angle = 2.0f * kPi * u[1];
  const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
  return Vec3f(r * std::cos(angle), r * std::sin(angle), z);
}

}  // namespace fluidtex::render
