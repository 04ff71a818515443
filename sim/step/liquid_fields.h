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

// A scalar that moves with the liquid, and the value of it that a body and a source bring.
struct CarriedScalar {
  FloatGrid::Ptr Liquid::*grid;
  double LiquidBody::*ofBody;
  double SourceGrids::*ofSource;
};
inline constexpr CarriedScalar kCarriedScalars[] = {
    {&Liquid::temperature, &LiquidBody::temperature, &SourceGrids::temperature},
    {&Liquid::mixture, &LiquidBody::mixture, &SourceGrids::mixture}};

// Sets a scalar in the cells of sources to the value that their liquid has.
void setInSources(FloatGrid& scalar, const RunningFlows& flows, double SourceGrids::*value);

}  // namespace fluidtex::sim
