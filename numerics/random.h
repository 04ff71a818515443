// Random numbers of all rooms: hashes of a seed and a counter, the same whatever the order they are asked for
// in.
#pragma once

#include <cstdint>

namespace fluidtex {

// The finaliser of splitmix64 [Steele, Lea, Flood 2014]: a fixed permutation of the numbers, 0 to 0.
constexpr std::uint64_t finalised(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// The same, after a step: all bits of the result depend on all bits of the argument.
constexpr std::uint64_t mix64(std::uint64_t x) {
  return finalised(x + 0x9e3779b97f4a7c15u);
}

// The seed comes in twice, before the counter is mixed and between two mixings: streams of different seeds
// are different permutations, and not one that is shifted.
constexpr std::uint64_t randomBits(std::uint64_t seed, std::uint64_t counter) {
  const std::uint64_t key = mix64(seed);
  return mix64(mix64(counter ^ key) + mix64(key));
}

// In [0, 1).
constexpr double randomUnit(std::uint64_t seed, std::uint64_t counter) {
  return double(randomBits(seed, counter) >> 11) * 0x1p-53;
}

// In 0 .. n - 1.
constexpr std::uint64_t randomBelow(std::uint64_t seed, std::uint64_t counter, std::uint64_t n) {
  return std::uint64_t(randomUnit(seed, counter) * double(n));
}

// What the scene's seed is used for: each has a stream of its own, seeded by streamOf().
enum class Stream : std::uint64_t { markers, points, orientation, windows, synthesis, renewal };

constexpr std::uint64_t streamOf(std::uint64_t seed, Stream purpose) {
  return randomBits(seed, std::uint64_t(purpose));
}

}  // namespace fluidtex
