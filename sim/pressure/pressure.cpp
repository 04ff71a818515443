// Pressure projection on the liquid's cells.
// Separating walls: 0 <= p, complementary to 0 <= outflow, in cells at solids; Batty, Bertails, Bridson, "A
// fast variational framework for accurate solid-fluid coupling", 2007, section 5. Solved by the primal-dual
// active set method: Hintermueller, Ito, Kunisch, 2002.
#include "sim/pressure/pressure.h"

#include "sim/grid/mac_grid.h"
#include "sim/grid/require.h"
#include "sim/poisson/poisson.h"
#include "sim/pressure/liquid_cells.h"
#include "sim/pressure/pressure_system.h"
#include "sim/pressure/slowed_sources.h"
#include "sim/pressure/tension_pressure.h"
#include "sim/solids/solid_layers.h"
#include "sim/surface/level_set.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace fluidtex::sim {

namespace {

using Range = tbb::blocked_range<int>;

// Suction below this share of the largest pressure is rounding error of the solver.
constexpr double kSuctionNoise = 1e-5;

// Tolerance of the expansion. The deficit changes from step to step by more than this error.
constexpr double kExpansionTolerance = 1e-2;

// Tolerance at which separation is tested first: mostly it shows by then.
constexpr double kSeparationTolerance = 1e-3;

// A face whose solid lies within about 25 degrees of square to it takes the solid's normal velocity.
constexpr float kSquare = 0.9f;

// Closes edges where the pressure would cause inflow. True if any was closed.
bool shutEdges(LiquidCells& liquid, const std::vector<double>& q) {
  bool any = false;
  for (Edge& edge : liquid.edges) {
    assert(liquid.special[edge.cell] >= 0);
    LiquidSides& cell = liquid.sides[liquid.special[edge.cell]];
    if (edge.shut || edge.outward + q[edge.cell] / kEdgeTheta >= 0.0) continue;
    // A cell's only open face stays open.
    if (std::count_if(cell.open.begin(), cell.open.end(), [](float open) { return open > 0.0f; }) < 2)
      continue;
    edge.shut = any = true;
    liquid.outflow[edge.cell] -= cell.open[edge.side] * edge.outward;
    cell.open[edge.side] = cell.theta[edge.side] = 0.0f;
  }
  return any;
}

// Subtracts the guess of the pressure from the unknowns x and the right-hand side b, but not in enclosed
// parts. Differences are formed before they are weighted: weights are large where the surface is close to a
// cell's centre.
void takeOut(const LiquidCells& liquid, const Tension& tension, const std::vector<char>& enclosed,
             const PoissonSystem& system, const std::vector<int>& liquidOf, std::vector<double>& b,
             std::vector<double>& x) {
  const SurfacePressure& surface = tension.surface;
  const std::vector<double>&guess = tension.guess, &loose = tension.detached;
  const int n = static_cast<int>(b.size());
  tbb::parallel_for(Range(0, n, 1024), [&](const Range& range) {
    for (int i = range.begin(); i < range.end(); ++i) {
      const int number = liquidOf[i];
      if (enclosed[number]) continue;
      const LiquidSides& cell = liquid.sidesOf(number);
      x[i] -= guess[number];
      for (int s = 0; s < kSides; ++s) {
        const int neighbor = system.rows.neighbor[i][s];
        if (neighbor < n) {
          b[i] -= system.rows.link[i][s] * (guess[number] - guess[liquidOf[neighbor]]);
        } else if (cell.open[s] > 0.0f) {
          const bool ends = cell.theta[s] > 0.0f;
          const int detached = ends ? -1 : liquid.numbering.at(neighborOf(liquid.numbering.cell(number), s));
          const double beyond = detached < 0 ? surface.at(number, s) : loose[detached];
          b[i] -= cell.open[s] / (ends ? double(cell.theta[s]) : 1.0) * (guess[number] - beyond);
        }
      }
    }
  });
}

// Outflow through a cell's open faces after the pressure has acted.
double projectedOutflow(const LiquidCells& liquid, const SurfacePressure& surface,
                        const std::vector<double>& q, int number) {
  const LiquidSides& cell = liquid.sidesOf(number);
  const Coord place = liquid.numbering.cell(number);
  double outflow = liquid.outflow[number];
  for (int s = 0; s < kSides; ++s) {
    if (cell.open[s] <= 0.0f) continue;
    const bool ends = cell.theta[s] > 0.0f;
    const int neighbor = ends ? -1 : liquid.numbering.at(neighborOf(place, s));
    const double step = (neighbor < 0 ? surface.at(number, s) : q[neighbor]) - q[number];
    outflow -= cell.open[s] * (ends ? step / cell.theta[s] : step);
  }
  return outflow;
}

// Outflow of each unknown's cell that gives the expansion, m/s through one open face.
void setOutflow(const FloatGrid& divergence, const LiquidCells& liquid, const PoissonSystem& system, double h,
                std::vector<double>& outflow) {
  outflow.assign(system.numbering.size(), 0.0);
  tbb::parallel_for(Range(0, static_cast<int>(liquid.blocks.size())), [&](const Range& range) {
    for (int b = range.begin(); b < range.end(); ++b) {
      const FloatLeaf* leaf = divergence.constTree().probeConstLeaf(liquid.blocks[b].origin);
      const int* numbers = system.numbering.block(liquid.blocks[b].origin);
      if (leaf == nullptr || numbers == nullptr) continue;
      for (int c = 0; c < kLeafSize; ++c) {
        if (numbers[c] >= 0) outflow[numbers[c]] = leaf->getValue(c) * h;
      }
    }
  });
}

// One step of the active set method: cells at solids separate, or attach again. True if any changed. The
// suction of a cell, below its pressure when detached, is limited by its own surface: a drop of one cell
// bears only a share of `suction`, which is for a cell with a column of liquid below it. Suction below
// `rounding` counts as 0.
bool updateDetached(const LiquidCells& liquid, const Tension& tension, const std::vector<double>& q,
                    const std::vector<char>& enclosed, double suction, double rounding,
                    std::vector<char>& detached) {
  const std::vector<double>& loose = tension.detached;
  const int n = liquid.numbering.size();
  std::vector<char> changed(n, 0);
  tbb::parallel_for(Range(0, n, 1024), [&](const Range& range) {
    for (int i = range.begin(); i < range.end(); ++i) {
      const LiquidSides& cell = liquid.sidesOf(i);
      if (cell.closed <= 0.0f) continue;
      const double least = (loose.empty() ? 0.0 : loose[i]) - std::max(suction / anchoredBy(cell), rounding);
      changed[i] =
          detached[i] ? projectedOutflow(liquid, tension.surface, q, i) < 0.0 : q[i] < least && !enclosed[i];
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

// Leaves of `grid` that hold a face of a liquid cell; missing ones are made. They are the same for every
// axis, so that the components keep one topology.
std::vector<FloatLeaf*> faceLeaves(const LiquidCells& liquid, FloatGrid& grid) {
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

// Subtracts the pressure gradient on the faces normal to `axis`, sets closed ones to the solid's speed, and
// writes given velocities. Returns the valid faces.
MaskGrid::Ptr updateFaces(const LiquidCells& liquid, const SurfacePressure& surface, const SolidField& solid,
                          const std::vector<double>& q, const std::vector<char>& detached, int axis,
                          FloatGrid& grid) {
  const FloatGrid* const solidSpeed = solid.speed.component[axis].get();
  const FloatGrid* const given = solid.given.component[axis].get();
  const FloatGrid& open = solid.open[axis];
  auto valid = MaskGrid::create();
  valid->setTransform(faceTransform(solid.voxelSize, axis));
  const std::vector<FloatLeaf*> leaves = faceLeaves(liquid, grid);
  std::vector<MaskGrid::TreeType::LeafNodeType*> masks;
  masks.reserve(leaves.size());
  for (const FloatLeaf* leaf : leaves) masks.push_back(valid->tree().touchLeaf(leaf->origin()));

  tbb::parallel_for(Range(0, static_cast<int>(leaves.size())), [&](const Range& range) {
    const openvdb::tree::ValueAccessor<const FloatTree> distance(solid.phi->constTree());
    const auto isOpen = [&](const Coord& face) { return open.constTree().getValue(face) > 0.0f; };
    for (int n = range.begin(); n < range.end(); ++n) {
      FloatLeaf& leaf = *leaves[n];
      const BlockNumbers numbers(liquid.numbering, leaf.origin());
      for (int c = 0; c < kLeafSize; ++c) {
        const int upper = numbers.at(c), lower = numbers.beside(c, 2 * axis);
        if (upper < 0 && lower < 0) continue;

        const LiquidSides& cell = liquid.sidesOf(upper >= 0 ? upper : lower);
        const int side = 2 * axis + (upper >= 0 ? 0 : 1);
        const Coord wetCell = liquid.numbering.cell(upper >= 0 ? upper : lower);
        const bool edge = endsAt(Side::open, solid, wetCell, side);
        if (cell.open[side] > 0.0f) {
          // A nozzle: all that enters the cell would leave through this sliver, as fast as it must.
          // Extrapolation from the liquid beside it is better; at an edge only the pressure gives the
          // velocity.
          if (cell.theta[side] > 0.0f && cell.open[side] < kLeastOpen && !edge) continue;
          const double step = (upper < 0 ? surface.at(lower, side) : q[upper]) -
                              (lower < 0 ? surface.at(upper, side) : q[lower]);
          const double change = cell.theta[side] > 0.0f ? step / cell.theta[side] : step;
          leaf.setValueOn(c, static_cast<float>(leaf.getValue(c) - change));
          masks[n]->setValueOn(c);
          continue;
        }
        const Coord place = leaf.offsetToGlobalCoord(c);
        if (edge && isOpen(place)) {
          // A closed edge is no wall that liquid could separate from.
          leaf.setValueOn(c, 0.0f);
          masks[n]->setValueOn(c);
          continue;
        }
        const float slope = distance.getValue(place) - distance.getValue(neighborOf(place, 2 * axis));
        const bool solidBelow = slope > 0.0f;
        const int wet = solidBelow ? upper : lower;
        if (std::abs(slope) < kSquare * solid.voxelSize || wet < 0) continue;
        const double push = solidSpeed == nullptr ? 0.0 : solidSpeed->constTree().getValue(place);
        double away = 0.0;
        const int wall = 2 * axis + (solidBelow ? 0 : 1);
        if (detached[wet] && !endsAt(Side::symmetry, solid, liquid.numbering.cell(wet), wall)) {
          // The cell's outflow through open faces is balanced by inflow at its walls, so that it is
          // divergence-free; each wall takes a share in proportion to the speed at which liquid was about to
          // leave it.
          const auto& sides = liquid.sidesOf(wet);
          const double relative = leaf.getValue(c) - push;
          const double ready = std::max(0.0, solidBelow ? relative : -relative);
          const double share = sides.leaving > 0.0f ? ready / sides.leaving : 1.0 / sides.closed;
          away = std::max(0.0, projectedOutflow(liquid, surface, q, wet)) * share;
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

// Liquid cells that separate. A cell deep in a solid has almost no open area: the liquid beside it separates
// with it.
MaskGrid::Ptr separatingCells(const LiquidCells& liquid, const SolidField& solid,
                              const std::vector<char>& detached) {
  MaskGrid::Ptr separating = MaskGrid::create();
  separating->setTransform(cellTransform(solid.voxelSize));
  const auto distance = solid.phi->getConstAccessor();
  const float deep = -kDeepInSolid * static_cast<float>(solid.voxelSize);
  for (int i = 0; i < liquid.numbering.size(); ++i) {
    if (!detached[i]) continue;
    const Coord cell = liquid.numbering.cell(i);
    separating->tree().setValueOn(cell);
    if (distance.getValue(cell) >= deep) continue;
    const LiquidSides& sides = liquid.sidesOf(i);
    for (int side = 0; side < kSides; ++side)
      if (sides.open[side] > 0.0f && liquid.numbering.at(neighborOf(cell, side)) >= 0)
        separating->tree().setValueOn(neighborOf(cell, side));
  }
  return separating;
}

}  // namespace

Projection project(Velocity& velocity, const FloatGrid& phi, const SolidField& solid, double dt,
                   double density, const PressureOptions& options) {
  require(dt > 0.0 && density > 0.0, "project: the time step and the density must be positive");
  FloatGrid &u = *velocity.component[0], &v = *velocity.component[1], &w = *velocity.component[2];
  LiquidCells liquid = gatherLiquid(phi, solid, {&u.constTree(), &v.constTree(), &w.constTree()});
  const int n = liquid.numbering.size();
  const double pascal = density * solid.voxelSize / dt;  // of one unit of q

  const Tension tension = tensionOf(liquid, phi, solid, options.surfaceTension / pascal);
  const SurfacePressure& surface = tension.surface;

  Projection result;
  PressureReport& report = result.report;
  report.cells = n;
  report.converged = true;
  std::vector<double> q(n, 0.0), expansion;
  SolidField still;  // without velocities, but with those at which sources take back what is too much
  std::vector<char> detached(n, 0);
  SolidField slowed = solid;  // with the velocities that sources get in the end
  for (int pass = 0; n > 0; ++pass) {
    std::vector<int> liquidOf;
    const PoissonSystem system = pressureSystem(liquid, detached, liquidOf);
    const auto singular = singularParts(system);
    // All cells are unknowns yet. In later passes a part with more inflow than outflow keeps an open edge.
    if (pass == 0 && solid.given) slowed.given = slowedSources(solid, singular, liquid);
    std::vector<char> enclosed(n, 0);
    for (const auto& part : singular) {
      for (const int i : part) enclosed[liquidOf[i]] = 1;
    }
    std::vector<double> b(liquidOf.size()), x(liquidOf.size());
    for (std::size_t i = 0; i < liquidOf.size(); ++i) {
      b[i] = -liquid.outflow[liquidOf[i]];
      x[i] = q[liquidOf[i]];
    }
    q = std::vector<double>();  // frees the memory, unlike {}
    if (!surface.none()) {
      // Solve for the difference from the guess.
      takeOut(liquid, tension, enclosed, system, liquidOf, b, x);
    }
    // Whether liquid separates from solids, or attaches again, at this pressure.
    bool again = false, last = pass == options.maxSeparationPasses;
    const auto separates = [&](const std::vector<double>& pressure) {
      q = tension.detached;
      q.resize(n, 0.0);
      double largest = 0.0;
      for (std::size_t i = 0; i < liquidOf.size(); ++i) {
        const int number = liquidOf[i];
        q[number] = surface.none() || enclosed[number] ? pressure[i] : pressure[i] + tension.guess[number];
        largest = std::max(largest, std::abs(pressure[i]));
      }
      if (last) return false;
      const bool shut = shutEdges(liquid, q);
      const bool changed = updateDetached(liquid, tension, q, enclosed, options.suction / pascal,
                                          kSuctionNoise * largest, detached);
      again = changed || shut;
      return again;
    };
    PoissonSolver poisson(system, singular);
    const PoissonReport solved =
        poisson.solve(std::move(b), x, options.tolerance, options.maxIterations,
                      {kSeparationTolerance, [&](const std::vector<double>& rough) {
                         const bool continues = !separates(rough);
                         if (continues) q = std::vector<double>();  // memory is shortest while the solve runs
                         return continues;
                       }});
    last = last || !(solved.converged || solved.ended);
    report.iterations += solved.iterations;
    report.residual = solved.residual;
    report.converged = solved.converged;
    report.separationPasses = pass;
    if (again || separates(x)) continue;
    if (options.divergence != nullptr && solved.converged) {
      setOutflow(*options.divergence, liquid, system, solid.voxelSize, b);
      still = atRest(solid);
      if (solid.given) takeBack(solid, singular, liquidOf, liquid, b, still.given);
      std::fill(x.begin(), x.end(), 0.0);
      // If this fails, no deficit is given back in this step.
      if (poisson.solve(std::move(b), x, kExpansionTolerance, options.maxIterations).converged) {
        expansion.assign(n, 0.0);
        for (std::size_t i = 0; i < liquidOf.size(); ++i) expansion[liquidOf[i]] = x[i];
      }
    }
    break;
  }

  if (options.keepBefore) result.before = {{u.deepCopy(), v.deepCopy(), w.deepCopy()}};
  result.valid.component[0] = updateFaces(liquid, surface, slowed, q, detached, 0, u);
  result.valid.component[1] = updateFaces(liquid, surface, slowed, q, detached, 1, v);
  result.valid.component[2] = updateFaces(liquid, surface, slowed, q, detached, 2, w);
  if (!expansion.empty()) {
    result.expansion = makeVelocity(solid.voxelSize);
    const std::vector<char> none(n, 0);
    for (int axis = 0; axis < 3; ++axis)
      updateFaces(liquid, {}, still, expansion, none, axis, *result.expansion.component[axis]);
  }
  result.separating = separatingCells(liquid, solid, detached);
  for (const Edge& edge : liquid.edges) {
    if (!edge.shut) continue;
    Coord face = liquid.numbering.cell(edge.cell);
    face[edge.side / 2] += edge.side % 2;
    result.shut.push_back({edge.side / 2, face});
  }
  if (options.keepPressure) {
    result.pressure = openvdb::DoubleGrid::create(0.0);
    result.pressure->setTransform(cellTransform(solid.voxelSize));
    result.pressure->setName("pressure");
    openvdb::DoubleGrid::Accessor pressure = result.pressure->getAccessor();
    for (int i = 0; i < n; ++i) pressure.setValue(liquid.numbering.cell(i), q[i] * pascal);
  }
  return result;
}

}  // namespace fluidtex::sim
