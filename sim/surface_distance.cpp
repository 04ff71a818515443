#include "sim/surface_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace fluidtex::sim {
namespace {

constexpr int kReach = 3;                    // cells: how far the surface may be along an axis
constexpr int kHalo = kReach + 3;            // and two more for the interpolation's stencil there
constexpr int kSide = kLeafDim + 2 * kHalo;  // 20
constexpr int kStride[3] = {kSide * kSide, kSide, 1};
constexpr int kMaxIterations = 12;
constexpr double kTolerance = 1e-6;  // cells
// Second differences above this share of the slope are corners, or the middle of a film or a gap.
constexpr double kSharp = 0.7;

using Vec3 = openvdb::Vec3d;

// Cubic Lagrange weights of the values at -1, 0, 1, 2 for a place t in [0, 1], and their derivatives.
void lagrange(double t, double* w, double* dw) {
  const double a = t + 1.0, b = t, c = t - 1.0, d = t - 2.0;
  w[0] = -b * c * d / 6.0;
  w[1] = a * c * d / 2.0;
  w[2] = -a * b * d / 2.0;
  w[3] = a * b * c / 6.0;
  dw[0] = -(b * c + b * d + c * d) / 6.0;
  dw[1] = (a * c + a * d + c * d) / 2.0;
  dw[2] = -(a * b + a * d + b * d) / 2.0;
  dw[3] = (a * b + a * c + b * c) / 6.0;
}

// phi / h around one leaf; positions in cells from the leaf's first cell centre.
struct Block {
  std::array<float, kSide * kSide * kSide> value;

  const float* cell(int offset) const {
    return value.data() + ((offset >> 6) + kHalo) * kStride[0] + (((offset >> 3) & 7) + kHalo) * kStride[1] +
           (offset & 7) + kHalo;
  }

  // The lower corner of the cube of cell centres around x; null where the stencil would leave the block.
  const float* corner(const Vec3& x, double* t) const {
    int at[3];
    for (int a = 0; a < 3; ++a) {
      const double shifted = x[a] + kHalo;
      if (!(shifted >= 1.0 && shifted < kSide - 2)) return nullptr;
      at[a] = static_cast<int>(shifted);
      t[a] = shifted - at[a];
    }
    return value.data() + at[0] * kStride[0] + at[1] * kStride[1] + at[2];
  }

  // Value and gradient of the interpolation at x. False where the stencil would leave the block.
  bool evaluate(const Vec3& x, double& phi, Vec3& gradient) const {
    double t[3], w[3][4], dw[3][4];
    const float* at = corner(x, t);
    if (at == nullptr) return false;
    for (int a = 0; a < 3; ++a) lagrange(t[a], w[a], dw[a]);
    phi = 0.0;
    gradient = Vec3(0.0);
    for (int i = 0; i < 4; ++i) {
      double plane = 0.0, planeY = 0.0, planeZ = 0.0;
      for (int j = 0; j < 4; ++j) {
        const float* row = at + (i - 1) * kStride[0] + (j - 1) * kStride[1] - 1;
        const double line = w[2][0] * row[0] + w[2][1] * row[1] + w[2][2] * row[2] + w[2][3] * row[3];
        const double lineZ = dw[2][0] * row[0] + dw[2][1] * row[1] + dw[2][2] * row[2] + dw[2][3] * row[3];
        plane += w[1][j] * line;
        planeY += dw[1][j] * line;
        planeZ += w[1][j] * lineZ;
      }
      phi += w[0][i] * plane;
      gradient[0] += dw[0][i] * plane;
      gradient[1] += w[0][i] * planeY;
      gradient[2] += w[0][i] * planeZ;
    }
    return true;
  }

  // Whether phi bends smoothly on the stencil around x, where its slope is `slope`.
  bool smooth(const Vec3& x, double slope) const {
    double t[3];
    const float* at = corner(x, t);
    if (at == nullptr) return false;
    const float bar = static_cast<float>(kSharp * slope);
    for (int axis = 0; axis < 3; ++axis) {
      const int along = kStride[axis], b = kStride[(axis + 1) % 3], c = kStride[(axis + 2) % 3];
      for (int j = -1; j < 3; ++j) {
        for (int k = -1; k < 3; ++k) {
          const float* p = at + j * b + k * c;
          if (std::abs(p[-along] - 2.0f * p[0] + p[along]) > bar) return false;
          if (std::abs(p[0] - 2.0f * p[along] + p[2 * along]) > bar) return false;
        }
      }
    }
    return true;
  }

  // The nearest change of sign along an axis, linear between cell centres.
  std::optional<Vec3> crossing(int offset) const {
    const float* p = cell(offset);
    double best = kReach + 1.0;
    int bestAxis = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int d : {-kStride[axis], kStride[axis]}) {
        for (int n = 0; n < kReach; ++n) {
          const float here = p[n * d], there = p[(n + 1) * d];
          if ((here < 0.0f) == (there < 0.0f)) continue;
          const double far = n + static_cast<double>(here) / (static_cast<double>(here) - there);
          if (far < std::abs(best)) {
            best = d > 0 ? far : -far;
            bestAxis = axis;
          }
          break;
        }
      }
    }
    if (std::abs(best) > kReach) return std::nullopt;
    Vec3 x(offset >> 6, (offset >> 3) & 7, offset & 7);
    x[bestAxis] += best;
    return x;
  }

  // Distance from x to the surface, from a guess of the closest point.
  std::optional<double> distance(const Vec3& x, Vec3 point) const {
    for (int n = 0; n < kMaxIterations; ++n) {
      double phi;
      Vec3 gradient;
      if (!evaluate(point, phi, gradient)) return std::nullopt;
      const double square = gradient.lengthSqr();
      if (square < 1e-12) return std::nullopt;
      const Vec3 toSurface = -phi / square * gradient;
      const Vec3 away = x - point;
      const Vec3 along = away - away.dot(gradient) / square * gradient;
      Vec3 step = toSurface + along;
      const double length = step.length();
      if (length < kTolerance) {
        if (!smooth(point, std::sqrt(square))) return std::nullopt;
        return (x - point).length();
      }
      if (length > 1.0) step /= length;
      point += step;
    }
    return std::nullopt;
  }
};

}  // namespace

std::vector<CellDistance> surfaceDistances(const FloatTree& phi, const Coord& origin, float h) {
  thread_local Block block;
  gather(phi, origin, kHalo, block.value.data());
  std::vector<CellDistance> distances;
  bool scaled = false;
  for (std::int16_t offset = 0; offset < kLeafSize; ++offset) {
    const auto guess = block.crossing(offset);
    if (!guess) continue;
    if (!scaled) {
      for (float& value : block.value) value /= h;
      scaled = true;
    }
    const auto distance = block.distance(Vec3(offset >> 6, (offset >> 3) & 7, offset & 7), *guess);
    if (!distance || *distance > kReach) continue;
    // Never 0: the sign is the cell's side.
    const float away = std::max(static_cast<float>(*distance), 1e-6f);
    distances.push_back({offset, *block.cell(offset) < 0.0f ? -away : away});
  }
  return distances;
}

}  // namespace fluidtex::sim
