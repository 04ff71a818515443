// All that a source of motion tells the rest of the program about one animation frame. Immutable and shared.
// What produced it (this solver, or files of another simulator) stays unknown downstream.
#pragma once

#include "sim/grid/grids.h"
#include "sim/grid/visibility.h"

#include <openvdb/openvdb.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace fluidtex::sim {

// One solver step. u, v, w are the projected and extrapolated velocity components (m/s) with which phi was
// advected, constant over dt. Each is a grid with its own transform: index (i,j,k) of u is the centre of the
// cell's lower x face, and u's transform already contains that half-voxel shift, so that sampling a component
// at a world position through its own transform is always right. Values are active wherever they are valid:
// at least within a step's reach of the surface, that along solids included; deep in the liquid there may be
// none.
struct Substep {
  double dt = 0.0;  // s
  FloatGrid::ConstPtr u, v, w;
  // Which cells thin walls hide from each other, cell (i,j,k) with u(i,j,k) as its lower x face: places
  // beside them have the velocity of their own side. Null where all is visible, as it is taken to be in files
  // of other programs.
  std::shared_ptr<const Visibility> visibility = nullptr;
};

// Statistics of the solver for this frame; values that do not apply stay at their default.
struct FrameStats {
  double dtMin = 0.0;           // s, shortest substep
  std::int64_t cells = 0;       // liquid cells
  double volume = 0.0;          // m3 of liquid
  double deficit = 0.0;         // m3, volume deficit: lost by the surface, still to be given back
  int pressureIterations = 0;   // summed over the substeps
  int viscosityIterations = 0;  // summed over the substeps
  double pressureResidual = 0;  // largest relative residual of the substeps
  // Of a liquid out of files: share of the surface's motion that its velocities explain, at most 1
  // (caches/liquid/explained.h); nothing where little moves.
  std::optional<double> explained = std::nullopt;
};

struct Frame {
  int index = 1;      // numbered from 1; the first is the initial state
  double time = 0.0;  // s
  // The surface that is textured: narrow-band level set in metres, negative inside,
  // the liquid with solids taken out, max(phi, -solidPhi).
  openvdb::FloatGrid::ConstPtr surfacePhi;
  // Negative inside solids, walls of the domain included, wherever they are near the liquid; narrow band,
  // metres. May be null.
  FloatGrid::ConstPtr solidPhi;
  std::vector<Substep> substeps;  // from frame index-1 to index, in order; none in the first
  std::map<std::string, FloatGrid::ConstPtr> fields;  // further scalars by name, e.g. "temperature"
  FrameStats stats;
};

}  // namespace fluidtex::sim
