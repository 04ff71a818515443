// Scalar fields of a frame at positions on its surface, for the texture's scale and guidance.
#pragma once

#include "sim/frame/frame.h"
#include "texture/loops/parallel.h"
#include "texture/options.h"
#include "texture/surface.h"

#include <openvdb/tools/Interpolation.h>

#include <string>
#include <vector>

namespace fluidtex::pipeline {

// Piecewise linear curve through the points, constant beyond its ends.
double curveAt(const std::vector<texture::CurvePoint>& points, double value);

// curve(value(x)) at each position x; makeValue() makes a function `value` per task.
template <typename MakeValue>
std::vector<float> alongCurve(const std::vector<texture::CurvePoint>& points,
                              const std::vector<texture::Vec3f>& positions, const MakeValue& makeValue) {
  std::vector<float> results(positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), texture::kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      const auto value = makeValue();
                      for (std::size_t i = range.begin(); i != range.end(); ++i)
                        results[i] = float(curveAt(points, value(openvdb::Vec3d(positions[i]))));
                    });
  return results;
}

// The frame's scalar of this name. Throws std::runtime_error where it has none, as liquid out of files may.
const sim::FloatGrid& fieldOf(const sim::Frame& frame, const std::string& name);

// Its values at positions, interpolated linearly.
std::vector<float> sampled(const sim::FloatGrid& field, const std::vector<texture::Vec3f>& positions);

// Makes functions that sample a scalar grid linearly.
template <typename Grid>
auto sampler(const Grid& grid) {
  return [&grid] {
    return [&grid, accessor = grid.getConstAccessor()](const openvdb::Vec3d& x) {
      return double(openvdb::tools::BoxSampler::sample(accessor, grid.worldToIndex(x)));
    };
  };
}

}  // namespace fluidtex::pipeline
