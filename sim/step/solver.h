// Free-surface liquid on a MAC grid: particle level set, face velocities, pressure by projection.
#pragma once

#include "sim/frame/frame.h"
#include "sim/markers/markers.h"
#include "sim/options.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace fluidtex::sim {

class Flows;
class Solids;
struct SolidField;

// All that the next step needs; writing and reading it back continues bit for bit.
struct State {
  int frame = 0;               // last finished frame, 0 before the first
  double time = 0.0;           // s
  FloatGrid::Ptr phi;          // liquid, narrow band, metres, negative inside
  FloatGrid::Ptr u, v, w;      // face velocities, m/s, of one topology; transforms as in Substep
  FloatGrid::Ptr au, av, aw;   // m/s2 there, by pressure and friction, in the last step; or null
  FloatGrid::Ptr temperature;  // K at cell centres; null where heat is not simulated
  Markers markers;             // on both sides of the surface
  std::int64_t steps = 0;      // substeps so far
  FloatGrid::Ptr owed;         // see sim/volume/owed_volume.h; null for nothing
  FloatGrid::Ptr su, sv, sw;   // m/s, by which the liquid grows meanwhile: see Liquid::swelling; or null
  double ahead = 0.0;  // s: u, v, w are those of so much later than `time`, the middle of the next substep
  // Bodies of Options::liquid that have been put in already, by index.
  std::vector<bool> poured;
};

// Thrown when a step cannot be made right (the pressure solve does not converge even after halving the step,
// a velocity is not finite); the message says what happened, at which time, and what may help.
struct SolverError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Solver {
 public:
  // Throws std::invalid_argument where the options (see sim/step/check_options.h) or the state's grids are
  // none that it could work with.
  explicit Solver(const Options& options);
  // Continues from a restored state. Throws SolverError when it was made at another resolution, or without
  // the heat that the options ask for.
  Solver(const Options& options, State state);

  // The first call gives the initial state (frame 1, no substeps); each further call advances by one frame
  // time. `progress`, where given, is called with the share of the frame done, 0..1.
  Frame next(const std::function<void(double)>& progress = {});

  const State& state() const { return m_state; }

  // What will not be, or has not been, as the scene may mean it, one sentence each; next() may add to them.
  const std::vector<std::string>& warnings() const { return m_warnings; }

 private:
  void prepare();
  // The solids at a time, wherever the liquid, what runs into it and `more` can get to in a step.
  std::shared_ptr<const SolidField> solidsAround(double time, const FloatGrid& phi,
                                                 const FloatGrid* more = nullptr);
  void applyEvents();
  void moveTime(double time);
  void advanceTo(double time, Frame& frame, const std::function<void(double)>& report);
  // Says once when more is owed than a run should owe.
  void tellOfDeficit();

  Options m_options;
  State m_state;
  std::shared_ptr<Solids> m_solids;
  std::shared_ptr<const SolidField> m_solid;  // at m_state.time
  std::vector<std::size_t> m_active;          // solids in m_solid
  std::shared_ptr<const Flows> m_flows;
  std::vector<std::string> m_warnings;
  double m_whole = 0.0;  // m3 of liquid after the last frame, with what was owed
  bool m_toldOfDeficit = false;
};

// Throws SolverError when the state was made with cells of another size than the options ask for.
void checkResolution(const State& state, const Options& options);

// The state as one .vdb file, uncompressed so that every value returns bit for bit.
// Throws openvdb::IoError when the file cannot be written or read.
void writeState(const State& state, const std::filesystem::path& file);
State readState(const std::filesystem::path& file);

}  // namespace fluidtex::sim
