// Grids of OpenVDB files, by name.
#pragma once

#include <openvdb/openvdb.h>

#include <filesystem>
#include <string>

namespace fluidtex::caches {

// The file's first grid of this name: numbers (float, half, double, int or bool), or vectors of three. They
// become floats; transform, class and background are the file's own, and the class may be wrong (Blender
// calls distances in voxels, with background 0, a level set). foreign::listGrids() says which there are.
// Throws FormatError, one sentence that names the file and its grids: where there is none of the name or it
// is of another type, where its transform is not affine or leads nowhere, and where an active value is not
// finite.
openvdb::FloatGrid::Ptr readScalars(const std::filesystem::path& file, const std::string& name);
openvdb::Vec3SGrid::Ptr readVectors(const std::filesystem::path& file, const std::string& name);

}  // namespace fluidtex::caches
