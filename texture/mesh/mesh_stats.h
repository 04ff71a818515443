// Figures on a triangle mesh: what run.json says about the surface of a frame.
#pragma once

#include "texture/surface.h"

namespace fluidtex::texture {

struct MeshStats {
  int components = 0;
  double edgeMean = 0.0;  // m
  double edgeCv = 0.0;    // standard deviation of the edge lengths over their mean
  // Both 0 on a surface that is fair (texture/mesh/fair.h).
  int folded = 0;  // edges whose two triangles have normals more than 90 degrees apart
  int spikes =
      0;  // vertices farther from the mean of their neighbours, along their normal, than half their mean edge
};

// Edges are counted once for each triangle at them. An empty mesh gives zeros. normals: #V, unit; without
// them there are no spikes.
MeshStats meshStats(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles,
                    const std::vector<Vec3f>& normals = {});

}  // namespace fluidtex::texture
