// Inflow and outflow: sources, drains, and stream sides of the domain.
#pragma once

#include "sim/flows/source_faces.h"
#include "sim/grid/mac_grid.h"
#include "sim/markers/markers.h"
#include "sim/shapes/shape_distance.h"
#include "sim/solids/solids.h"

#include <string>
#include <vector>

namespace fluidtex::sim {

// The sources and drains that are active at one time.
struct RunningFlows {
  struct Running {
    const SourceGrids* source;
    double factor;  // of its velocity
  };
  std::vector<Running> sources;
  std::vector<const FloatGrid*> drains;

  bool empty() const { return sources.empty() && drains.empty(); }
};

// The sources and drains of a scene over time. Their shapes are sampled on the grid once, in the constructor.
class Flows {
 public:
  explicit Flows(const Options& options);

  RunningFlows at(double t) const;

  // The first time after t at which a source or a drain begins or ends; kForever where there is none.
  double nextChange(double t) const;

  // The phi of each source: where liquid can enter.
  std::vector<const FloatGrid*> places() const;

 private:
  FloatGrid::Ptr gridOf(const ShapeDistance& shape) const;

  std::vector<Source> m_sources;
  std::vector<Drain> m_drains;
  double m_h;
  CoordBBox m_domain;
  openvdb::BBoxd m_box;
  double m_band;
  std::vector<SourceGrids> m_sourceGrids;
  std::vector<FloatGrid::Ptr> m_drainGrids;
};

// One sentence for each body of liquid, source or drain that has no effect. Examines only the neighbourhood
// of surfaces, and stores nothing.
std::vector<std::string> flowWarnings(const Options& options, const Solids& solids);

// Fills the sources and empties the drains: changes phi, which must be reinitialised afterwards, and drops
// air markers in sources and liquid markers in drains. solidPhi: the solids' signed distance, metres.
void applyFlows(FloatGrid& phi, Markers& markers, const FloatGrid& solidPhi, const RunningFlows& flows);

// The solids with given velocities added: at open faces in sources, and at open faces on stream sides of the
// domain. On stream sides the velocity `before` is advected outward by itself and by the waves of shallow
// water, for dt seconds.
// Source: Orlanski, "A simple boundary condition for unbounded hyperbolic flows", 1976.
SolidField withFlows(const SolidField& solid, const RunningFlows& flows, const FloatGrid& phi,
                     const Velocity& before, const Vec3d& gravity, double dt);

}  // namespace fluidtex::sim
