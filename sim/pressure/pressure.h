// Pressure projection: makes the liquid's velocity divergence-free.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

#include <openvdb/openvdb.h>

#include <cstdint>

namespace fluidtex::sim {

struct PressureOptions {
  double tolerance = 1e-6;  // of the residual's 2-norm, relative to the right-hand side's
  int maxIterations = 200;  // of each solve
  // Suction threshold in Pa: liquid at a solid separates where its pressure falls below -suction. A tenth of
  // a cell's weight per area, 0.1 density |g| h, keeps liquid at rest calm.
  double suction = 0.0;
  int maxSeparationPasses = 4;  // solves after the first; 0: liquid never separates
  // Divergence of Projection::expansion in liquid cells, h^3 per second at their centres; null for none.
  // Where liquid is enclosed on all sides only its deviation from the mean counts.
  FloatGrid::Ptr divergence = nullptr;
  // N/m. The pressure at the surface is this times the curvature (Young and Laplace).
  double surfaceTension = 0.0;
  bool keepPressure = false;  // fill Projection::pressure
  bool keepBefore = false;    // fill Projection::before
};

struct PressureReport {
  bool converged = false;
  int iterations = 0;      // of all solves together
  double residual = 0.0;   // relative 2-norm at the end
  std::int64_t cells = 0;  // unknowns
  int separationPasses = 0;
};

struct Face {
  int axis;
  Coord at;
};

struct Projection {
  PressureReport report;
  // Faces that have their final velocity: open ones that touch liquid, but not those towards the air with
  // less than kLeastOpen of their area open; and closed ones that touch liquid and are square to the solid (0
  // there, or the speed at which liquid separates). The caller extrapolates to all others.
  FaceMasks valid;
  // Closed faces on open sides of the domain, with velocity 0 and valid: there would be inflow.
  std::vector<Face> shut;
  // Liquid cells that separate from a solid; where such a cell is deep in the solid, its neighbours too.
  MaskGrid::Ptr separating;
  // Velocity whose divergence restores the volume deficit (PressureOptions::divergence), on the valid faces:
  // a separate potential flow, 0 at solids and at faces with a given velocity. It moves the surface, but is
  // not part of the liquid's momentum. No grids without one.
  Velocity expansion;
  openvdb::DoubleGrid::Ptr
      pressure;  // Pa at the centres of liquid cells, active there; null unless asked for
  // Velocity before the projection; null grids unless asked for. Copied after the solve, which takes the most
  // memory.
  Velocity before;
};

// Projects u, v, w (m/s) onto divergence-free fields in the liquid: cells with phi < 0 that have an open
// face. Flow through faces that Projection::valid leaves out is not counted.
// phi: metres, at cell centres, in the index space of solid.phi. It must be valid one cell around the liquid,
// inside solids too. dt: s. density: kg/m3.
// Surface: pressure 0 (see PressureOptions::surfaceTension), at its place between two cell centres by phi,
// second-order. Solids: free-slip walls, given by open face areas and speed; liquid may separate from them
// (see PressureOptions). Open sides of the domain: pressure 0 and no inflow. Faces with a given velocity get
// it, whatever the pressure; but sources in enclosed liquid are slowed (sim/pressure/slowed_sources.h).
// Faces are written and made active where Projection::valid says; the rest keeps its values. Bit-identical on
// any number of threads.
// Where it fails to converge the report says so. Throws std::invalid_argument where dt or density is not
// positive.
// Sources: Gibou, Fedkiw, Cheng, Kang 2002 (surface); Ng, Min, Gibou 2009 (solids); Batty, Bertails, Bridson
// 2007, section 5 (separation).
[[nodiscard]] Projection project(Velocity& velocity, const FloatGrid& phi, const SolidField& solid, double dt,
                                 double density, const PressureOptions& options = {});

}  // namespace fluidtex::sim
