// The liquid as the pressure sees it: its cells, numbered, with what lies on each of their six sides.
// The surface: pressure 0 where phi is, between two centres; Gibou, Fedkiw, Cheng, Kang, "A
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

// From a cell's centre to the surface on the domain's open side, in cells.
inline constexpr float kEdgeTheta = 0.5f;

// What lies on the six sides of a liquid cell. Pressure is kept as q = p dt / (density h), a velocity.
struct LiquidSides {
  std::array<float, kSides> open{};   // area share
  std::array<float, kSides> theta{};  // to the surface, in cells; 0 where the neighbour is not air
  float closed = 0.0f;                // sum of closed area, of solids that liquid can let go of
  float leaving = 0.0f;               // before projection: sum of closed area times velocity away from it

  bool operator==(const LiquidSides&) const = default;
};

// In the liquid's middle all sides are open and lead to liquid.
inline constexpr LiquidSides kAllLiquid{{1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f}, {}};

// A face through which a liquid cell meets an open side of the domain: there the surface is.
struct Edge {
  int cell, side;
  double outward;  // velocity before projection
  bool shut;       // it would draw in what is not there
};

struct LiquidCells {
  std::vector<CellBlock> blocks;
  CellNumbering numbering;
  // Before projection: sum of open area times outward velocity, and of closed area times the solid's.
  std::vector<double> outflow;
  // A cell's own place in `sides`, or -1: kAllLiquid, as most cells are, but none with an edge.
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

// Whether the domain ends on this side of a cell, and the side is of that kind.
bool endsAt(Side kind, const SolidField& solid, const Coord& cell, int side);

// The cells of the domain with phi < 0 that have an open face whose velocity is not given. velocity: u, v, w
// before the projection, m/s.
LiquidCells gatherLiquid(const FloatGrid& phi, const SolidField& solid,
                         const std::array<const FloatTree*, 3>& velocity);

}  // namespace fluidtex::sim
