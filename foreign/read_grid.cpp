#include "foreign/read_grid.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <cmath>
#include <sstream>

namespace fluidtex::foreign::here {
namespace {

// Places in it can be found, there and back.
bool isUsable(const openvdb::math::Transform& transform) {
  for (const openvdb::Vec3d& index : {openvdb::Vec3d(0.0), openvdb::Vec3d(1.0, 2.0, 3.0)}) {
    const openvdb::Vec3d world = transform.indexToWorld(index), back = transform.worldToIndex(world);
    for (int axis = 0; axis < 3; ++axis)
      if (!std::isfinite(world[axis]) || !(std::abs(back[axis] - index[axis]) < 1e-3)) return false;
  }
  return true;
}

}  // namespace

std::string readGrid(const std::filesystem::path& file, bool vectors) {
  openvdb::initialize();
  const std::string type = vectors ? openvdb::Vec3SGrid::gridType() : openvdb::FloatGrid::gridType();
  try {
    openvdb::io::File vdb(file.string());
    vdb.open(false);
    for (auto name = vdb.beginName(); name != vdb.endName(); ++name) {
      if (vdb.readGridMetadata(name.gridName())->type() != type) continue;
      const openvdb::GridBase::Ptr grid = vdb.readGrid(name.gridName());
      if (!isUsable(grid->transform())) throw Unreadable("has a transform that leads nowhere");
      std::ostringstream out;
      openvdb::io::Stream stream(out);
      stream.setCompression(openvdb::io::COMPRESS_NONE);  // which would drop inactive values
      stream.write(openvdb::GridCPtrVec{grid});
      return std::move(out).str();
    }
  } catch (const openvdb::Exception& error) {
    throw Unreadable("is no OpenVDB file that can be read (" + asClause(error.what()) + ")");
  }
  throw Unreadable(vectors ? "holds no grid of float vectors" : "holds no grid of floats");
}

}  // namespace fluidtex::foreign::here
