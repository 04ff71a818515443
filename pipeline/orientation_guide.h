// A scene's constraints on the orientation field, for one frame's motion.
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
  openvdb::Mat3d worldFromFile;               // of vectors, for Align::attribute
  std::vector<sim::ShapeDistance> keepClear;  // regions to keep free of singularities
};

// Reads the scene's vector field, if it has one. Throws std::runtime_error that names the file and the fault.
OrientationGuide orientationGuide(const scenes::Scene& scene);

// Constraints for the surface of this frame; both arguments must outlive the result.
texture::OrientWishes wishesFor(const OrientationGuide& guide, const sim::Frame& frame);

}  // namespace fluidtex::pipeline
