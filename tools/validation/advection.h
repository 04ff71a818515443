// A shape carried by a known flow with the solver's own kernels (sim/flows/move_surface.h), and what became
// of it.
#pragma once

#include "sim/motion/known_flow.h"
#include "tools/validation/case.h"
#include "tools/validation/measure.h"

#include <utility>

namespace fluidtex::validation {

struct AdvectionTest {
  Distance start, end;  // the shape before and after
  sim::KnownFlow flow;
  double width = 1.0, height = 1.0;  // of the domain along x and y; 2D tests are a slab along z
  bool slab = true;
  double surface = 0.0;  // length of the exact outline (slab) or area of the surface
  double cfl = 1.0;
  int turns = 1;          // how often the flow runs through
  double sliceAt = 0.35;  // height of the outlines that a volume gives, metres
};

// Measures are areas for a slab, volumes else.
struct AdvectionResult {
  double volumeBefore = 0.0, volumeAfter = 0.0, volumeHalf = 0.0;
  double difference = 0.0, floor = 0.0;  // from the exact shape: after, and as the measure has it before
  double farthest = 0.0, farthestBefore = 0.0;
  double divergence = 0.0;  // largest of the face velocities, times h over the greatest speed
  int steps = 0;
  // Outlines in the middle of the slab, or at the height AdvectionTest::sliceAt of a volume.
  std::vector<std::array<double, 2>> before, half, after;

  double volumeError() const { return volumeAfter / volumeBefore - 1.0; }
};

// `resolution`: cells to one metre.
AdvectionResult run(const AdvectionTest& test, int resolution, const Progress& progress);

}  // namespace fluidtex::validation
