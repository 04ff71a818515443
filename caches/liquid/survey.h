// What has to be known of a cache before its frames are read one by one.
#pragma once

#include "caches/liquid/cache.h"

namespace fluidtex::caches {

struct Survey {
  Layout layout;
  double voxel = 0.0;  // side of the level sets' cells, metres
  // Of particles, in the files' unit: Options::radius, or the median of what particleRadius() is in those
  // frames (the larger of two), so that surfaces do not swell and shrink with what is estimated anew. Else 0.
  double radius = 0.0;
  // Of the surface in the first frame that has one, a middle one and the last, metres; with Options::follow
  // in the first alone.
  openvdb::BBoxd bounds;
};

// Recognizes the cache and reads those three surfaces. Throws LayoutError (also where no frame holds a
// surface) or FormatError.
Survey survey(const Options& options);

}  // namespace fluidtex::caches
