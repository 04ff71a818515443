// Grids of OpenVDB files of others.
#pragma once

#include "foreign/ask.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <istream>
#include <optional>
#include <string>
#include <vector>

namespace fluidtex::foreign {

// What a file says of one of its grids.
struct GridHead {
  std::string name;                // as in the file ("vel.x" too); may be empty
  std::string type;                // OpenVDB's own, "Tree_float_5_4_3"; of half floats "..._HalfFloat"
  std::string gridClass;           // "level set", "fog volume", "staggered" or "unknown"; it may be wrong
  bool half = false;               // stored in 16 bits
  bool readable = false;           // a type that readGrid() gives, and an affine transform
  bool vectors = false;            // three numbers a voxel
  std::int64_t activeVoxels = -1;  // as the file says; -1 where it does not
  // Index to world, row by row: world = M (i, j, k, 1), so that M[3], M[7], M[11] are where voxel (0, 0, 0)
  // lies. Nothing where the transform is not affine (that of a camera's frustum) or leads nowhere.
  std::optional<std::array<double, 16>> transform;
};

// All grids of the file in their order, of unknown types too, without their voxels. Several may have one
// name. A file that was written as a stream has to be read up to its last grid, and is listed up to the first
// one of an unknown type. Throws Unreadable.
std::vector<GridHead> listGrids(const std::filesystem::path& file);

// The first grid of this name as an uncompressed stream of OpenVDB, of floats, or of float vectors (Vec3s):
// numbers of other types become floats; name, transform, class and background are the file's. Throws
// Unreadable: where there is none of the name it names those that there are; where the grid is no numbers
// (or no vectors), where its transform is not affine or leads nowhere, and where active values are not
// finite, with the first place.
std::string readGrid(const std::filesystem::path& file, const std::string& name, bool vectors);

// The same, to be read while it comes: for large grids. Reading behind its end throws std::ios_base::failure.
void readGrid(const std::filesystem::path& file, const std::string& name, bool vectors,
              const std::function<void(std::istream&)>& parse);

// The first grid of floats, or of float vectors, of the file, as an uncompressed stream of OpenVDB. Throws
// Unreadable.
std::string readGrid(const std::filesystem::path& file, bool vectors);

}  // namespace fluidtex::foreign
