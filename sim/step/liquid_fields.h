// Fields of a liquid that its surface determines.
#pragma once

#include "sim/flows/flows.h"
#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"
#include "sim/step/liquid.h"

namespace fluidtex::sim {

// Width of a cell, m.
double voxelSize(const Liquid& liquid);

// Zero velocity with a topology for this phi: the liquid, its narrow band, and the first layers of solids
// there.
Velocity velocityFor(const FloatGrid& phi, const SolidField& solid);

// Adds `change` (m/s) to all active faces.
void addGravity(Velocity& velocity, const Vec3d& change);

// Layers of cells beyond the liquid to which its temperature is extrapolated: newly wet cells of a step lie
// within.
inline constexpr int kTemperatureLayers = 6;

// Sets the temperature of sources, which their liquid gets.
void setSourceTemperature(FloatGrid& temperature, const RunningFlows& flows);

}  // namespace fluidtex::sim
