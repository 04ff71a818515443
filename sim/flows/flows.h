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
  // Samples the shapes on the grid. Throws MeshError and HeightError.
  explicit Flows(const Options& options);

  RunningFlows at(double t) const;

  // The first time after t at which a source or a drain begins or ends, or at which a source's rate has a
  // point; kForever where there is none.
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

// The solids with given face velocities added; unchanged where there are none. Running sources give theirs at
// their open faces. On stream sides of the domain a radiation condition holds at the open faces of liquid
// cells: the outward velocity u of `before` is advected outward over dt seconds with the speed u + sqrt(|g|
// d), d being the liquid's depth in the column, or with u alone where the side is the floor or the ceiling.
// phi: the liquid's. gravity: m/s2.
// Source: Orlanski, "A simple boundary condition for unbounded hyperbolic flows", 1976.
SolidField withFlows(const SolidField& solid, const RunningFlows& flows, const FloatGrid& phi,
                     const Velocity& before, const Vec3d& gravity, double dt);

}  // namespace fluidtex::sim
