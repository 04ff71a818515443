#include "sim/heat/heat.h"

#include "sim/grid/leaf_table.h"
#include "sim/grid/require.h"
#include "sim/poisson/poisson.h"
#include "sim/scalars/carried_scalar.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {
namespace {

constexpr double kStefanBoltzmann = 5.670374419e-8;  // W / (m2 K4)
constexpr double kGasConstant = 8.31446261815324;    // J / (mol K)

// Cells of liquid in the domain.
std::vector<CellBlock> liquidCellBlocks(const FloatGrid& temperature, const FloatGrid& phi,
                                        const SolidField& solid) {
  const float h = static_cast<float>(solid.voxelSize);
  const auto leaves = leavesOf(temperature.constTree());
  std::vector<CellBlock> blocks(leaves.size());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const Coord& origin = blocks[n].origin = leaves[n]->origin();
    if (!solid.domain.isInside(origin)) return;
    float phiScratch[kLeafSize], solidScratch[kLeafSize];
    const float* p = leafValues(phi.constTree(), origin, phiScratch);
    const float* s = leafValues(solid.phi->constTree(), origin, solidScratch);
    for (int i = 0; i < kLeafSize; ++i) {
      const Coord cell = origin.offsetBy(i >> 6, (i >> 3) & 7, i & 7);
      blocks[n].cells[i] = solid.domain.isInside(cell) && isLiquidCell(p[i], s[i], h);
    }
  });
  std::erase_if(blocks, [](const CellBlock& block) { return block.cells.none(); });
  return blocks;
}

double viscosityFrom(const std::vector<ViscosityPoint>& points, double temperature) {
  const auto above = std::find_if(points.begin(), points.end(), [&](const ViscosityPoint& point) {
    return point.temperature > temperature;
  });
  if (above == points.begin()) return above->viscosity;
  const ViscosityPoint& below = *(above - 1);
  if (above == points.end()) return below.viscosity;
  const double share = (temperature - below.temperature) / (above->temperature - below.temperature);
  return below.viscosity * std::pow(above->viscosity / below.viscosity, share);
}

}  // namespace

double viscosityAt(const ViscosityLaw& law, double viscosity, double temperature) {
  if (temperature < law.solidus) return std::max(law.solidViscosity, viscosity);
  double value = viscosity;
  if (law.kind == ViscosityLaw::Kind::exponential) {
    value *= std::exp(-law.slope * (temperature - law.reference));
  } else if (law.kind == ViscosityLaw::Kind::arrhenius) {
    value *= std::exp(law.activationEnergy / kGasConstant * (1.0 / temperature - 1.0 / law.reference));
  } else if (law.kind == ViscosityLaw::Kind::table && !law.points.empty()) {
    value = viscosityFrom(law.points, temperature);
  }
  return std::min(value, std::max(law.solidViscosity, viscosity));
}

FloatGrid::Ptr viscosityOf(const FloatGrid& temperature, const ViscosityLaw& law, double viscosity) {
  FloatGrid::Ptr result = temperature.deepCopy();
  result->setName("viscosity");
  const auto leaves = leavesOf(result->tree());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    float* values = leaves[n]->buffer().data();
    for (int i = 0; i < kLeafSize; ++i)
      values[i] = static_cast<float>(viscosityAt(law, viscosity, values[i]));
  });
  return result;
}

bool conductHeat(FloatGrid& temperature, const FloatGrid& phi, const SolidField& solid, double dt,
                 double density, const HeatOptions& heat) {
  require(dt >= 0.0 && density > 0.0 && heat.capacity > 0.0,
          "conductHeat: density and heat capacity must be positive, the time step must not be negative");
  const double h = solid.voxelSize, volumeHeat = density * heat.capacity;  // J / (m3 K)
  const double conduction = heat.conductivity * dt / (volumeHeat * h * h);
  const double radiation = heat.emissivity * kStefanBoltzmann * dt / (volumeHeat * h);
  const double wallLoss = heat.wallTransfer * dt / (volumeHeat * h);

  PoissonSystem system;
  system.numbering = CellNumbering(liquidCellBlocks(temperature, phi, solid));
  const int n = system.numbering.size();
  if (n == 0) return true;
  system.rows.resize(n);
  system.anchor.resize(n);
  system.anchoredSides.assign(n, 0x3f);
  std::vector<double> b(n), x(n);
  tbb::parallel_for(tbb::blocked_range<int>(0, n, 512), [&](const tbb::blocked_range<int>& range) {
    using Accessor = openvdb::tree::ValueAccessor<const FloatTree>;
    const Accessor liquid(phi.constTree()), before(temperature.constTree());
    const Accessor open[3] = {Accessor(solid.open[0].constTree()), Accessor(solid.open[1].constTree()),
                              Accessor(solid.open[2].constTree())};
    for (int i = range.begin(); i < range.end(); ++i) {
      const Coord cell = system.numbering.cell(i);
      const double t = before.getValue(cell);
      x[i] = t;
      double normal[3], length = 0.0;
      for (int a = 0; a < 3; ++a) {
        Coord low = cell, high = cell;
        --low[a];
        ++high[a];
        normal[a] = static_cast<double>(liquid.getValue(high)) - liquid.getValue(low);
        length += normal[a] * normal[a];
      }
      length = std::sqrt(length);
      double surface = 0.0, wall = 0.0;  // areas in faces of a cell
      for (int side = 0; side < kSides; ++side) {
        const int axis = side >> 1;
        Coord beside = cell, face = cell;
        beside[axis] += (side & 1) != 0 ? 1 : -1;
        if ((side & 1) != 0) ++face[axis];
        const float share = open[axis].getValue(face);
        wall += 1.0 - share;
        const int neighbor = system.numbering.at(beside);
        const bool linked = neighbor >= 0 && share > 0.0f;
        system.rows.neighbor[i][side] = linked ? neighbor : n;
        system.rows.link[i][side] = linked ? static_cast<float>(conduction * share) : 0.0f;
        // The area of cell faces towards the air exceeds that of the surface: each counts by its axis's share
        // of the normal.
        if (neighbor < 0 && share > 0.0f && liquid.getValue(beside) >= 0.0f)
          surface += share * (length > 0.0 ? std::abs(normal[axis]) / length : 1.0);
      }
      // T^4 - ambient^4 = (T^2 + ambient^2) (T + ambient) (T - ambient), the first two factors at the old
      // temperature: radiation is then linear in the temperature difference, as conduction and wall losses
      // are. In each equation a cell is a mean, with non-negative weights, of its old value, its neighbours,
      // its walls and the surroundings, so none can leave their range. Linearising by the tangent at t does
      // not have this property where t is below ambient: liquid of 300 K between walls of 1500 K would reach
      // 47,000 K in a long step.
      const double ambient = heat.ambient;
      const double shine = radiation * surface * (t * t + ambient * ambient) * (t + ambient);
      system.anchor[i] = 1.0 + shine + wallLoss * wall;
      b[i] = t + shine * ambient + wallLoss * wall * heat.wallTemperature;
    }
  });
  constexpr double kTolerance = 1e-10;
  constexpr int kMaxIterations = 200;
  if (!solvePoisson(system, {}, std::move(b), x, kTolerance, kMaxIterations).converged) return false;
  FloatGrid::Accessor write = temperature.getAccessor();
  for (int i = 0; i < n; ++i) write.setValueOnly(system.numbering.cell(i), static_cast<float>(x[i]));
  return true;
}

}  // namespace fluidtex::sim
