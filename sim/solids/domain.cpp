#include "sim/solids/domain.h"

namespace fluidtex::sim {

CoordBBox domainCells(const Options& options) {
  CoordBBox box = firstCells(cellCount(options.size, options.voxelSize()));
  for (int a = 0; a < 3; ++a) {
    if (options.sides[2 * a] == Side::unbounded) box.min()[a] = -kEndless;
    if (options.sides[2 * a + 1] == Side::unbounded) box.max()[a] = kEndless - 1;
  }
  return box;
}

openvdb::BBoxd domainBox(const Options& options) {
  openvdb::BBoxd box(Vec3d(0.0), options.size);
  for (int a = 0; a < 3; ++a) {
    if (options.sides[2 * a] == Side::unbounded) box.min()[a] = -kForever;
    if (options.sides[2 * a + 1] == Side::unbounded) box.max()[a] = kForever;
  }
  return box;
}

}  // namespace fluidtex::sim
