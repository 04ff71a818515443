#include "sim/step/step_failures.h"

#include "sim/step/solver.h"

#include <algorithm>
#include <sstream>

namespace fluidtex::sim {

void failCapillary(double time) {
  std::ostringstream message;
  message << "the simulation cannot go on at time " << time << " s: surface tension would take over "
          << 1.0 / kShortest
          << " substeps to a frame on cells of this size; give a coarser domain.resolution, less "
             "fluid.surface_tension or more frames a second";
  throw SolverError(message.str());
}

void failFast(double time, double liquid, double solids) {
  std::ostringstream message;
  message << "the simulation cannot go on at time " << time
          << " s: " << (solids > liquid ? "a solid moves at " : "the velocity is ")
          << std::max(solids, liquid) << " m/s, and it would take over " << 1.0 / kShortest
          << " substeps to a frame; "
          << (solids > liquid ? "are its keyframes as far apart in time as they should be?"
                              : "was a velocity given in other units than m/s, or the domain not in metres?");
  throw SolverError(message.str());
}

void fail(double time, double dt, const StepReport& report) {
  std::ostringstream message;
  message << "the simulation cannot go on at time " << time << " s: ";
  const auto blame = [&](const char* solve, double residual, int iterations) {
    message << "the " << solve << " solve did not converge (relative residual " << residual << " after "
            << iterations << " iterations)";
  };
  if (!report.heatConverged) {
    message << "the solve for the temperature did not converge";
  } else if (!report.viscosity.converged) {
    blame("viscosity", report.viscosity.residual, report.viscosity.iterations);
  } else if (!report.pressure.converged) {
    blame("pressure", report.pressure.residual, report.pressure.iterations);
  } else {
    message << "a velocity is not finite";
  }
  if (dt > 0.0) message << ", even with a step of " << dt << " s";
  message << "; a smaller cfl or a finer resolution may help";
  throw SolverError(message.str());
}

}  // namespace fluidtex::sim
