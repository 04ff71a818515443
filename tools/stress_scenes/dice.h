// Numbers by chance, the same on every machine.
#pragma once

#include "sim/options.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace fluidtex::stress {

using sim::Vec3d;

// SplitMix64: Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014. The distributions
// of the standard library differ from one library to the next.
class Dice {
 public:
  Dice(std::uint64_t seed, int number) : m_state(seed) {
    m_state = next() ^ (static_cast<std::uint64_t>(number) * 0x9e3779b97f4a7c15u);
    next();
  }
  double number(double low, double high) {
    return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53;
  }
  int whole(int low, int high) {
    return low + static_cast<int>(next() % static_cast<std::uint64_t>(high - low + 1));
  }
  bool chance(double share) { return number(0.0, 1.0) < share; }
  // As likely in each power of ten.
  double power(double low, double high) { return std::exp(number(std::log(low), std::log(high))); }
  Vec3d inBox(const Vec3d& low, const Vec3d& high) {
    Vec3d x;
    for (int a = 0; a < 3; ++a) x[a] = number(low[a], high[a]);
    return x;
  }
  Vec3d direction() {
    const double z = number(-1.0, 1.0), turn = number(0.0, 2.0 * std::numbers::pi),
                 r = std::sqrt(1.0 - z * z);
    return {r * std::cos(turn), r * std::sin(turn), z};
  }

 private:
  std::uint64_t next() {
    m_state += 0x9e3779b97f4a7c15u;
    std::uint64_t z = m_state;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  std::uint64_t m_state;
};

}  // namespace fluidtex::stress
