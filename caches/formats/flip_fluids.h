// The bakefiles of FLIP Fluids, an add-on of Blender. Meshes (######.bobj) are read by readGeometry().
#pragma once

#include "caches/formats/format_error.h"

#include <openvdb/Types.h>
#include <openvdb/math/Coord.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace fluidtex::caches {

// velocity######.bobj, vorticity, color, blur: #V x 3, one for each vertex of the mesh of that number,
// sampled before the mesh was smoothed. Velocities are in the simulation's unit: the domain's scale, which no
// file holds, makes them the mesh's. All finite.
std::vector<openvdb::Vec3f> readFlipVectors(const std::filesystem::path& file);

// speed######.data, age, lifetime, viscosity, density: #V, all finite.
std::vector<float> readFlipFloats(const std::filesystem::path& file);

// sourceid######.data: #V.
std::vector<std::int32_t> readFlipIntegers(const std::filesystem::path& file);

// bounds######.bbox
struct FlipBounds {
  openvdb::Vec3d min;    // x y z
  openvdb::Vec3d size;   // width height depth
  double dx = 0.0;       // edge of a cell
  openvdb::Coord cells;  // isize jsize ksize
};
FlipBounds readFlipBounds(const std::filesystem::path& file);

// All throw FormatError, as readGeometry() does.

}  // namespace fluidtex::caches
