// A scene's factors from place to place, for one frame's motion: on the scale of its texture, and on the wear
// of it.
#pragma once

#include "scenes/scene.h"
#include "sim/frame/frame.h"
#include "sim/shapes/shape_distance.h"
#include "texture/levelset/point_scale.h"

#include <openvdb/openvdb.h>

#include <vector>

namespace fluidtex::pipeline {

struct PlaceFactor {
  texture::FactorOptions options;
  openvdb::FloatGrid::Ptr field;         // of FactorBy::field
  std::vector<sim::ShapeDistance> from;  // of FactorBy::distance
};

// texture.scale and texture.renewal. They read the scene's painted volume, if it has one. Throw
// std::runtime_error that names the file and the fault.
PlaceFactor textureScale(const scenes::Scene& scene);
PlaceFactor textureRenewal(const scenes::Scene& scene);

// The factor on the surface of this frame; both arguments must outlive the result. Empty: 1 everywhere.
texture::PointScale factorIn(const PlaceFactor& factor, const sim::Frame& frame);

}  // namespace fluidtex::pipeline
