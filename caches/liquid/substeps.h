// The substeps of a frame whose velocity is known at its begin and its end.
#pragma once

#include "sim/frame/frame.h"
#include "sim/grid/mac_grid.h"

#include <vector>

namespace fluidtex::caches {

// The two velocities, mixed in time with this mean weight (weightAt()): one substep where it is 0 or 1, so
// that one of the two stands alone; else one for each two cells of the faster one's motion, at most four,
// with the velocities of their middles. Where the grids of the two lie differently, the first part of the
// frame, 1 - meanWeight, has that of the begin. seconds: of the frame.
std::vector<sim::Substep> substepsOf(const sim::FaceGrids& begin, const sim::FaceGrids& end,
                                     double meanWeight, double seconds);

}  // namespace fluidtex::caches
