// Grids from OpenVDB files.
#pragma once

#include <openvdb/openvdb.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace fluidtex::texture {

// The first grid of a type in an OpenVDB file. Throws std::runtime_error that names the file and what is
// wrong.
template <typename Grid>
typename Grid::Ptr readGrid(const std::filesystem::path& file) {
  const auto fail = [&](const std::string& why) ->
      typename Grid::Ptr { throw std::runtime_error(file.string() + ": " + why); };
  openvdb::io::File vdb(file.string());
  try {
    vdb.open(false);
    for (auto name = vdb.beginName(); name != vdb.endName(); ++name) {
      if (!vdb.readGridMetadata(name.gridName())->template isType<Grid>()) continue;
      return openvdb::gridPtrCast<Grid>(vdb.readGrid(name.gridName()));
    }
  } catch (const openvdb::Exception& error) {
    return fail(std::string("is no OpenVDB file that can be read (") + error.what() + ")");
  }
  return fail(std::is_same_v<typename Grid::ValueType, float> ? "holds no grid of floats"
                                                              : "holds no grid of float vectors");
}

}  // namespace fluidtex::texture
