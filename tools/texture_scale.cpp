#include "tools/texture_scale.h"

#include "texture/parallel.h"
#include "texture/read_grid.h"

#include <openvdb/tools/Interpolation.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::tools {
namespace {

using texture::ScaleBy;
using texture::Vec3f;

// map(value(x)) for each position x, where value is made once for each piece of the work.
template <typename MakeValue>
texture::PointScale mapped(const std::vector<texture::ScalePoint>& points, const MakeValue& makeValue) {
  return [&points, makeValue](const std::vector<Vec3f>& positions) {
    std::vector<float> factors(positions.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, positions.size(), texture::kGrain),
                      [&](const tbb::blocked_range<std::size_t>& range) {
                        const auto value = makeValue();
                        for (std::size_t i = range.begin(); i != range.end(); ++i)
                          factors[i] = float(factorAt(points, value(sim::Vec3d(positions[i]))));
                      });
    return factors;
  };
}

template <typename Grid>
auto sampler(const Grid& grid) {
  return [&grid] {
    return [&grid, accessor = grid.getConstAccessor()](const sim::Vec3d& x) {
      return double(openvdb::tools::BoxSampler::sample(accessor, grid.worldToIndex(x)));
    };
  };
}

}  // namespace

double factorAt(const std::vector<texture::ScalePoint>& points, double value) {
  const auto after =
      std::upper_bound(points.begin(), points.end(), value,
                       [](double v, const texture::ScalePoint& point) { return v < point.value; });
  if (after == points.begin()) return points.front().factor;
  if (after == points.end()) return points.back().factor;
  const texture::ScalePoint &low = *(after - 1), &high = *after;
  return std::lerp(low.factor, high.factor, (value - low.value) / (high.value - low.value));
}

TextureScale textureScale(const scenes::Scene& scene) {
  TextureScale scale{scene.texture.scale, nullptr, {}};
  if (scale.options.by == ScaleBy::field)
    scale.field = texture::readGrid<openvdb::FloatGrid>(scale.options.field);
  if (scale.options.by == ScaleBy::distance) {
    for (const sim::Shape& shape : scene.scaleFrom)
      scale.from.emplace_back(shape, scene.sim.voxelSize(), scene.sim.size);
  }
  return scale;
}

texture::PointScale scaleIn(const TextureScale& scale, const sim::Frame& frame) {
  const std::vector<texture::ScalePoint>& points = scale.options.points;
  switch (scale.options.by) {
    case ScaleBy::none:
      break;
    case ScaleBy::distance:
      return mapped(points, [&scale] {
        return [&scale](const sim::Vec3d& x) {
          double nearest = scale.from.front()(x);
          for (const sim::ShapeDistance& shape : scale.from) nearest = std::min(nearest, shape(x));
          return nearest;
        };
      });
    case ScaleBy::temperature:
      return mapped(points, sampler(*frame.fields.at("temperature")));
    case ScaleBy::height:
      return mapped(points, [] { return [](const sim::Vec3d& x) { return x.z(); }; });
    case ScaleBy::field:
      return mapped(points, sampler(*scale.field));
  }
  return {};
}

}  // namespace fluidtex::tools
