// Where liquid comes in and goes out: sources, drains, and sides of the domain through which a stream leaves.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/markers/markers.h"
#include "sim/solids/solids.h"

#include <string>
#include <vector>

namespace fluidtex::sim {

// A source on the grid.
struct SourceGrids {
  FloatGrid::Ptr phi;        // the liquid that is always there
  Vec3d speed{0.0};          // m/s
  double temperature = 0.0;  // K
  std::array<FloatGrid::Ptr, 3>
      velocity{};  // active at all faces of its cells; null where it only keeps full
};

// What runs at one time.
struct RunningFlows {
  struct Running {
    const SourceGrids* source;
    double factor;  // of its velocity
  };
  std::vector<Running> sources;
  std::vector<const FloatGrid*> drains;

  bool empty() const { return sources.empty() && drains.empty(); }
};

// The sources and drains of a scene over time. Their shapes are put on the grid once, when constructed.
class Flows {
 public:
  explicit Flows(const Options& options);

  RunningFlows at(double t) const;

  // The first time after t at which a source or a drain begins or ends; kForever where none does.
  double nextChange(double t) const;

  // Where liquid can come from: the phi of each source.
  std::vector<const FloatGrid*> places() const;

 private:
  FloatGrid::Ptr gridOf(const Shape& shape) const;

  std::vector<Source> m_sources;
  std::vector<Drain> m_drains;
  double m_h;
  CoordBBox m_domain;
  openvdb::BBoxd m_box;
  double m_band;
  std::vector<SourceGrids> m_sourceGrids;
  std::vector<FloatGrid::Ptr> m_drainGrids;
};

// One sentence for each body of liquid, source or drain that cannot do anything. Looks only where surfaces
// are, and keeps nothing.
std::vector<std::string> flowWarnings(const Options& options, const Solids& solids);

// Fills the sources and empties the drains: changes phi, which must be reinitialised afterwards, and drops
// the markers of the air in sources and those of the liquid in drains.
void applyFlows(FloatGrid& phi, Markers& markers, const RunningFlows& flows);

// The solids with the faces whose velocity is given: those in sources, and open faces of the domain that a
// stream leaves through. There the velocity `before` is carried out by itself and by the waves of shallow
// water [Orlanski, "A simple boundary condition for unbounded hyperbolic flows", 1976], for dt seconds.
SolidField withFlows(const SolidField& solid, const RunningFlows& flows, const FloatGrid& phi,
                     const Velocity& before, const Vec3d& gravity, double dt);

}  // namespace fluidtex::sim
