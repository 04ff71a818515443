// Estimate of how much surface a scene's liquid will have, from its shapes and sources.
#pragma once

#include "scenes/scene.h"

namespace fluidtex::pipeline {

// Volume, m3, that sources add until the scene's last frame: area of their front faces times velocity and
// rate, summed over the time in which they run. A source without velocity counts with the speed of free fall
// over its own height. Throws sim::MeshError and sim::HeightError, as the two functions below do.
double inflow(const scenes::Scene& scene);

// m2: the surface of all bodies once poured, plus, for what sources bring, the smaller of a sheet one cell
// thick (both sides) and a pool over the whole domain. 0 if all liquid is there from the start: the first
// frame shows it.
double foreseenSurface(const scenes::Scene& scene);

// Metres: spacing of texture.points points on that surface; 0 where none is foreseen. A spacing chosen for
// the first trickle of a tap would put millions of points on the pool that it fills.
double foreseenSpacing(const scenes::Scene& scene);

}  // namespace fluidtex::pipeline
