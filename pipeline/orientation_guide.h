// What a scene wants of the orientation field, in terms of one frame's motion.
#pragma once

#include "scenes/scene.h"
#include "sim/frame/frame.h"
#include "sim/shapes/shape_distance.h"
#include "texture/orientation/orient.h"

#include <openvdb/openvdb.h>

#include <vector>

namespace fluidtex::pipeline {

struct OrientationGuide {
  texture::OrientationOptions options;
  openvdb::Vec3d gravity{0.0};
  double frameRate = 24.0;
  openvdb::Vec3SGrid::Ptr field;              // of Align::field
  std::vector<sim::ShapeDistance> keepClear;  // places without singularities
};

// Reads the scene's vector field, where it has one. Throws std::runtime_error that names the file and what is
// wrong.
OrientationGuide orientationGuide(const scenes::Scene& scene);

// The wishes for the surface of this frame; both must outlive them.
texture::OrientWishes wishesFor(const OrientationGuide& guide, const sim::Frame& frame);

}  // namespace fluidtex::pipeline
