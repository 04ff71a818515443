#include "sim/surface_distance.h"

#include <immintrin.h>

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
constexpr double kTolerance = 1e-3;  // cells: of the last step
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
    // Sums over the stencil's rows along z, four values side by side.
    __m256d sum = _mm256_setzero_pd(), slopeX = sum, slopeY = sum;
    for (int i = 0; i < 4; ++i) {
      __m256d plane = _mm256_setzero_pd(), planeY = plane;
      for (int j = 0; j < 4; ++j) {
        const __m256d row =
            _mm256_cvtps_pd(_mm_loadu_ps(at + (i - 1) * kStride[0] + (j - 1) * kStride[1] - 1));
        plane += _mm256_set1_pd(w[1][j]) * row;
        planeY += _mm256_set1_pd(dw[1][j]) * row;
      }
      sum += _mm256_set1_pd(w[0][i]) * plane;
      slopeX += _mm256_set1_pd(dw[0][i]) * plane;
      slopeY += _mm256_set1_pd(w[0][i]) * planeY;
    }
    const __m256d wz = _mm256_loadu_pd(w[2]), dwz = _mm256_loadu_pd(dw[2]);
    // Four sums of four at once.
    const __m256d pairs = _mm256_hadd_pd(sum * wz, slopeX * wz);
    const __m256d others = _mm256_hadd_pd(slopeY * wz, sum * dwz);
    const __m256d sums =
        _mm256_permute2f128_pd(pairs, others, 0x20) + _mm256_permute2f128_pd(pairs, others, 0x31);
    alignas(32) double result[4];
    _mm256_store_pd(result, sums);
    phi = result[0];
    gradient = Vec3(result[1], result[2], result[3]);
    return true;
  }

  // Whether phi bends smoothly on the stencil around x, where its slope is `slope`.
  bool smooth(const Vec3& x, double slope) const {
    double t[3];
    const float* at = corner(x, t);
    if (at == nullptr) return false;
    // The largest second difference of the stencil's lines along each axis, four lines side by side.
    const __m128 two = _mm_set1_ps(2.0f), sign = _mm_set1_ps(-0.0f);
    __m128 largest = _mm_setzero_ps();
    const auto bend = [&](__m128 a, __m128 b, __m128 c) {
      largest = _mm_max_ps(largest, _mm_andnot_ps(sign, a - two * b + c));
    };
    const float* first = at - kStride[0] - kStride[1] - 1;
    for (int j = 0; j < 4; ++j) {
      __m128 alongX[4], alongY[4], alongZ[4];
      for (int k = 0; k < 4; ++k) {
        alongX[k] = _mm_loadu_ps(first + k * kStride[0] + j * kStride[1]);
        alongY[k] = alongZ[k] = _mm_loadu_ps(first + j * kStride[0] + k * kStride[1]);
      }
      _MM_TRANSPOSE4_PS(alongZ[0], alongZ[1], alongZ[2], alongZ[3]);
      for (const auto* line : {alongX, alongY, alongZ}) {
        bend(line[0], line[1], line[2]);
        bend(line[1], line[2], line[3]);
      }
    }
    return _mm_movemask_ps(_mm_cmpgt_ps(largest, _mm_set1_ps(static_cast<float>(kSharp * slope)))) == 0;
  }

  // By row along z, bit k: whether the sign changes at most kReach cells from cell k. False where it never
  // does.
  bool nearCells(std::array<std::uint8_t, 64>& near) const {
    // Bit k: whether the value at z = k is negative.
    std::array<std::uint32_t, kSide * kSide> inside;
    bool any = false, all = true;
    for (int row = 0; row < kSide * kSide; ++row) {
      std::uint32_t bits = 0;
      for (int k = 0; k < kSide; ++k) bits |= std::uint32_t(value[row * kSide + k] < 0.0f) << k;
      inside[row] = bits;
      any = any || bits != 0;
      all = all && bits == (1u << kSide) - 1;
    }
    if (!any || all) return false;
    bool found = false;
    for (int row = 0; row < 64; ++row) {
      const std::uint32_t* own = inside.data() + ((row >> 3) + kHalo) * kSide + (row & 7) + kHalo;
      std::uint32_t changes = 0;
      for (int n = 1; n <= kReach; ++n) {
        changes |= (*own ^ *own >> n) | (*own ^ *own << n);
        changes |= (*own ^ own[n]) | (*own ^ own[-n]) | (*own ^ own[n * kSide]) | (*own ^ own[-n * kSide]);
      }
      near[row] = static_cast<std::uint8_t>(changes >> kHalo);
      found = found || near[row] != 0;
    }
    return found;
  }

  // The nearest change of sign along an axis, linear between cell centres; there is one at most kReach cells
  // away.
  Vec3 crossing(int offset) const {
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
      const Vec3 away = x - point;
      const double height = away.dot(gradient);
      Vec3 step = away - (phi + height) / square * gradient;
      const double length = step.lengthSqr();
      if (length < kTolerance * kTolerance) {
        const double slope = std::sqrt(square);
        if (!smooth(point, slope)) return std::nullopt;
        // To the tangent plane, which differs from the surface by half the curvature times the step squared.
        return std::abs(phi + height) / slope;
      }
      if (length > 1.0) step /= std::sqrt(length);
      point += step;
    }
    return std::nullopt;
  }

  // Where the surface would be if phi were a distance already; `crossing` where that leads too far.
  Vec3 guess(int offset, const Vec3& crossing) const {
    const float* p = cell(offset);
    const Vec3 slope(0.5 * (p[kStride[0]] - p[-kStride[0]]), 0.5 * (p[kStride[1]] - p[-kStride[1]]),
                     0.5 * (p[kStride[2]] - p[-kStride[2]]));
    const double square = slope.lengthSqr();
    if (square < 0.5 || square > 2.0 || std::abs(p[0]) > kReach) return crossing;
    return Vec3(offset >> 6, (offset >> 3) & 7, offset & 7) - p[0] / square * slope;
  }
};

}  // namespace

std::vector<CellDistance> surfaceDistances(const FloatTree& phi, const Coord& origin, float h) {
  thread_local Block block;
  gather(phi, origin, kHalo, block.value.data());
  std::array<std::uint8_t, 64> near;
  std::vector<CellDistance> distances;
  if (!block.nearCells(near)) return distances;
  for (float& value : block.value) value /= h;
  for (std::int16_t offset = 0; offset < kLeafSize; ++offset) {
    if ((near[std::size_t(offset >> 3)] >> (offset & 7) & 1) == 0) continue;
    const Vec3 x(offset >> 6, (offset >> 3) & 7, offset & 7);
    const auto distance = block.distance(x, block.guess(offset, block.crossing(offset)));
    if (!distance || *distance > kReach) continue;
    // Never 0: the sign is the cell's side.
    const float away = std::max(static_cast<float>(*distance), 1e-6f);
    distances.push_back({offset, *block.cell(offset) < 0.0f ? -away : away});
  }
  return distances;
}

}  // namespace fluidtex::sim
