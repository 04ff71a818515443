// Where a scene wants its texture larger or smaller, in terms of one frame's motion.
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

// Reads the scene's painted volume, where it has one. Throws std::runtime_error that names the file and what
// is wrong.
TextureScale textureScale(const scenes::Scene& scene);

// The factors for the surface of this frame; both must outlive them. Empty: 1 everywhere.
texture::PointScale scaleIn(const TextureScale& scale, const sim::Frame& frame);

}  // namespace fluidtex::pipeline
