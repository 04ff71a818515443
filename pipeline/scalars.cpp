#include "pipeline/scalars.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace fluidtex::pipeline {

const sim::FloatGrid& fieldOf(const sim::Frame& frame, const std::string& name) {
  const auto found = frame.fields.find(name);
  if (found == frame.fields.end())
    throw std::runtime_error("frame " + std::to_string(frame.index) + ": has no " + name +
                             ", which the texture is to follow; write it for all frames that have liquid");
  return *found->second;
}

std::vector<float> sampled(const sim::FloatGrid& field, const std::vector<texture::Vec3f>& positions) {
  std::vector<float> values(positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), texture::kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      const auto value = sampler(field)();
                      for (std::size_t i = range.begin(); i != range.end(); ++i)
                        values[i] = float(value(openvdb::Vec3d(positions[i])));
                    });
  return values;
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
