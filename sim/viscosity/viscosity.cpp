#include "sim/viscosity/viscosity.h"

#include "sim/grid/require.h"
#include "sim/viscosity/viscous_multigrid.h"
#include "sim/viscosity/viscous_system.h"

#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {
namespace {

using Range = tbb::blocked_range<std::int32_t>;
constexpr std::int32_t kGrain = 8192;

template <typename Term>
double sum(std::int32_t n, const Term& term) {
  return tbb::parallel_deterministic_reduce(
      Range(0, n, kGrain), 0.0,
      [&](const Range& range, double value) {
        for (std::int32_t i = range.begin(); i < range.end(); ++i) value += term(i);
        return value;
      },
      [](double a, double b) { return a + b; }, tbb::simple_partitioner());
}

// The gradient of the viscous energy: stress gets the weighted strains of x, and out the sum at each face.
// whole: with the offsets, else only the part that is linear in x.
void viscousForce(const ViscousSystem& system, const std::vector<double>& x, bool whole,
                  std::vector<double>& stress, std::vector<double>& out) {
  const auto samples = static_cast<std::int32_t>(system.samples.size());
  tbb::parallel_for(Range(0, samples, kGrain), [&](const Range& range) {
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
    tbb::parallel_for(Range(system.start[c].front(), system.start[c].back(), kGrain),
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
  std::vector<double> p(x.size(), 0.0), q(n), r(n), stress(system.samples.size());

  // The right-hand side: the momentum before, and the forces of moving solids.
  std::copy(x.begin() + n, x.end(), p.begin() + n);
  viscousForce(system, p, true, stress, q);
  const double normB = std::sqrt(sum(n, [&](std::int32_t i) {
    const double b = system.mass[i] * x[i] - q[i];
    return b * b;
  }));
  std::fill(p.begin(), p.end(), 0.0);

  viscousForce(system, x, true, stress, q);
  double normR = std::sqrt(sum(n, [&](std::int32_t i) {
    r[i] = -q[i];
    return r[i] * r[i];
  }));
  report.residual = normB == 0.0 ? 0.0 : normR / normB;
  report.converged = normR <= options.tolerance * normB;
  if (report.converged) return report;

  ViscousMultigrid preconditioner(system);
  std::vector<float> scaled(n), z(n);
  double rz = 0.0, alpha = 0.0;
  while (!report.converged && report.iterations < options.maxIterations && std::isfinite(report.residual)) {
    // Scaled, since the preconditioner works on values of about 1.
    const double unit = normR / std::sqrt(static_cast<double>(n));
    tbb::parallel_for(Range(0, n, kGrain), [&](const Range& range) {
      for (std::int32_t i = range.begin(); i < range.end(); ++i) scaled[i] = static_cast<float>(r[i] / unit);
    });
    preconditioner.apply(scaled, z);
    // z.(r - r_old) = -alpha z.q gives the flexible (Polak-Ribiere) direction without the old residual.
    const double zr = sum(n, [&](std::int32_t i) { return z[i] * r[i]; });
    const double zq = sum(n, [&](std::int32_t i) { return z[i] * q[i]; });
    const double beta = report.iterations == 0 ? 0.0 : -alpha * zq / rz;
    rz = zr;
    tbb::parallel_for(Range(0, n, kGrain), [&](const Range& range) {
      for (std::int32_t i = range.begin(); i < range.end(); ++i) p[i] = z[i] + beta * p[i];
    });
    viscousForce(system, p, false, stress, q);
    const double pq = sum(n, [&](std::int32_t i) {
      q[i] += system.mass[i] * p[i];
      return p[i] * q[i];
    });
    if (!(pq > 0.0) || !(rz > 0.0)) break;  // only rounding is left
    alpha = rz / pq;
    normR = std::sqrt(sum(n, [&](std::int32_t i) {
      x[i] += alpha * p[i];
      r[i] -= alpha * q[i];
      return r[i] * r[i];
    }));
    ++report.iterations;
    report.residual = normR / normB;
    report.converged = report.residual <= options.tolerance;
  }
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
