// Smooth noise in which each value is as frequent as any other.
#pragma once

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// width x height values, rows from the top: random numbers blurred by a Gaussian of `sigma` pixels, each
// replaced by its rank, (rank + 0.5) / count.
std::vector<float> smoothNoise(int width, int height, double sigma, std::uint64_t seed);

}  // namespace fluidtex::texture
