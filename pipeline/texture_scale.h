// A scene's scale of its texture, for one frame's motion.
#pragma once

#include "scenes/scene.h"
#include "sim/frame/frame.h"
#include "sim/shapes/shape_distance.h"
#include "texture/levelset/point_scale.h"

#include <openvdb/openvdb.h>

#include <vector>

namespace fluidtex::pipeline {

struct TextureScale {
  texture::ScaleOptions options;
  openvdb::FloatGrid::Ptr field;         // of ScaleBy::field
  std::vector<sim::ShapeDistance> from;  // of ScaleBy::distance
};

// Reads the scene's painted volume, if it has one. Throws std::runtime_error that names the file and the
// fault.
TextureScale textureScale(const scenes::Scene& scene);

// Factors for the surface of this frame; both arguments must outlive the result. Empty: 1 everywhere.
texture::PointScale scaleIn(const TextureScale& scale, const sim::Frame& frame);

}  // namespace fluidtex::pipeline
