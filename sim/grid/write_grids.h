// Writing of OpenVDB files.
#pragma once

#include <openvdb/openvdb.h>

#include <filesystem>

namespace fluidtex::sim {

// Writes what openvdb::io::File does, uncompressed, so that every value returns bit for bit, those of
// inactive voxels too. Throws openvdb::IoError where the disk does not take all of it.
void writeGrids(const openvdb::GridCPtrVec& grids, const openvdb::MetaMap& metadata,
                const std::filesystem::path& file);

}  // namespace fluidtex::sim
