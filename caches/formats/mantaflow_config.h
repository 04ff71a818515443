// Where and when a frame of a Blender (mantaflow) cache is: config/config_####.uni.
#pragma once

#include "caches/formats/format_error.h"

#include <openvdb/Types.h>
#include <openvdb/math/Coord.h>

#include <filesystem>

namespace fluidtex::caches {

// All of such a file, in its order. Lengths are those of the domain object unless said otherwise.
// The length of a cell in the world is h = max(|p1 - p0| * scale) * dx, scale: lengths of the first three
// rows of worldFromObject. With R, its rows divided by scale, cell (i, j, k) has its centre at
//   h * ((i, j, k) + 1/2 - resolution / 2) * R + worldFromObject.transform((p0 + p1) / 2).
struct MantaflowConfig {
  int activeFields = 0;
  openvdb::Coord resolution;       // cells, all at least 1
  float dx = 0.0f;                 // 1 / the greatest of resolution, whatever the domain's size
  float dt = 0.0f;                 // of the last substep, in the unit of time
  openvdb::Vec3f p0, p1;           // corners of the domain
  openvdb::Vec3f dp0;              // shift of p0, of adaptive domains
  openvdb::Coord shift;            // total shift in cells, of adaptive domains
  openvdb::Vec3f shiftedBy;        // the same in lengths
  openvdb::Mat4d worldFromObject;  // of row vectors, as OpenVDB's are: world = worldFromObject.transform(x)
  openvdb::Coord baseResolution;   // cells before adaption
  openvdb::Coord firstCell, behindLastCell;  // of the adapted domain
  openvdb::Vec3f color;                      // of smoke
  float time = 0.0f;  // since the first frame; one frame is 0.1 * 25 / fps * time scale
};

// Throws FormatError: missing, not 204 bytes that end with "C01", numbers that are not finite, a resolution
// below 1, dx or the domain not above 0.
MantaflowConfig readMantaflowConfig(const std::filesystem::path& file);

}  // namespace fluidtex::caches
