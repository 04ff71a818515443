#include "pipeline/place_factor.h"

#include "pipeline/read_grid.h"
#include "pipeline/scalars.h"
#include "sim/grid/mac_grid.h"
#include "sim/solids/domain.h"

#include <algorithm>

namespace fluidtex::pipeline {
namespace {

using texture::FactorBy;

// Curve of the values that makeValue() reads.
template <typename MakeValue>
texture::PointScale mapped(const std::vector<texture::CurvePoint>& points, const MakeValue& makeValue) {
  return [&points, makeValue](const std::vector<texture::Vec3f>& positions) {
    return alongCurve(points, positions, makeValue);
  };
}

PlaceFactor placeFactor(const texture::FactorOptions& options, const std::vector<sim::Shape>& from,
                        const scenes::Scene& scene) {
  PlaceFactor factor{options, nullptr, {}};
  if (options.by == FactorBy::field) factor.field = readGrid<openvdb::FloatGrid>(options.field);
  if (options.by == FactorBy::distance) {
    for (const sim::Shape& shape : from)
      factor.from.emplace_back(shape, scene.sim.voxelSize(), sim::domainBox(scene.sim));
  }
  return factor;
}

}  // namespace

PlaceFactor textureScale(const scenes::Scene& scene) {
  return placeFactor(scene.texture.scale, scene.scaleFrom, scene);
}

PlaceFactor textureRenewal(const scenes::Scene& scene) {
  return placeFactor(scene.texture.renewal, scene.renewalFrom, scene);
}

texture::PointScale factorIn(const PlaceFactor& factor, const sim::Frame& frame) {
  const std::vector<texture::CurvePoint>& points = factor.options.points;
  switch (factor.options.by) {
    case FactorBy::none:
      break;
    case FactorBy::distance:
      return mapped(points, [&factor] {
        return [&factor](const sim::Vec3d& x) {
          double nearest = factor.from.front()(x);
          for (const sim::ShapeDistance& shape : factor.from) nearest = std::min(nearest, shape(x));
          return nearest;
        };
      });
    case FactorBy::temperature:
      return mapped(points, sampler(fieldOf(frame, "temperature")));
    case FactorBy::height:
      return mapped(points, [] { return [](const sim::Vec3d& x) { return x.z(); }; });
    case FactorBy::field:
      return mapped(points, sampler(*factor.field));
    case FactorBy::attribute:
      return mapped(points, sampler(fieldOf(frame, factor.options.attribute)));
  }
  return {};
}

}  // namespace fluidtex::pipeline
