// Where a mesh from a file lies in the world.
#pragma once

#include "sim/vec3.h"

#include <openvdb/Types.h>
#include <openvdb/math/Mat3.h>

#include <numbers>

namespace fluidtex::sim {

// The axis that points upwards in a file. Of files with y up, y becomes z and z becomes -y.
enum class UpAxis { z, y };

// x_world = scale R x_file + translate: the file's up axis becomes z, then the mesh is turned about x, y and
// z in this order.
struct MeshPlace {
  UpAxis up = UpAxis::z;
  Vec3d rotate{0.0};  // degrees, anticlockwise for those whom the axis points at
  double scale = 1.0;
  Vec3d translate{0.0};  // m
};

// R, for row vectors as OpenVDB's matrices are: R.transform(x).
inline openvdb::Mat3d rotationOf(UpAxis up, const Vec3d& degrees) {
  openvdb::Mat3d matrix = openvdb::Mat3d::identity();
  if (up == UpAxis::y) matrix = openvdb::Mat3d(1, 0, 0, 0, 0, 1, 0, -1, 0);
  for (int axis = 0; axis < 3; ++axis) {
    if (degrees[axis] == 0.0) continue;
    Vec3d about(0.0);
    about[axis] = 1.0;
    matrix =
        matrix * openvdb::math::rotation<openvdb::Mat3d>(about, degrees[axis] * std::numbers::pi / 180.0);
  }
  return matrix;
}

}  // namespace fluidtex::sim
