#include "caches/liquid/mantaflow_frame.h"

#include "caches/formats/mantaflow_config.h"
#include "caches/formats/read_fields.h"
#include "foreign/grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::caches {
namespace {

using openvdb::Coord;
using openvdb::Mat3d;
using openvdb::Mat4d;
using openvdb::Vec3d;

// Of a frame in the solver's clock, where a cache has one frame only: 25 frames a second, time scale 1.
constexpr double kUsualFrame = 0.1;

// Outside of what is known, voxels.
constexpr float kOutside = 3.0f;

Mat4d matrixOf(const Mat3d& linear, const Vec3d& translation) {
  Mat4d matrix = Mat4d::identity();
  matrix.setMat3(linear);
  matrix.setTranslation(translation);
  return matrix;
}

double frameTime(const Cache& cache, int number, const MantaflowConfig& here) {
  const auto& files = cache.layout.config.byNumber;
  for (const int other : {number + 1, number - 1})
    if (const auto file = files.find(other); file != files.end())
      if (const double time = std::abs(double(readMantaflowConfig(file->second).time) - here.time);
          time > 0.0)
        return time;
  return kUsualFrame;
}

}  // namespace

MantaflowPlace mantaflowPlace(const Cache& cache, int number) {
  const MantaflowConfig config = readMantaflowConfig(cache.layout.config.at(number));
  const Mat3d object = config.worldFromObject.getMat3();
  const Vec3d scale(object.row(0).length(), object.row(1).length(), object.row(2).length());
  Mat3d turned;
  for (int row = 0; row < 3; ++row) turned.setRow(row, object.row(row) / scale[row]);
  const Vec3d p0(config.p0), p1(config.p1), size = (p1 - p0) * scale;
  const double longest = std::max({std::abs(size[0]), std::abs(size[1]), std::abs(size[2])});
  MantaflowPlace place;
  place.voxel = longest * double(config.dx);
  place.resolution = config.resolution;
  const Vec3d middle = config.worldFromObject.transform(0.5 * (p0 + p1));
  const Mat3d cells = turned * place.voxel;
  const Vec3d first = Vec3d(0.5) - 0.5 * config.resolution.asVec3d();
  place.worldFromIndex = matrixOf(cells, cells.transpose() * first + middle);
  place.worldFromMesh = matrixOf(turned * longest, middle);
  place.metersPerSecond = turned * (place.voxel * frameTime(cache, number, config) * cache.frameRate);
  return place;
}

void closeUpperSides(const Coord& resolution, openvdb::Vec3SGrid& velocity) {
  openvdb::Vec3SGrid::Accessor values = velocity.getAccessor();
  Coord last = resolution.offsetBy(-1);
  for (int axis = 0; axis < 3; ++axis) {
    Coord first(0);
    first[axis] = last[axis];
    const openvdb::CoordBBox side(first, last);
    bool flowsOut = false;
    for (auto face = side.begin(); face && !flowsOut; ++face) flowsOut = values.getValue(*face)[axis] > 0.0f;
    for (auto face = side.begin(); face; ++face) {
      openvdb::Vec3f v;
      if (!values.probeValue(*face, v)) continue;
      if (!flowsOut) v[axis] = 0.0f;
      values.setValueOn(*face, v);
      Coord beyond = *face;
      ++beyond[axis];
      values.setValueOn(beyond, v);
    }
    ++last[axis];  // with the edges
  }
}

openvdb::FloatGrid::Ptr mantaflowDistance(const std::filesystem::path& file, const Coord& resolution) {
  const openvdb::FloatGrid::Ptr phi = readScalars(file, "phi");
  openvdb::FloatGrid::Ptr obstacle;
  for (const foreign::GridHead& head : foreign::listGrids(file))
    if (head.name == "phi_obstacle" && head.readable) obstacle = readScalars(file, "phi_obstacle");
  const openvdb::FloatGrid::Ptr result = openvdb::FloatGrid::create(kOutside);
  std::vector<openvdb::FloatTree::LeafNodeType*> leaves;
  for (int i = 0; i < resolution[0]; i += 8)
    for (int j = 0; j < resolution[1]; j += 8)
      for (int k = 0; k < resolution[2]; k += 8) leaves.push_back(result->tree().touchLeaf(Coord(i, j, k)));
  const Coord last = resolution.offsetBy(-1);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const auto liquid = phi->getConstAccessor();
    const auto solid = (obstacle ? obstacle : phi)->getConstAccessor();
    for (openvdb::Index offset = 0; offset < openvdb::FloatTree::LeafNodeType::SIZE; ++offset) {
      const Coord at = leaves[n]->offsetToGlobalCoord(offset);
      if (Coord::maxComponent(at, last) != last) continue;
      float value = kOutside;
      if (!liquid.probeValue(at, value)) value = kOutside;
      if (float wall = 0.0f; obstacle && solid.probeValue(at, wall)) value = std::max(value, -wall);
      leaves[n]->setValueOn(offset, std::min(value, kOutside));
    }
  });
  return result;
}

}  // namespace fluidtex::caches
