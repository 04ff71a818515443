#include "sim/viscosity/viscosity.h"

#include "sim/grid/require.h"
#include "sim/poisson/conjugate_gradients.h"
#include "sim/viscosity/viscous_multigrid.h"
#include "sim/viscosity/viscous_system.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {
namespace {

using Range = IndexRange;

// The gradient of the viscous energy: stress gets the weighted strains of x, and out the sum at each face.
// whole: with the offsets, else only the part that is linear in x.
void viscousForce(const ViscousSystem& system, const std::vector<double>& x, bool whole,
                  std::vector<double>& stress, std::vector<double>& out) {
  const auto samples = static_cast<std::int32_t>(system.samples.size());
  tbb::parallel_for(Range(0, samples, kIndicesAtOnce), [&](const Range& range) {
    for (std::int32_t s = range.begin(); s < range.end(); ++s) {
      const StrainSample& sample = system.samples[s];
      const auto& f = sample.face;
      const double strain = static_cast<double>(sample.a) * (x[f[1]] - x[f[0]]) +
                            static_cast<double>(sample.b) * (x[f[3]] - x[f[2]]) +
                            (whole ? sample.offset : 0.0f);
      stress[s] = sample.weight * strain;
    }
  });
  for (int c = 0; c < 3; ++c) {
    tbb::parallel_for(Range(system.start[c].front(), system.start[c].back(), kIndicesAtOnce),
                      [&](const Range& range) {
                        for (std::int32_t i = range.begin(); i < range.end(); ++i) {
                          double force = 0.0;
                          for (int slot = 0; slot < 6; ++slot) {
                            const std::int32_t s = system.samplesOf[i][slot];
                            if (s < samples) force += strainOf(system.samples[s], c, slot) * stress[s];
                          }
                          out[i] = force;
                        }
                      });
  }
}

double largestViscosity(const ViscosityField& viscosity) {
  if (viscosity.variable == nullptr) return viscosity.constant;
  double largest = 0.0;
  for (auto it = viscosity.variable->cbeginValueOn(); it; ++it)
    largest = std::max(largest, static_cast<double>(*it));
  return largest;
}

}  // namespace

bool isNegligible(double viscosity, double dt, double density, double h, const ViscosityOptions& options) {
  return viscosity * dt < options.negligible * density * h * h;
}

bool isNegligible(const ViscosityField& viscosity, double dt, double density, double h,
                  const ViscosityOptions& options) {
  return isNegligible(largestViscosity(viscosity), dt, density, h, options);
}

ViscosityReport solveViscous(const ViscousSystem& system, std::vector<double>& x,
                             const ViscosityOptions& options) {
  const std::int32_t n = system.unknowns;
  ViscosityReport report;
  report.faces = n;
  std::vector<double> stress(system.samples.size());
  ConjugateGradients v{.n = n,
                       .x = x,
                       .r = std::vector<double>(n),
                       .p = std::vector<double>(x.size(), 0.0),
                       .q = std::vector<double>(n)};

  // The right-hand side: the momentum before, and the forces of moving solids.
  std::copy(x.begin() + n, x.end(), v.p.begin() + n);
  viscousForce(system, v.p, true, stress, v.q);
  v.rightNorm = std::sqrt(sumOver(n, [&](std::int32_t i) {
    const double b = system.mass[i] * x[i] - v.q[i];
    return b * b;
  }));
  std::fill(v.p.begin(), v.p.end(), 0.0);

  viscousForce(system, x, true, stress, v.q);
  v.residualNorm = std::sqrt(sumOver(n, [&](std::int32_t i) {
    v.r[i] = -v.q[i];
    return v.r[i] * v.r[i];
  }));
  report.residual = v.rightNorm == 0.0 ? 0.0 : v.residualNorm / v.rightNorm;
  report.converged = v.residualNorm <= options.tolerance * v.rightNorm;
  if (report.converged) return report;

  ViscousMultigrid preconditioner(system);
  v.scaled.resize(n);
  v.z.resize(n);
  const auto product = [&] {
    viscousForce(system, v.p, false, stress, v.q);
    return sumOver(n, [&](std::int32_t i) {
      v.q[i] += system.mass[i] * v.p[i];
      return v.p[i] * v.q[i];
    });
  };
  conjugateGradients(
      v, options.tolerance, options.maxIterations, [&] { preconditioner.apply(v.scaled, v.z); }, product,
      [] { return true; }, report);
  return report;
}

ViscosityReport applyViscosity(Velocity& velocity, const FloatGrid& phi, const SolidField& solid, double dt,
                               double density, const ViscosityField& viscosity,
                               const ViscosityOptions& options) {
  require(dt >= 0.0 && density > 0.0 && viscosity.constant >= 0.0,
          "applyViscosity: the density must be positive, time step and viscosity must not be negative");
  const double h = solid.voxelSize;
  ViscosityReport report;
  report.skipped = isNegligible(viscosity, dt, density, h, options);
  if (report.skipped) return report;
  std::vector<double> x;
  const ViscousSystem system = viscousSystem(velocity, phi, solid, dt, density, viscosity, x);
  report = solveViscous(system, x, options);
  if (!report.converged) return report;
  for (int c = 0; c < 3; ++c) {
    const auto leaves = leavesOf(velocity.component[c]->tree());
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      float* out = leaves[n]->buffer().data();
      for (int i = 0; i < kLeafSize; ++i) {
        const std::int32_t number = system.number[c][n * kLeafSize + i];
        if (number >= 0) out[i] = static_cast<float>(x[number]);
      }
    });
  }
  return report;
}

}  // namespace fluidtex::sim
