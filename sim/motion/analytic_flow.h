// Motion by an analytic flow in place of the solver: the same frames, to test the stages after the
// simulation.
#pragma once

#include "sim/motion/known_flow.h"
#include "sim/motion_options.h"
#include "sim/step/solver.h"

namespace fluidtex::sim {

// Frames whose velocity is that of `motion`, except for its trilinear interpolation. The surface:
// - rest, stretch, source and sink: it stays, and its material moves along it. Right where the velocity is
// tangent to it: for level sheets. What a stretched sheet loses leaves through the domain's sides.
// - slot: the same, out of the domain's side at x = 0. With a slit that widens, its edges in y are where
//   what left the ends of the slit has come to.
// - rotation: it turns; its distance is the initial one at the place turned back.
// - vortex, deformation: it is advected by the solver's own kernel (sim/flows/move_surface.h), in substeps of
// at most Options::cfl cells, each with the velocity of its middle.
// Steady flows have one substep a frame. Only bodies in Options::liquid are used, all from the start.
class AnalyticFlow {
 public:
  AnalyticFlow(const Options& options, const MotionOptions& motion);
  // Continues from a restored state. Throws SolverError when it was made at another resolution.
  AnalyticFlow(const Options& options, const MotionOptions& motion, State state);

  // As Solver::next().
  Frame next(const std::function<void(double)>& progress = {});

  // Its velocity grids are empty.
  const State& state() const { return m_state; }

 private:
  AnalyticFlow(const Options& options, const MotionOptions& motion, std::shared_ptr<const SolidField> solid);
  FloatGrid::Ptr pouredAt(double time) const;
  Velocity near(double strength) const;
  void carryTo(double time, Frame& frame, const std::function<void(double)>& progress);

  Options m_options;
  MotionOptions m_motion;
  KnownFlow m_flow;
  std::shared_ptr<const SolidField> m_solid;  // the walls of the domain
  Velocity m_velocity;                        // at strength 1, in the domain and a block around it
  double m_speed = 0.0;                       // m/s, of m_velocity
  State m_state;
};

}  // namespace fluidtex::sim
