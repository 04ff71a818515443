// What a scene lets steer its texture, in terms of one frame's motion.
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

// Reads the scene's painted volume, where it has one. Throws std::runtime_error that names the file and what
// is wrong.
TextureGuidance textureGuidance(const scenes::Scene& scene);

// Gives every level of the surface the guidance that is wanted on it (SurfaceMesh::guidance; foam too, where
// that is what it follows); none where the scene has none. What moves the surface is not known in the first
// frame: speed, vorticity and foam are 0 there. Ages and foam that was carried are level 0's; coarser levels
// stand for surface that has just come to light. seconds: since the earlier frame.
void guide(const TextureGuidance& guidance, const sim::Frame& frame, const texture::Carried& carried,
           double seconds, texture::Surface& surface);

}  // namespace fluidtex::pipeline
