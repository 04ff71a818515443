// The bakefiles of FLIP Fluids, an add-on of Blender. Meshes (######.bobj) are read by readGeometry().
#pragma once

#include "caches/formats/format_error.h"

#include <openvdb/Types.h>

#include <filesystem>
#include <vector>

namespace fluidtex::caches {

// velocity######.bobj, vorticity, color, blur: #V x 3, one for each vertex of the mesh of that number,
// sampled before the mesh was smoothed. Velocities are in the simulation's unit: the domain's scale, which no
// file holds, makes them the mesh's. All finite. Throws FormatError, as
// readGeometry() does.
std::vector<openvdb::Vec3f> readFlipVectors(const std::filesystem::path& file);

}  // namespace fluidtex::caches
