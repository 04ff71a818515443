// Liquid cells of the pressure solve: their numbering, and what lies on each of their six sides.
// Free surface: pressure 0 where phi is 0, between two centres; Gibou, Fedkiw, Cheng, Kang, "A
// second-order-accurate symmetric discretization of the Poisson equation on irregular domains", 2002. Solids:
// fluxes through the open part of each face; Ng, Min, Gibou, "An efficient fluid-solid coupling algorithm for
// single-phase flows", 2009.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/poisson/poisson.h"
#include "sim/solids/solids.h"

#include <array>
#include <vector>

namespace fluidtex::sim {

// Distance from a cell's centre to the surface on an open side of the domain, in cells.
inline constexpr float kEdgeTheta = 0.5f;

// What lies on the six sides of a liquid cell. Pressure is kept as q = p dt / (density h), a velocity.
struct LiquidSides {
  std::array<float, kSides> open{};   // area fraction
  std::array<float, kSides> theta{};  // distance to the surface, in cells; 0 where the neighbour is not air
  float closed = 0.0f;                // sum of closed area, of separating solids
  float leaving = 0.0f;               // before projection: sum of closed area times velocity away from it

  bool operator==(const LiquidSides&) const = default;
};

// In the liquid's interior all sides are open and lead to liquid.
inline constexpr LiquidSides kAllLiquid{{1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f}, {}};

// A face of a liquid cell on an open side of the domain: there the surface is.
struct Edge {
  int cell, side;
  double outward;  // velocity before projection
  bool shut;       // closed, since there would be inflow
};

struct LiquidCells {
  std::vector<CellBlock> blocks;
  CellNumbering numbering;
  // Before projection: sum of open area times outward velocity, and of closed area times the solid's.
  std::vector<double> outflow;
  // Index of a cell into `sides`, or -1 for kAllLiquid, as for most cells, but none with an edge.
  std::vector<int> special;
  std::vector<LiquidSides> sides;
  std::vector<Edge> edges;

  const LiquidSides& sidesOf(int cell) const { return special[cell] < 0 ? kAllLiquid : sides[special[cell]]; }
};

// The neighbour of a cell on a side: 0 towards -x, 1 towards +x, 2 towards -y, ...
inline Coord neighborOf(Coord cell, int side) {
  cell[side >> 1] += (side & 1) ? 1 : -1;
  return cell;
}

// Whether the domain ends on this side of a cell, and that side is of the given kind.
bool endsAt(Side kind, const SolidField& solid, const Coord& cell, int side);

// The cells of the domain with phi < 0 that have an open face whose velocity is not given. velocity: u, v, w
// before the projection, m/s.
LiquidCells gatherLiquid(const FloatGrid& phi, const SolidField& solid,
                         const std::array<const FloatTree*, 3>& velocity);

}  // namespace fluidtex::sim
