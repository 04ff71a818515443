// Estimate of a run's time.
#pragma once

#include "pipeline/liquid_plan.h"
#include "scenes/scene.h"

#include <string>

namespace fluidtex::tools {

// Seconds on the given number of threads, for a frame in which the liquid moves much.
struct PlannedTime {
  double simulate = 0.0, texture = 0.0, render = 0.0;
  double firstTexture = 0.0;  // of the first frame, with search tables that are not cached yet
  double frame() const { return simulate + texture + render; }
};

// points: on the surface; pixels: of the exemplar. Without liquid from sources, and without reading files of
// other programs. Calibrated on an x86-64 server of 2026; right to a factor of about two on similar ones.
PlannedTime plannedTime(const scenes::Scene& scene, const pipeline::LiquidPlan& liquid, double points,
                        double pixels, int threads);

// A sentence where the exemplar is used turned or mirrored in so many ways that texture takes much longer;
// else empty.
std::string waysNote(const texture::OrientationOptions& orientation);

}  // namespace fluidtex::tools
