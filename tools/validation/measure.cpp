#include "tools/validation/measure.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::validation {
namespace {

using sim::Coord;
using sim::kLeafDim;

constexpr int kSide = kLeafDim + 2;

double mix(double a, double b, double t) {
  return a + t * (b - a);
}

// Trilinear value in a cube from its eight corners, z fastest.
double inCube(const double* q, double x, double y, double z) {
  return mix(mix(mix(q[0], q[1], z), mix(q[2], q[3], z), y), mix(mix(q[4], q[5], z), mix(q[6], q[7], z), y),
             x);
}

ShapeError addCube(const double* q, const Vec3d& corner, double h, const Distance& exact,
                   const Coord& samples) {
  ShapeError error;
  bool cut = false;
  for (int n = 1; n < 8; ++n) cut = cut || (q[n] < 0.0) != (q[0] < 0.0);
  const double whole = h * h * h;
  const double middle = exact(corner + Vec3d(0.5 * h));
  if (!cut && std::abs(middle) > h) {
    if (q[0] < 0.0) error.volume = whole;
    if ((q[0] < 0.0) != (middle < 0.0)) error.difference = whole;
    return error;
  }
  const double part = whole / (double(samples[0]) * samples[1] * samples[2]);
  for (int a = 0; a < samples[0]; ++a) {
    for (int b = 0; b < samples[1]; ++b) {
      for (int c = 0; c < samples[2]; ++c) {
        const double x = (a + 0.5) / samples[0], y = (b + 0.5) / samples[1], z = (c + 0.5) / samples[2];
        const bool inside = inCube(q, x, y, z) < 0.0;
        if (inside) error.volume += part;
        if (inside != (exact(corner + h * Vec3d(x, y, z)) < 0.0)) error.difference += part;
      }
    }
  }
  // Along the three edges from the cube's corner.
  static constexpr int kTo[3] = {4, 2, 1};
  for (int axis = 0; axis < 3; ++axis) {
    const double there = q[kTo[axis]];
    if ((there < 0.0) == (q[0] < 0.0)) continue;
    Vec3d x = corner;
    x[axis] += h * q[0] / (q[0] - there);
    error.farthest = std::max(error.farthest, std::abs(exact(x)));
  }
  return error;
}

}  // namespace

ShapeError compare(const sim::FloatGrid& phi, const Distance& exact, const Coord& cells, const Coord& samples,
                   const Coord& first) {
  const double h = phi.voxelSize()[0];
  const Coord blocks((cells[0] + 7) >> 3, (cells[1] + 7) >> 3, (cells[2] + 7) >> 3);
  const int count = blocks[0] * blocks[1] * blocks[2];
  std::vector<ShapeError> parts(count);
  tbb::parallel_for(0, count, [&](int b) {
    const Coord origin = Coord(b / (blocks[1] * blocks[2]), b / blocks[2] % blocks[1], b % blocks[2]) << 3;
    float values[kSide * kSide * kSide];
    sim::gather(phi.constTree(), origin, 1, values);
    for (int i = 0; i < std::min(kLeafDim, cells[0] - 1 - origin[0]); ++i) {
      for (int j = 0; j < std::min(kLeafDim, cells[1] - 1 - origin[1]); ++j) {
        for (int k = 0; k < std::min(kLeafDim, cells[2] - 1 - origin[2]); ++k) {
          const Coord corner = origin.offsetBy(i, j, k);
          if (corner[0] < first[0] || corner[1] < first[1] || corner[2] < first[2]) continue;
          double q[8];
          for (int n = 0; n < 8; ++n)
            q[n] = values[((i + 1 + (n >> 2)) * kSide + j + 1 + ((n >> 1) & 1)) * kSide + k + 1 + (n & 1)];
          const ShapeError cube = addCube(q, phi.indexToWorld(corner), h, exact, samples);
          parts[b].volume += cube.volume;
          parts[b].difference += cube.difference;
          parts[b].farthest = std::max(parts[b].farthest, cube.farthest);
        }
      }
    }
  });
  ShapeError all;
  for (const ShapeError& part : parts) {
    all.volume += part.volume;
    all.difference += part.difference;
    all.farthest = std::max(all.farthest, part.farthest);
  }
  return all;
}

std::vector<std::array<double, 2>> outline(const sim::FloatGrid& phi, const Coord& cells, int k) {
  const auto value = phi.getConstUnsafeAccessor();
  std::vector<std::array<double, 2>> points;
  for (int i = 0; i + 1 < cells[0]; ++i) {
    for (int j = 0; j + 1 < cells[1]; ++j) {
      // Marching squares, one corner after the other around the square.
      static constexpr int kX[5] = {0, 1, 1, 0, 0}, kY[5] = {0, 0, 1, 1, 0};
      std::vector<std::array<double, 2>> crossings;
      for (int n = 0; n < 4; ++n) {
        const Coord from(i + kX[n], j + kY[n], k), to(i + kX[n + 1], j + kY[n + 1], k);
        const double a = value.getValue(from), b = value.getValue(to);
        if ((a < 0.0) == (b < 0.0)) continue;
        const Vec3d x = phi.indexToWorld(from), y = phi.indexToWorld(to);
        const Vec3d at = x + (a / (a - b)) * (y - x);
        crossings.push_back({at[0], at[1]});
      }
      // Two, or four in a saddle.
      for (std::size_t n = 0; n + 1 < crossings.size(); n += 2) {
        points.push_back(crossings[n]);
        points.push_back(crossings[n + 1]);
      }
    }
  }
  return points;
}

}  // namespace fluidtex::validation
