// A cache that is open, and a frame of it as the rest of the program takes it: metres, m/s, Z up.
#pragma once

#include "caches/layouts/layout.h"
#include "caches/liquid/surface_mesh.h"
#include "sim/grid/mac_grid.h"

#include <map>
#include <string>

namespace fluidtex::caches {

struct Cache {
  Options options;
  Layout layout;
  double voxel = 0.0;       // side of the level sets' cells, metres
  double frameRate = 24.0;  // frames a second
};

struct LiquidFrame {
  SurfaceTriangles surface;     // as in the files, placed; empty: there is no liquid
  openvdb::FloatGrid::Ptr phi;  // level set of it, see levelSetOf()
  bool isSheet = false;         // it encloses nothing
  // Each component with a transform of its own; no grids where nothing is known.
  sim::FaceGrids velocity;
  std::map<std::string, sim::FloatGrid::ConstPtr> fields;  // further scalars, see furtherFields()
};

}  // namespace fluidtex::caches
