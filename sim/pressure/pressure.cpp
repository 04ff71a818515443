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
#include "sim/pressure/update_faces.h"
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

// The unknowns of one pass: cells that are not detached.
struct Unknowns {
  std::vector<int> liquidOf;  // #unknowns, cell of each
  PoissonSystem system;
  std::vector<std::vector<int>> singular;  // parts without surface, each a list of unknowns
  std::vector<char> enclosed;              // #cells, 1 in such parts
};

Unknowns unknownsOf(const LiquidCells& liquid, const std::vector<char>& detached) {
  Unknowns unknowns;
  unknowns.system = pressureSystem(liquid, detached, unknowns.liquidOf);
  unknowns.singular = singularParts(unknowns.system);
  unknowns.enclosed.assign(std::size_t(liquid.numbering.size()), 0);
  for (const auto& part : unknowns.singular) {
    for (const int i : part) unknowns.enclosed[unknowns.liquidOf[i]] = 1;
  }
  return unknowns;
}

// Right-hand side b and initial guess x, from the pressure q so far (#cells); with surface tension those of
// the difference from the guessed pressure.
void setUp(const LiquidCells& liquid, const Tension& tension, const Unknowns& unknowns,
           const std::vector<double>& q, std::vector<double>& b, std::vector<double>& x) {
  const std::vector<int>& liquidOf = unknowns.liquidOf;
  b.resize(liquidOf.size());
  x.resize(liquidOf.size());
  for (std::size_t i = 0; i < liquidOf.size(); ++i) {
    b[i] = -liquid.outflow[liquidOf[i]];
    x[i] = q[liquidOf[i]];
  }
  if (!tension.surface.none()) takeOut(liquid, tension, unknowns.enclosed, unknowns.system, liquidOf, b, x);
}

// #cells, pressure of all of them from that of the unknowns.
std::vector<double> pressureFrom(const std::vector<double>& solved, const Unknowns& unknowns,
                                 const Tension& tension, int cells) {
  std::vector<double> q = tension.detached;
  q.resize(std::size_t(cells), 0.0);
  for (std::size_t i = 0; i < solved.size(); ++i) {
    const int cell = unknowns.liquidOf[i];
    q[cell] = tension.surface.none() || unknowns.enclosed[cell] ? solved[i] : solved[i] + tension.guess[cell];
  }
  return q;
}

// #cells, the potential of options.divergence; empty if it is not found: then no deficit is given back in
// this step. still: gets the velocities at which sources take back what is too much.
std::vector<double> expansionOf(const LiquidCells& liquid, const SolidField& solid, const Unknowns& unknowns,
                                PoissonSolver& poisson, const PressureOptions& options, SolidField& still) {
  std::vector<double> b, x(unknowns.liquidOf.size(), 0.0);
  setOutflow(*options.divergence, liquid, unknowns.system, solid.voxelSize, b);
  still = atRest(solid);
  if (solid.given) takeBack(solid, unknowns.singular, unknowns.liquidOf, liquid, b, still.given);
  if (!poisson.solve(std::move(b), x, kExpansionTolerance, options.maxIterations).converged) return {};
  std::vector<double> expansion(std::size_t(liquid.numbering.size()), 0.0);
  for (std::size_t i = 0; i < x.size(); ++i) expansion[unknowns.liquidOf[i]] = x[i];
  return expansion;
}

// Faces of the edges that were shut.
std::vector<Face> facesOfShutEdges(const LiquidCells& liquid) {
  std::vector<Face> shut;
  for (const Edge& edge : liquid.edges) {
    if (!edge.shut) continue;
    Coord face = liquid.numbering.cell(edge.cell);
    face[edge.side / 2] += edge.side % 2;
    shut.push_back({edge.side / 2, face});
  }
  return shut;
}

openvdb::DoubleGrid::Ptr pressureGrid(const LiquidCells& liquid, const std::vector<double>& q, double pascal,
                                      double h) {
  auto grid = openvdb::DoubleGrid::create(0.0);
  grid->setTransform(cellTransform(h));
  grid->setName("pressure");
  openvdb::DoubleGrid::Accessor pressure = grid->getAccessor();
  for (std::size_t i = 0; i < q.size(); ++i)
    pressure.setValue(liquid.numbering.cell(static_cast<int>(i)), q[i] * pascal);
  return grid;
}

}  // namespace

Projection project(Velocity& velocity, const FloatGrid& phi, const SolidField& solid, double dt,
                   double density, const PressureOptions& options) {
  require(dt > 0.0 && density > 0.0, "project: the time step and the density must be positive");
  auto& [u, v, w] = velocity.component;
  LiquidCells liquid = gatherLiquid(phi, solid, {&u->constTree(), &v->constTree(), &w->constTree()});
  const int n = liquid.numbering.size();
  const double pascal = density * solid.voxelSize / dt;  // of one unit of q
  const Tension tension = tensionOf(liquid, phi, solid, options.surfaceTension / pascal);

  Projection result;
  PressureReport& report = result.report;
  report.cells = n;
  report.converged = true;
  std::vector<double> q(n, 0.0), expansion;
  SolidField still;  // without velocities, but with those at which sources take back what is too much
  std::vector<char> detached(n, 0);
  SolidField slowed = solid;  // with the velocities that sources get in the end
  for (int pass = 0; n > 0; ++pass) {
    const Unknowns unknowns = unknownsOf(liquid, detached);
    // All cells are unknowns yet. In later passes a part with more inflow than outflow keeps an open edge.
    if (pass == 0 && solid.given) slowed.given = slowedSources(solid, unknowns.singular, liquid);
    std::vector<double> b, x;
    setUp(liquid, tension, unknowns, q, b, x);
    q = std::vector<double>();  // frees the memory, unlike {}
    // Whether liquid separates from solids, or attaches again, at this pressure.
    bool again = false, last = pass == options.maxSeparationPasses;
    const auto separates = [&](const std::vector<double>& solved) {
      q = pressureFrom(solved, unknowns, tension, n);
      if (last) return false;
      double largest = 0.0;
      for (const double value : solved) largest = std::max(largest, std::abs(value));
      const bool shut = shutEdges(liquid, q);
      const bool changed = updateDetached(liquid, tension, q, unknowns.enclosed, options.suction / pascal,
                                          kSuctionNoise * largest, detached);
      again = changed || shut;
      return again;
    };
    PoissonSolver poisson(unknowns.system, unknowns.singular);
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
    x = std::vector<double>();
    if (options.divergence != nullptr && solved.converged)
      expansion = expansionOf(liquid, solid, unknowns, poisson, options, still);
    break;
  }

  if (options.keepBefore) result.before = copyOf(velocity);
  for (int axis = 0; axis < 3; ++axis)
    result.valid.component[axis] =
        updateFaces(liquid, tension.surface, slowed, q, detached, axis, *velocity.component[axis]);
  if (!expansion.empty()) {
    result.expansion = makeVelocity(solid.voxelSize);
    const std::vector<char> none(n, 0);
    for (int axis = 0; axis < 3; ++axis)
      updateFaces(liquid, {}, still, expansion, none, axis, *result.expansion.component[axis]);
  }
  result.separating = separatingCells(liquid, solid, detached);
  result.shut = facesOfShutEdges(liquid);
  if (options.keepPressure) result.pressure = pressureGrid(liquid, q, pascal, solid.voxelSize);
  return result;
}

}  // namespace fluidtex::sim
