#include "caches/liquid/placement.h"

#include <numbers>

namespace fluidtex::caches {
namespace {

using openvdb::Mat3d;
using openvdb::Mat4d;

// Rows are what the axes of the files become.
Mat3d turned(const Options& options) {
  Mat3d upright = Mat3d::identity();
  if (options.up == UpAxis::y) upright = Mat3d(1, 0, 0, 0, 0, 1, 0, -1, 0);
  for (int axis = 0; axis < 3; ++axis) {
    openvdb::Vec3d about(0.0);
    about[axis] = 1.0;
    const double angle = options.turn[axis] * std::numbers::pi / 180.0;
    upright = upright * openvdb::math::rotation<Mat3d>(about, angle);
  }
  return upright;
}

}  // namespace

Mat4d worldFromFile(const Options& options) {
  Mat4d matrix = Mat4d::identity();
  matrix.setMat3(turned(options) * (options.unit * options.scale));
  matrix.setTranslation(options.move);
  return matrix;
}

Mat3d velocityFromFile(const Options& options) {
  return turned(options) * (options.unit * options.scale * options.velocityScale);
}

}  // namespace fluidtex::caches
