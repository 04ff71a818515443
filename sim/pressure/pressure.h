// Pressure that makes the liquid's velocity free of divergence, and the velocity after it.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/solids/solids.h"

#include <openvdb/openvdb.h>

#include <cstdint>

namespace fluidtex::sim {

struct PressureOptions {
  double tolerance = 1e-6;  // of the residual's 2-norm, relative to the right-hand side's
  int maxIterations = 200;  // of each solve
  // Liquid at a solid whose pressure falls below -suction (Pa) lets go of it. A tenth of a cell's weight per
  // area, 0.1 density |g| h, keeps still water calm.
  double suction = 0.0;
  int maxSeparationPasses = 4;  // solves after the first; 0: liquid never lets go
  // What Projection::swelling is to carry out of the liquid's cells more than into them, h^3 per second at
  // their centres; null for nothing. Where liquid is enclosed on all sides it is evened out.
  FloatGrid::Ptr growth = nullptr;
  // N/m: the pressure at the surface is that times its curvature, and not 0 (Young and Laplace).
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
  // Faces whose velocity is now right: open ones that touch liquid, but not those between it and the air of
  // which a solid leaves less than kLeastOpen, and closed ones that touch liquid and lie square to the solid
  // (0 there, or the speed at which liquid leaves it). All others are for the caller to extrapolate.
  FaceMasks valid;
  // Faces in open sides of the domain that are shut, 0 and valid: they would draw in what is not there.
  std::vector<Face> shut;
  // Cells of liquid that leave a solid; where such a cell is deep in it, those beside it too.
  MaskGrid::Ptr separating;
  // What makes the liquid grow (PressureOptions::growth), on the valid faces: a potential flow beside the
  // velocity, 0 at solids and at faces with a given velocity. It moves the surface, and is no part of the
  // liquid's momentum. Null grids without growth.
  Velocity expansion;
  openvdb::DoubleGrid::Ptr
      pressure;  // Pa at the centres of liquid cells, active there; null unless asked for
  // The velocity before; null grids unless asked for. Copied after the solve, which takes the most memory.
  Velocity before;
};

// Projects u, v, w (m/s) onto fields free of divergence in the liquid (cells with phi < 0 that have an open
// face), but for what goes through faces that Projection::valid leaves out. phi in metres, at cell centres,
// of the index space of solid.phi; it must be valid one cell around the liquid, inside solids too. Pressure
// is 0 at the surface (see PressureOptions::surfaceTension), whose place between two cell centres is taken
// from phi (second order); solids are walls without friction, known by their open face areas and their speed,
// and liquid may leave them (see PressureOptions). On an open side of the domain pressure is 0, and nothing
// comes in. Faces with a given velocity get it, whatever the pressure. dt in s, density in kg/m3. Faces are
// written, and made active, where Projection::valid says; the rest stays as it was. The same bytes on any
// number of threads. Does not throw when it fails to converge: the report says so; throws
// std::invalid_argument where dt or density is not positive. Sources: Gibou, Fedkiw, Cheng, Kang 2002
// (surface); Ng, Min, Gibou 2009 (solids); Batty, Bertails, Bridson 2007, section 5 (separation).
[[nodiscard]] Projection project(FloatGrid& u, FloatGrid& v, FloatGrid& w, const FloatGrid& phi,
                                 const SolidField& solid, double dt, double density,
                                 const PressureOptions& options = {});

}  // namespace fluidtex::sim
