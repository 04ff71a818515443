#include "sim/viscosity/viscous_step.h"

#include "sim/velocity/acceleration.h"
#include "sim/velocity/extrapolate.h"

#include <utility>

namespace fluidtex::sim {

ViscousStepReport applyViscousStep(Velocity& velocity, const FloatGrid& phi, const SolidField& solid,
                                   double dt, double density, const ViscosityField& viscosity,
                                   const PressureOptions& pressure) {
  ViscousStepReport report;
  report.viscosity.skipped = isNegligible(viscosity, dt, density, solid.voxelSize);
  if (report.viscosity.skipped) return report;
  Velocity balanced = copyOf(velocity);
  const Projection projection = project(balanced, phi, solid, dt, density, pressure);
  report.pressure = projection.report;
  if (!report.pressure.converged) return report;
  uniteTopology(balanced);
  // Viscosity also reads faces that the projection leaves unchanged, with all that forces gave them.
  extrapolate(balanced, projection.valid, phi, *solid.phi, solid.visibility.get());
  const Velocity before = copyOf(balanced);
  report.viscosity = applyViscosity(balanced, phi, solid, dt, density, viscosity);
  if (!report.viscosity.converged) return report;
  velocity = plus(plus(balanced, before, -1.0), velocity, 1.0);
  return report;
}

}  // namespace fluidtex::sim
