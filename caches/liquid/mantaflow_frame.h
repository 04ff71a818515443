// Place, unit and clock of a frame of Blender's liquid (mantaflow).
#pragma once

#include "caches/liquid/cache.h"

#include <openvdb/math/Mat3.h>
#include <openvdb/math/Mat4.h>

namespace fluidtex::caches {

struct MantaflowPlace {
  double voxel = 0.0;              // metres; cells are cubes, however the domain is scaled
  openvdb::Mat4d worldFromIndex;   // of cells' centres
  openvdb::Mat4d worldFromMesh;    // of the points of the meshes
  openvdb::Mat3d metersPerSecond;  // velocities of the grids to m/s, in the world's axes
  openvdb::Coord resolution;
};

// In Blender's world. Reads config/config_####.uni of this frame and of the next one, or the one before.
MantaflowPlace mantaflowPlace(const Cache& cache, int number);

// At the faces of the domain's upper sides Blender keeps no velocity through the side, but that of the face
// before where it points inward: liquid that rests against the wall would seem to leave it. Sets it to 0, as
// it is at the lower sides, unless something flows out there. And meshes reach a quarter of a cell into the
// walls: adds a cell beyond each of these sides, where Blender's velocities end at the wall. velocity:
// components at faces, in cells.
void closeUpperSides(const openvdb::Coord& resolution, openvdb::Vec3SGrid& velocity);

// phi (in voxels) without what is in obstacles, in index space; positive beyond the domain, so that liquid
// ends at its sides.
openvdb::FloatGrid::Ptr mantaflowDistance(const std::filesystem::path& file,
                                          const openvdb::Coord& resolution);

}  // namespace fluidtex::caches
