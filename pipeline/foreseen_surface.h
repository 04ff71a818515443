// How much surface a scene's liquid will have, as far as its shapes and sources tell.
#pragma once

#include "scenes/scene.h"

namespace fluidtex::pipeline {

// m3 that sources bring until the scene's last frame, by what leaves through their fronts. What a source
// without a velocity brings is taken to fall out of it.
double inflow(const scenes::Scene& scene);

// m2. All bodies' surface once they are poured; and of what sources bring the least of a sheet one cell
// thick, both sides, and of a pool all over the domain. 0 where all liquid is there from the start: the first
// frame shows it.
double foreseenSurface(const scenes::Scene& scene);

// Metres: the distance of texture.points points on that surface; 0 where none is foreseen. A spacing that
// were taken from the first trickle of a tap would put millions of points on the pool that it fills.
double foreseenSpacing(const scenes::Scene& scene);

}  // namespace fluidtex::pipeline
