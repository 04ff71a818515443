#include "tools/joints/stand_out.h"

#include <cmath>

namespace fluidtex::joints {

Contrast contrastOf(const Seen& seen, std::size_t way, Kind kind, double near) {
  const std::vector<float>& lightness = seen.lightness[way];
  Contrast result;
  double sum = 0.0, squares = 0.0, gradients = 0.0;
  std::size_t steps = 0;
  for (int y = 0; y < seen.height; ++y)
    for (int x = 0; x < seen.width; ++x) {
      const std::size_t at = std::size_t(y) * std::size_t(seen.width) + std::size_t(x);
      if (seen.kind[at] != kind) continue;
      ++result.pixels;
      sum += lightness[at];
      squares += double(lightness[at]) * double(lightness[at]);
      if (x + 1 == seen.width || y + 1 == seen.height) continue;
      const std::size_t right = at + 1, below = at + std::size_t(seen.width);
      const auto goesOn = [&](std::size_t next) {
        return seen.kind[next] == kind && (seen.position[next] - seen.position[at]).length() < near;
      };
      if (!goesOn(right) || !goesOn(below)) continue;
      const float gradient = std::hypot(lightness[right] - lightness[at], lightness[below] - lightness[at]);
      ++result.gradients;
      gradients += gradient;
      steps += gradient > kStep;
    }
  if (result.pixels > 0) {
    const double mean = sum / double(result.pixels);
    result.deviation = std::sqrt(std::max(0.0, squares / double(result.pixels) - mean * mean));
  }
  if (result.gradients > 0) {
    result.gradient = gradients / double(result.gradients);
    result.steps = double(steps) / double(result.gradients);
  }
  return result;
}

}  // namespace fluidtex::joints
