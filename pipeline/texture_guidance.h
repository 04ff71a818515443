// A scene's guidance of its texture, for one frame's motion.
#pragma once

#include "scenes/scene.h"
#include "sim/frame/frame.h"
#include "texture/surface.h"

#include <openvdb/openvdb.h>

namespace fluidtex::pipeline {

struct TextureGuidance {
  texture::GuidanceOptions options;
  openvdb::FloatGrid::Ptr field;  // of GuidanceBy::field
};

// Reads the scene's painted volume, if it has one. Throws std::runtime_error that names the file and the
// fault.
TextureGuidance textureGuidance(const scenes::Scene& scene);

// Sets SurfaceMesh::guidance of every level (and foam, if guidance follows it); empty if the scene has none.
// In the first frame motion is unknown: speed, vorticity and foam are 0. Ages and transported foam are those
// of level 0; coarser levels count as newly exposed. seconds: since the earlier frame.
void guide(const TextureGuidance& guidance, const sim::Frame& frame, const texture::Carried& carried,
           double seconds, texture::Surface& surface);

}  // namespace fluidtex::pipeline
