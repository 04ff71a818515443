#include "pipeline/scalars.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace fluidtex::pipeline {

const sim::FloatGrid& temperatureOf(const sim::Frame& frame) {
  const auto found = frame.fields.find("temperature");
  if (found == frame.fields.end())
    throw std::runtime_error("frame " + std::to_string(frame.index) +
                             ": has no temperature, by which the texture is to be guided or scaled; the "
                             "files hold none of that name");
  return *found->second;
}

double curveAt(const std::vector<texture::CurvePoint>& points, double value) {
  const auto after =
      std::upper_bound(points.begin(), points.end(), value,
                       [](double v, const texture::CurvePoint& point) { return v < point.value; });
  if (after == points.begin()) return points.front().result;
  if (after == points.end()) return points.back().result;
  const texture::CurvePoint &low = *(after - 1), &high = *after;
  return std::lerp(low.result, high.result, (value - low.value) / (high.value - low.value));
}

}  // namespace fluidtex::pipeline
