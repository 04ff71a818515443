// Estimate of how much surface a scene's liquid will have, from its shapes and sources.
#pragma once

#include "scenes/scene.h"

namespace fluidtex::pipeline {

// m3 that sources bring until the scene's last frame: area of their front faces times velocity. A source
// without velocity counts with the speed of a fall over its own height.
double inflow(const scenes::Scene& scene);

// m2: the surface of all bodies once poured, plus, for what sources bring, the smaller of a sheet one cell
// thick (both sides) and a pool over the whole domain. 0 if all liquid is there from the start: the first
// frame shows it.
double foreseenSurface(const scenes::Scene& scene);

// Metres: spacing of texture.points points on that surface; 0 where none is foreseen. A spacing chosen for
// the first trickle of a tap would put millions of points on the pool that it fills.
double foreseenSpacing(const scenes::Scene& scene);

}  // namespace fluidtex::pipeline
