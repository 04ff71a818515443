// Pressure projection on the liquid's cells.
// The surface: pressure 0 where phi is, between two centres; Gibou, Fedkiw, Cheng, Kang, "A
// second-order-accurate symmetric discretization of the Poisson equation on irregular domains", 2002. Solids:
// fluxes through the open part of each face; Ng, Min, Gibou, "An efficient fluid-solid coupling algorithm for
// single-phase flows", 2009.
// Walls that let go: 0 <= p, complementary to 0 <= outflow, in cells at solids; Batty, Bertails, Bridson, "A
// fast variational framework for accurate solid-fluid coupling", 2007, section 5. Solved by the primal-dual
// active set method: Hintermueller, Ito, Kunisch, 2002.
#include "sim/pressure.h"

#include "sim/level_set.h"
#include "sim/mac_grid.h"
#include "sim/poisson.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace fluidtex::sim {

namespace {

using Range = tbb::blocked_range<int>;

// A surface nearer to a cell's centre than this share of a cell counts as this far away, in the matrix and in
// the velocity alike: bounds the matrix' entries.
constexpr float kMinTheta = 0.01f;

// Below this share of the largest pressure, suction is the solver's rounding.
constexpr double kSuctionNoise = 1e-5;

// From a cell's centre to the surface on the domain's open side, in cells.
constexpr float kEdgeTheta = 0.5f;

// A face whose solid lies within about 25 degrees of square to it takes the solid's normal velocity.
constexpr float kSquare = 0.9f;

// One liquid cell and its six sides. Pressure is kept as q = p dt / (density h), a velocity.
struct LiquidCell {
  std::array<float, kSides> open;   // area share
  std::array<float, kSides> theta;  // to the surface, in cells; 0 where the neighbour is not air
  // Before projection: sum of open area times outward velocity, and of closed area times the solid's.
  double outflow = 0.0;
  float closed = 0.0f;   // sum of closed area
  float leaving = 0.0f;  // before projection: sum of closed area times velocity away from it
};

// A face through which a liquid cell meets an open side of the domain: there the surface is.
struct Edge {
  int cell, side;
  double outward;  // velocity before projection
  bool shut;       // it would draw in what is not there
};

struct Liquid {
  std::vector<CellBlock> blocks;
  CellNumbering numbering;
  std::vector<LiquidCell> cells;
  std::vector<Edge> edges;
};

constexpr int kSide = kLeafDim + 2;  // a leaf's values and one more layer around them
constexpr int kStride[3] = {kSide * kSide, kSide, 1};
using Patch = std::array<float, kSide * kSide * kSide>;

Coord localOf(int offset) {
  return Coord(offset >> 6, (offset >> 3) & 7, offset & 7);
}

int patchIndex(int local) {
  return ((local >> 6) + 1) * kStride[0] + (((local >> 3) & 7) + 1) * kStride[1] + (local & 7) + 1;
}

Coord neighborOf(Coord cell, int side) {
  cell[side >> 1] += (side & 1) ? 1 : -1;
  return cell;
}

Patch patchOf(const FloatTree& tree, const Coord& origin) {
  Patch patch{};
  gather(tree, origin, 1, patch.data(), true);
  return patch;
}

// Open shares of the three kinds of faces around one block.
std::array<Patch, 3> openPatches(const SolidField& solid, const Coord& origin) {
  return {patchOf(solid.openU->constTree(), origin), patchOf(solid.openV->constTree(), origin),
          patchOf(solid.openW->constTree(), origin)};
}

// A field that is 0 where there is none, or of which there may be no tree.
Patch patchOf(const FloatGrid::Ptr& grid, const Coord& origin, float without) {
  if (grid != nullptr) return patchOf(grid->constTree(), origin);
  Patch patch;
  patch.fill(without);
  return patch;
}

// Velocities that are given around one block, kNotGiven elsewhere.
std::array<Patch, 3> givenPatches(const SolidField& solid, const Coord& origin) {
  return {patchOf(solid.givenU, origin, kNotGiven), patchOf(solid.givenV, origin, kNotGiven),
          patchOf(solid.givenW, origin, kNotGiven)};
}

// Cells of the domain with phi < 0 and an open face whose velocity is not given.
std::vector<CellBlock> liquidBlocks(const FloatGrid& phi, const SolidField& solid) {
  const std::vector<Coord> origins = wetLeaves(phi, solid.cells, 0);
  std::vector<CellBlock> blocks(origins.size());
  tbb::parallel_for(Range(0, static_cast<int>(blocks.size())), [&](const Range& range) {
    for (int b = range.begin(); b < range.end(); ++b) {
      CellBlock& block = blocks[b];
      block.origin = origins[b];
      const FloatLeaf* leaf = phi.constTree().probeConstLeaf(block.origin);
      for (int c = 0; c < kLeafSize; ++c) {
        const Coord cell = block.origin.offsetBy(c >> 6, (c >> 3) & 7, c & 7);
        const bool inside = cell[0] < solid.cells[0] && cell[1] < solid.cells[1] && cell[2] < solid.cells[2];
        block.cells[c] = inside && (leaf == nullptr || leaf->getValue(c) < 0.0f);
      }
      if (block.cells.none()) continue;
      const auto open = openPatches(solid, block.origin);
      const auto given = givenPatches(solid, block.origin);
      for (int c = 0; c < kLeafSize; ++c) {
        const int at = patchIndex(c);
        bool any = false;
        for (int a = 0; a < 3; ++a) {
          for (const int face : {at, at + kStride[a]})
            any = any || (open[a][face] > 0.0f && given[a][face] == kNotGiven);
        }
        if (!any) block.cells.reset(c);
      }
    }
  });
  std::erase_if(blocks, [](const CellBlock& block) { return block.cells.none(); });
  return blocks;
}

// Whether the neighbour of a cell on this side lies beyond an open side of the domain.
bool beyondEdge(const SolidField& solid, const Coord& cell, int side) {
  const int axis = side >> 1;
  return solid.sides[side] == Side::open && cell[axis] == (side & 1 ? solid.cells[axis] - 1 : 0);
}

Liquid gatherLiquid(const FloatGrid& phiGrid, const SolidField& solid,
                    const std::array<const FloatTree*, 3>& velocity) {
  const FloatTree& phi = phiGrid.constTree();
  Liquid liquid;
  liquid.blocks = liquidBlocks(phiGrid, solid);
  liquid.numbering = CellNumbering(liquid.blocks, solid.cells);
  liquid.cells.resize(liquid.numbering.size());
  tbb::parallel_for(Range(0, static_cast<int>(liquid.blocks.size())), [&](const Range& range) {
    for (int b = range.begin(); b < range.end(); ++b) {
      const Coord& origin = liquid.blocks[b].origin;
      const int* numbers = liquid.numbering.block(origin);
      const Patch distance = patchOf(phi, origin);
      const auto open = openPatches(solid, origin);
      const std::array<Patch, 3> speed{patchOf(*velocity[0], origin), patchOf(*velocity[1], origin),
                                       patchOf(*velocity[2], origin)};
      const std::array<Patch, 3> solidSpeed{patchOf(solid.speedU, origin, 0.0f),
                                            patchOf(solid.speedV, origin, 0.0f),
                                            patchOf(solid.speedW, origin, 0.0f)};
      const auto given = givenPatches(solid, origin);
      for (int c = 0; c < kLeafSize; ++c) {
        if (numbers[c] < 0) continue;
        LiquidCell& cell = liquid.cells[numbers[c]];
        const int here = patchIndex(c);
        for (int s = 0; s < kSides; ++s) {
          const int axis = s >> 1, up = s & 1;
          const int face = here + up * kStride[axis];
          const int beside = up ? here + kStride[axis] : here - kStride[axis];
          const float out = up ? 1.0f : -1.0f, closed = 1.0f - open[axis][face];
          const bool isGiven = given[axis][face] != kNotGiven;
          const double outward = out * (isGiven ? given[axis][face] : speed[axis][face]);
          const double push = out * solidSpeed[axis][face];
          cell.outflow += open[axis][face] * outward + closed * push;
          if (isGiven) {
            cell.open[s] = cell.theta[s] = 0.0f;
            continue;
          }
          cell.open[s] = open[axis][face];
          cell.closed += closed;
          cell.leaving += closed * static_cast<float>(std::max(0.0, push - outward));
          if (cell.open[s] > 0.0f && beyondEdge(solid, origin + localOf(c), s)) {
            cell.theta[s] = kEdgeTheta;
            continue;
          }
          const float inside = distance[here], outside = distance[beside];
          cell.theta[s] = cell.open[s] > 0.0f && outside >= 0.0f
                              ? std::max(kMinTheta, inside / (inside - outside))
                              : 0.0f;
        }
      }
    }
  });
  if (std::find(solid.sides.begin(), solid.sides.end(), Side::open) != solid.sides.end()) {
    for (int i = 0; i < liquid.numbering.size(); ++i) {
      const Coord& place = liquid.numbering.cells()[i];
      for (int s = 0; s < kSides; ++s) {
        if (liquid.cells[i].open[s] <= 0.0f || !beyondEdge(solid, place, s)) continue;
        const double along = velocity[s >> 1]->getValue(s & 1 ? neighborOf(place, s) : place);
        liquid.edges.push_back({i, s, s & 1 ? along : -along, false});
      }
    }
  }
  return liquid;
}

// Nothing comes in over an edge: where the pressure would draw it in, the face is shut. True if any was.
bool shutEdges(Liquid& liquid, const std::vector<double>& q) {
  bool any = false;
  for (Edge& edge : liquid.edges) {
    LiquidCell& cell = liquid.cells[edge.cell];
    if (edge.shut || edge.outward + q[edge.cell] / kEdgeTheta >= 0.0) continue;
    // A cell's only way out stays one.
    if (std::count_if(cell.open.begin(), cell.open.end(), [](float open) { return open > 0.0f; }) < 2)
      continue;
    edge.shut = any = true;
    cell.outflow -= cell.open[edge.side] * edge.outward;
    cell.open[edge.side] = cell.theta[edge.side] = 0.0f;
  }
  return any;
}

// The system of the cells that are not detached; `liquidOf` gets each unknown's number as a liquid cell.
PoissonSystem assemble(const Liquid& liquid, const std::vector<char>& detached, std::vector<int>& liquidOf) {
  PoissonSystem system;
  std::vector<CellBlock> blocks = liquid.blocks;
  for (CellBlock& block : blocks) {
    const int* numbers = liquid.numbering.block(block.origin);
    for (int c = 0; c < kLeafSize; ++c) {
      if (numbers[c] >= 0 && detached[numbers[c]]) block.cells.reset(c);
    }
  }
  std::erase_if(blocks, [](const CellBlock& block) { return block.cells.none(); });
  system.numbering = CellNumbering(blocks, liquid.numbering.extent());
  const int n = system.numbering.size();
  system.rows.resize(n);
  system.anchor.assign(n, 0.0);
  system.anchoredSides.assign(n, 0);
  liquidOf.resize(n);
  tbb::parallel_for(Range(0, n, 1024), [&](const Range& range) {
    for (int i = range.begin(); i < range.end(); ++i) {
      const Coord& place = system.numbering.cells()[i];
      liquidOf[i] = liquid.numbering.at(place);
      const LiquidCell& cell = liquid.cells[liquidOf[i]];
      for (int s = 0; s < kSides; ++s) {
        const int neighbor = system.numbering.at(neighborOf(place, s));
        const bool linked = cell.open[s] > 0.0f && neighbor >= 0;
        system.rows[i].neighbor[s] = linked ? neighbor : n;
        system.rows[i].link[s] = linked ? cell.open[s] : 0.0f;
        if (cell.open[s] > 0.0f && !linked) {
          // The surface, or a detached cell with pressure 0 at its centre.
          system.anchor[i] +=
              static_cast<double>(cell.open[s]) / (cell.theta[s] > 0.0f ? cell.theta[s] : 1.0f);
          system.anchoredSides[i] |= static_cast<std::uint8_t>(1 << s);
        }
      }
    }
  });
  return system;
}

// What flows out of a cell's open faces once the pressure has acted.
double projectedOutflow(const Liquid& liquid, const std::vector<double>& q, int number) {
  const LiquidCell& cell = liquid.cells[number];
  const Coord& place = liquid.numbering.cells()[number];
  double outflow = cell.outflow;
  for (int s = 0; s < kSides; ++s) {
    if (cell.open[s] <= 0.0f) continue;
    const bool surface = cell.theta[s] > 0.0f;
    const int neighbor = surface ? -1 : liquid.numbering.at(neighborOf(place, s));
    const double step = (neighbor < 0 ? 0.0 : q[neighbor]) - q[number];
    outflow -= cell.open[s] * (surface ? step / cell.theta[s] : step);
  }
  return outflow;
}

// One step of the active set method: cells at solids that let go of them, or are pressed back. True if any
// changed. What a cell can suck is held back by its own surface: of a drop of one cell only a share of
// `suction`, which is that of a cell with a column of liquid below it; less than `rounding` is none.
bool updateDetached(const Liquid& liquid, const std::vector<double>& q, const std::vector<char>& enclosed,
                    double suction, double rounding, std::vector<char>& detached) {
  const int n = liquid.numbering.size();
  std::vector<char> changed(n, 0);
  tbb::parallel_for(Range(0, n, 1024), [&](const Range& range) {
    for (int i = range.begin(); i < range.end(); ++i) {
      const LiquidCell& cell = liquid.cells[i];
      if (cell.closed <= 0.0f) continue;
      double anchored = 1.0;
      for (int s = 0; s < kSides; ++s) {
        if (cell.theta[s] > 0.0f) anchored += cell.open[s] / cell.theta[s];
      }
      changed[i] = detached[i] ? projectedOutflow(liquid, q, i) < 0.0
                               : q[i] < -std::max(suction / anchored, rounding) && !enclosed[i];
    }
  });
  bool any = false;
  for (int i = 0; i < n; ++i) {
    if (!changed[i]) continue;
    detached[i] = !detached[i];
    any = true;
  }
  return any;
}

// Leaves of `grid` that hold a face of a liquid cell; made where they were missing. They are the same for
// every axis, so that the components keep one topology.
std::vector<FloatLeaf*> faceLeaves(const Liquid& liquid, FloatGrid& grid) {
  std::vector<FloatLeaf*> leaves;
  for (const CellBlock& block : liquid.blocks) {
    leaves.push_back(grid.tree().touchLeaf(block.origin));
    for (int axis = 0; axis < 3; ++axis) {
      Coord next = block.origin;
      next[axis] += kLeafDim;
      leaves.push_back(grid.tree().touchLeaf(next));
    }
  }
  std::sort(leaves.begin(), leaves.end(),
            [](const FloatLeaf* a, const FloatLeaf* b) { return a->origin() < b->origin(); });
  leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
  return leaves;
}

const int* blockNumbers(const CellNumbering& numbering, const Coord& origin) {
  for (int a = 0; a < 3; ++a) {
    if (origin[a] < 0 || origin[a] >= numbering.extent()[a]) return nullptr;
  }
  return numbering.block(origin);
}

// Subtracts the pressure's gradient on the faces normal to `axis`, and writes what is given there.
openvdb::MaskGrid::Ptr updateFaces(const Liquid& liquid, const SolidField& solid,
                                   const std::vector<double>& q, const std::vector<char>& detached, int axis,
                                   FloatGrid& grid) {
  const FloatGrid* const solidSpeed =
      std::array{solid.speedU.get(), solid.speedV.get(), solid.speedW.get()}[axis];
  const FloatGrid* const given = std::array{solid.givenU.get(), solid.givenV.get(), solid.givenW.get()}[axis];
  auto valid = openvdb::MaskGrid::create();
  valid->setTransform(faceTransform(solid.voxelSize, axis));
  const std::vector<FloatLeaf*> leaves = faceLeaves(liquid, grid);
  std::vector<openvdb::MaskGrid::TreeType::LeafNodeType*> masks;
  for (const FloatLeaf* leaf : leaves) masks.push_back(valid->tree().touchLeaf(leaf->origin()));

  const int stride = 1 << (3 * (2 - axis));
  tbb::parallel_for(Range(0, static_cast<int>(leaves.size())), [&](const Range& range) {
    const openvdb::tree::ValueAccessor<const FloatTree> distance(solid.phi->constTree());
    for (int n = range.begin(); n < range.end(); ++n) {
      FloatLeaf& leaf = *leaves[n];
      Coord before = leaf.origin();
      before[axis] -= kLeafDim;
      const int* here = blockNumbers(liquid.numbering, leaf.origin());
      const int* below = blockNumbers(liquid.numbering, before);
      for (int c = 0; c < kLeafSize; ++c) {
        const bool first = (c / stride) % kLeafDim == 0;
        const int* lowerBlock = first ? below : here;
        const int upper = here == nullptr ? -1 : here[c];
        const int lower = lowerBlock == nullptr ? -1 : lowerBlock[first ? c + 7 * stride : c - stride];
        if (upper < 0 && lower < 0) continue;

        const LiquidCell& cell = liquid.cells[upper >= 0 ? upper : lower];
        const int side = 2 * axis + (upper >= 0 ? 0 : 1);
        if (cell.open[side] > 0.0f) {
          const double step = (upper < 0 ? 0.0 : q[upper]) - (lower < 0 ? 0.0 : q[lower]);
          const double change = cell.theta[side] > 0.0f ? step / cell.theta[side] : step;
          leaf.setValueOn(c, static_cast<float>(leaf.getValue(c) - change));
          masks[n]->setValueOn(c);
          continue;
        }
        const Coord place = leaf.offsetToGlobalCoord(c);
        const float slope = distance.getValue(place) - distance.getValue(neighborOf(place, 2 * axis));
        const bool solidBelow = slope > 0.0f;
        const int wet = solidBelow ? upper : lower;
        if (std::abs(slope) < kSquare * solid.voxelSize || wet < 0) continue;
        const double push = solidSpeed == nullptr ? 0.0 : solidSpeed->constTree().getValue(place);
        double away = 0.0;
        if (detached[wet]) {
          // What the cell loses through its open faces comes off its walls, so that there is no divergence
          // there either; from each in proportion to the speed at which the liquid was about to leave it.
          const auto& [open, theta, outflow, closed, leaving] = liquid.cells[wet];
          const double relative = leaf.getValue(c) - push;
          const double ready = std::max(0.0, solidBelow ? relative : -relative);
          const double share = leaving > 0.0f ? ready / leaving : 1.0 / closed;
          away = std::max(0.0, projectedOutflow(liquid, q, wet)) * share;
        }
        leaf.setValueOn(c, static_cast<float>(push + (solidBelow ? away : -away)));
        masks[n]->setValueOn(c);
      }
    }
  });
  if (given != nullptr) {
    for (auto it = given->cbeginValueOn(); it; ++it) {
      grid.tree().setValueOn(it.getCoord(), *it);
      valid->tree().setValueOn(it.getCoord());
    }
  }
  return valid;
}

}  // namespace

Projection project(FloatGrid& u, FloatGrid& v, FloatGrid& w, const FloatGrid& phi, const SolidField& solid,
                   double dt, double density, const PressureOptions& options) {
  assert(dt > 0.0 && density > 0.0);
  Liquid liquid = gatherLiquid(phi, solid, {&u.constTree(), &v.constTree(), &w.constTree()});
  const int n = liquid.numbering.size();
  for (LiquidCell& cell : liquid.cells) {
    cell.outflow -= options.expansion * solid.voxelSize * (1.0 - cell.closed / kSides);
  }
  const double pascal = density * solid.voxelSize / dt;  // of one unit of q

  Projection result;
  PressureReport& report = result.report;
  report.cells = n;
  report.converged = true;
  std::vector<double> q(n, 0.0);
  std::vector<char> detached(n, 0);
  for (int pass = 0; n > 0; ++pass) {
    std::vector<int> liquidOf;
    const PoissonSystem system = assemble(liquid, detached, liquidOf);
    const auto singular = singularParts(system);
    std::vector<char> enclosed(n, 0);
    for (const auto& part : singular) {
      for (const int i : part) enclosed[liquidOf[i]] = 1;
    }
    std::vector<double> b(liquidOf.size()), x(liquidOf.size());
    for (std::size_t i = 0; i < liquidOf.size(); ++i) {
      b[i] = -liquid.cells[liquidOf[i]].outflow;
      x[i] = q[liquidOf[i]];
    }
    const PoissonReport solved =
        solvePoisson(system, singular, std::move(b), x, options.tolerance, options.maxIterations);
    report.iterations += solved.iterations;
    report.residual = solved.residual;
    report.converged = solved.converged;
    report.separationPasses = pass;
    std::fill(q.begin(), q.end(), 0.0);
    double largest = 0.0;
    for (std::size_t i = 0; i < liquidOf.size(); ++i) {
      q[liquidOf[i]] = x[i];
      largest = std::max(largest, std::abs(x[i]));
    }
    if (pass >= options.maxSeparationPasses || !solved.converged) break;
    std::vector<char> next = detached;
    const bool shut = shutEdges(liquid, q);
    if (!updateDetached(liquid, q, enclosed, options.suction / pascal, kSuctionNoise * largest, next) &&
        !shut)
      break;
    detached = std::move(next);
  }

  result.valid.u = updateFaces(liquid, solid, q, detached, 0, u);
  result.valid.v = updateFaces(liquid, solid, q, detached, 1, v);
  result.valid.w = updateFaces(liquid, solid, q, detached, 2, w);
  result.separating = openvdb::MaskGrid::create();
  result.separating->setTransform(cellTransform(solid.voxelSize));
  for (int i = 0; i < n; ++i) {
    if (detached[i]) result.separating->tree().setValueOn(liquid.numbering.cells()[i]);
  }
  if (options.keepPressure) {
    result.pressure = openvdb::DoubleGrid::create(0.0);
    result.pressure->setTransform(cellTransform(solid.voxelSize));
    result.pressure->setName("pressure");
    openvdb::DoubleGrid::Accessor pressure = result.pressure->getAccessor();
    for (int i = 0; i < n; ++i) pressure.setValue(liquid.numbering.cells()[i], q[i] * pascal);
  }
  return result;
}

}  // namespace fluidtex::sim
