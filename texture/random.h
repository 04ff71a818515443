// Counter-based random numbers: the same for the same seed and counter, whatever the order they are asked for
// in.
#pragma once

#include <cstdint>

namespace fluidtex::texture {

// All bits of the result depend on all bits of the argument (the finaliser of splitmix64 [Steele14]): a fixed
// permutation of the numbers.
constexpr std::uint64_t mix64(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

constexpr std::uint64_t randomBits(std::uint64_t seed, std::uint64_t counter) {
  return mix64(mix64(seed + counter));
}

// In [0, 1).
constexpr double randomUnit(std::uint64_t seed, std::uint64_t counter) {
  return double(randomBits(seed, counter) >> 11) * 0x1p-53;
}

// In 0 .. n - 1.
constexpr std::uint64_t randomBelow(std::uint64_t seed, std::uint64_t counter, std::uint64_t n) {
  return std::uint64_t(randomUnit(seed, counter) * double(n));
}

}  // namespace fluidtex::texture
