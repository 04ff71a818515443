// Figures on a triangle mesh: what run.json says about the surface of a frame.
#pragma once

#include "texture/surface.h"

namespace fluidtex::texture {

struct MeshStats {
  int components = 0;
  double edgeMean = 0.0;  // m
  double edgeCv = 0.0;    // standard deviation of the edge lengths over their mean
};

// Edges are counted once for each triangle at them. An empty mesh gives zeros.
MeshStats meshStats(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles);

}  // namespace fluidtex::texture
