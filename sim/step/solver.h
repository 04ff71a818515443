// Free-surface liquid on a MAC grid: particle level set, face velocities, pressure by projection.
#pragma once

#include "sim/frame/frame.h"
#include "sim/options.h"
#include "sim/step/liquid.h"

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace fluidtex::sim {

class Flows;
class Solids;
struct SolidField;

// Thrown when a simulation cannot go on: a pressure, viscosity or temperature solve does not converge or a
// velocity is not finite, even after the step was halved several times; the liquid, a solid or surface
// tension requires too short steps (sim/step/step_failures.h); or a restored state does not fit the options.
// The message says what happened, at which time, and what may help.
struct SolverError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Solver {
 public:
  // Starts without liquid. Throws std::invalid_argument where the options are invalid (see
  // sim/step/check_options.h), and MeshError and HeightError for files of solids, liquid, sources and drains.
  explicit Solver(const Options& options);
  // Continues from a restored state. Throws std::invalid_argument as above, and where the state's grids are
  // invalid. Throws SolverError when the state was made at another resolution, or lacks the heat that the
  // options ask for.
  Solver(const Options& options, State state);

  // The first call returns the initial state (frame 1, no substeps); each further call advances by one frame
  // time. `progress`, where given, is called with the finished fraction of the frame, 0..1. Throws
  // SolverError.
  Frame next(const std::function<void(double)>& progress = {});

  const State& state() const { return m_state; }

  // Problems of the scene or of the simulation so far, one sentence each; next() may add to them.
  const std::vector<std::string>& warnings() const { return m_warnings; }

 private:
  void prepare();
  // The solids at a time, wherever the liquid, inflow and `more` can get to in a step.
  std::shared_ptr<const SolidField> solidsAround(double time, const FloatGrid& phi,
                                                 const FloatGrid* more = nullptr);
  void applyEvents();
  void moveTime(double time);
  void advanceTo(double time, Frame& frame, const std::function<void(double)>& report);
  // Warns once when the deficit is larger than it should be.
  void tellOfDeficit();

  Options m_options;
  State m_state;
  std::shared_ptr<Solids> m_solids;
  std::shared_ptr<const SolidField> m_solid;  // at m_state.time
  std::vector<std::size_t> m_active;          // solids in m_solid
  std::shared_ptr<const Flows> m_flows;
  std::vector<std::string> m_warnings;
  double m_whole = 0.0;  // m3 of liquid after the last frame, with the deficit
  bool m_toldOfDeficit = false;
};

// Throws SolverError when the state has another cell size than the options.
void checkResolution(const State& state, const Options& options);

}  // namespace fluidtex::sim
