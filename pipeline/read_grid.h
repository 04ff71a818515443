// Reads grids from OpenVDB files.
#pragma once

#include "foreign/grid.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace fluidtex::pipeline {

// First grid of a type (FloatGrid or Vec3SGrid) in an OpenVDB file. Throws std::runtime_error that names the
// file and the fault.
template <typename Grid>
typename Grid::Ptr readGrid(const std::filesystem::path& file) {
  constexpr bool kVectors = std::is_same_v<Grid, openvdb::Vec3SGrid>;
  static_assert(kVectors || std::is_same_v<Grid, openvdb::FloatGrid>);
  try {
    std::istringstream stream(foreign::readGrid(file, kVectors));
    openvdb::io::Stream grids(stream, false);  // no delayed loading
    return openvdb::gridPtrCast<Grid>(grids.getGrids()->at(0));
  } catch (const foreign::Unreadable& error) {
    throw std::runtime_error(file.string() + ": " + error.what());
  } catch (const openvdb::Exception& error) {
    throw std::runtime_error(file.string() + ": is no OpenVDB file that can be read (" +
                             foreign::asClause(error.what()) + ")");
  }
}

}  // namespace fluidtex::pipeline
