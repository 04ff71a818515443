#include "pipeline/scalars.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::pipeline {

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
