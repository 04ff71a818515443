// Estimate of a run's time.
#pragma once

#include "pipeline/liquid_plan.h"
#include "scenes/scene.h"

#include <string>

namespace fluidtex::tools {

// Seconds on so many threads, of a frame where the liquid is lively.
struct PlannedTime {
  double simulate = 0.0, texture = 0.0, render = 0.0;
  double firstTexture = 0.0;  // of the first frame, with the exemplar's tables, if they are not kept yet
  double frame() const { return simulate + texture + render; }
};

// points: on the surface; pixels: of the exemplar. What sources bring, and reading another program's files,
// is not in it. Leads, not promises: within a factor of two or so on a processor of these years.
PlannedTime plannedTime(const scenes::Scene& scene, const pipeline::LiquidPlan& liquid, double points,
                        double pixels, int threads);

// A sentence where the exemplar is used turned or mirrored in so many ways that texture takes much longer;
// else empty.
std::string waysNote(const texture::OrientationOptions& orientation);

}  // namespace fluidtex::tools
