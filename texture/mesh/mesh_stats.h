// Statistics of a triangle mesh for run.json.
#pragma once

#include "texture/surface.h"

namespace fluidtex::texture {

struct MeshStats {
  int components = 0;
  double edgeMean = 0.0;  // m
  double edgeCv = 0.0;    // standard deviation of the edge lengths over their mean
  // Both 0 on a fair surface (texture/mesh/fair.h).
  int folded = 0;  // edges whose two triangles have normals more than 90 degrees apart
  int spikes =
      0;  // vertices farther from the mean of their neighbours, along their normal, than half their mean edge
};

// Edges are counted once per adjacent triangle. An empty mesh gives zeros. normals: #V, unit; without them
// spikes is 0.
MeshStats meshStats(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles,
                    const std::vector<Vec3f>& normals = {});

}  // namespace fluidtex::texture
