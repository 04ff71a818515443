#include "pipeline/texture_scale.h"

#include "pipeline/read_grid.h"
#include "pipeline/scalars.h"
#include "sim/grid/mac_grid.h"
#include "sim/solids/domain.h"

#include <algorithm>

namespace fluidtex::pipeline {
namespace {

using texture::ScaleBy;

// Curve of the values that makeValue() reads.
template <typename MakeValue>
texture::PointScale mapped(const std::vector<texture::CurvePoint>& points, const MakeValue& makeValue) {
  return [&points, makeValue](const std::vector<texture::Vec3f>& positions) {
    return alongCurve(points, positions, makeValue);
  };
}

}  // namespace

TextureScale textureScale(const scenes::Scene& scene) {
  TextureScale scale{scene.texture.scale, nullptr, {}};
  if (scale.options.by == ScaleBy::field) scale.field = readGrid<openvdb::FloatGrid>(scale.options.field);
  if (scale.options.by == ScaleBy::distance) {
    for (const sim::Shape& shape : scene.scaleFrom)
      scale.from.emplace_back(shape, scene.sim.voxelSize(), sim::domainBox(scene.sim));
  }
  return scale;
}

texture::PointScale scaleIn(const TextureScale& scale, const sim::Frame& frame) {
  const std::vector<texture::CurvePoint>& points = scale.options.points;
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
      return mapped(points, sampler(fieldOf(frame, "temperature")));
    case ScaleBy::height:
      return mapped(points, [] { return [](const sim::Vec3d& x) { return x.z(); }; });
    case ScaleBy::field:
      return mapped(points, sampler(*scale.field));
    case ScaleBy::attribute:
      return mapped(points, sampler(fieldOf(frame, scale.options.attribute)));
  }
  return {};
}

}  // namespace fluidtex::pipeline
