#include "caches/liquid/placement.h"

namespace fluidtex::caches {

using openvdb::Mat3d;
using openvdb::Mat4d;

Mat4d worldFromFile(const Options& options) {
  Mat4d matrix = Mat4d::identity();
  matrix.setMat3(sim::rotationOf(options.up, options.turn) * (options.unit * options.scale));
  matrix.setTranslation(options.move);
  return matrix;
}

Mat3d velocityFromFile(const Options& options) {
  return sim::rotationOf(options.up, options.turn) * (options.unit * options.scale * options.velocityScale);
}

}  // namespace fluidtex::caches
