#include "sim/surface/surface_distance.h"

#include "numerics/lanes.h"
#include "sim/grid/leaf_block.h"

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fluidtex::sim {
namespace {

constexpr int kSearched = 3;                // cells: largest distance of the surface along an axis
constexpr int kSearchHalo = kSearched + 3;  // and more for the interpolation's stencil there
constexpr int kMaxIterations = 12;
constexpr double kTolerance = 1e-3;  // cells: of the last step
// As kSharpSlope, across the surface. With 0.7 the middle of a sheet of three cells, which the interpolation
// then took for a bend, moved the surface outwards by 0.02 cells in each call.
constexpr double kSharpAcross = 0.3;

// For each axis the cubic Lagrange weights of the values at -1, 0, 1, 2 for a place t in [0, 1], and their
// derivatives.
struct Weights {
  alignas(32) double value[4][4], slope[4][4];

  explicit Weights(__m256d t) {
    const __m256d one = _mm256_set1_pd(1.0), two = _mm256_set1_pd(2.0);
    const __m256d sixth = _mm256_set1_pd(1.0 / 6.0), half = _mm256_set1_pd(0.5);
    const __m256d a = t + one, b = t, c = t - one, d = t - two;
    const __m256d ab = a * b, ac = a * c, ad = a * d, bc = b * c, bd = b * d, cd = c * d;
    store(-sixth * (b * cd), half * (a * cd), -half * (ab * d), sixth * (ab * c), value);
    store(-sixth * (bc + bd + cd), half * (ac + ad + cd), -half * (ab + ad + bd), sixth * (ab + ac + bc),
          slope);
  }

 private:
  // From one weight of all axes to all weights of one axis.
  static void store(__m256d w0, __m256d w1, __m256d w2, __m256d w3, double (*to)[4]) {
    const __m256d low01 = _mm256_unpacklo_pd(w0, w1), high01 = _mm256_unpackhi_pd(w0, w1);
    const __m256d low23 = _mm256_unpacklo_pd(w2, w3), high23 = _mm256_unpackhi_pd(w2, w3);
    _mm256_store_pd(to[0], _mm256_permute2f128_pd(low01, low23, 0x20));
    _mm256_store_pd(to[1], _mm256_permute2f128_pd(high01, high23, 0x20));
    _mm256_store_pd(to[2], _mm256_permute2f128_pd(low01, low23, 0x31));
  }
};

// phi / h around one leaf; positions in cells from the leaf's first cell centre.
struct SearchBlock : LeafBlock<kSearchHalo> {
  const float* cell(int offset) const { return data() + index(offset); }

  // The lower corner of the cube of cell centres around x; null where the stencil would leave the block.
  const float* corner(const Vec3d& x, double* t) const {
    int at[3];
    for (int a = 0; a < 3; ++a) {
      const double shifted = x[a] + kSearchHalo;
      if (!(shifted >= 1.0 && shifted < kSide - 2)) return nullptr;
      at[a] = static_cast<int>(shifted);
      t[a] = shifted - at[a];
    }
    return value.data() + at[0] * SearchBlock::kStride[0] + at[1] * SearchBlock::kStride[1] + at[2];
  }

  // Gradient of the interpolation at x, and its value in the fourth place. False where the stencil would
  // leave the block.
  bool evaluate(const Vec3d& x, double* result) const {
    double t[4] = {};
    const float* at = corner(x, t);
    if (at == nullptr) return false;
    const Weights w(_mm256_loadu_pd(t));
    // Sums over the stencil's rows along z, four values side by side.
    __m256d sum = _mm256_setzero_pd(), slopeX = sum, slopeY = sum;
    for (int i = 0; i < 4; ++i) {
      __m256d plane = _mm256_setzero_pd(), planeY = plane;
      for (int j = 0; j < 4; ++j) {
        const __m256d row = _mm256_cvtps_pd(
            _mm_loadu_ps(at + (i - 1) * SearchBlock::kStride[0] + (j - 1) * SearchBlock::kStride[1] - 1));
        plane += _mm256_set1_pd(w.value[1][j]) * row;
        planeY += _mm256_set1_pd(w.slope[1][j]) * row;
      }
      sum += _mm256_set1_pd(w.value[0][i]) * plane;
      slopeX += _mm256_set1_pd(w.slope[0][i]) * plane;
      slopeY += _mm256_set1_pd(w.value[0][i]) * planeY;
    }
    const __m256d wz = _mm256_load_pd(w.value[2]), dwz = _mm256_load_pd(w.slope[2]);
    // Four sums of four at once.
    const __m256d pairs = _mm256_hadd_pd(slopeX * wz, slopeY * wz);
    const __m256d others = _mm256_hadd_pd(sum * dwz, sum * wz);
    _mm256_storeu_pd(
        result, _mm256_permute2f128_pd(pairs, others, 0x20) + _mm256_permute2f128_pd(pairs, others, 0x31));
    return true;
  }

  // Whether phi bends smoothly on the stencil around x, where its gradient is `gradient`. Along the surface
  // a distance bends by the curvature, along the normal not at all: there it does so where the middle of a
  // sheet or a gap is near.
  bool smooth(const Vec3d& x, const Vec3d& gradient) const {
    double t[3];
    const float* at = corner(x, t);
    if (at == nullptr) return false;
    // The largest second difference of the stencil's lines along each axis, four lines side by side.
    const Float4 sign = float4(-0.0f);
    Float4 largest{};  // in shares of what is allowed
    const auto bend = [&](Float4 a, Float4 b, Float4 c, Float4 inverse) {
      largest = _mm_max_ps(largest, _mm_andnot_ps(sign, a - 2.0f * b + c) * inverse);
    };
    const double square = gradient.lengthSqr(), slope = std::sqrt(square);
    Float4 inverse[3];
    for (int a = 0; a < 3; ++a) {
      const double across = gradient[a] * gradient[a] / square;
      inverse[a] =
          float4(static_cast<float>(1.0 / (slope * (kSharpSlope + (kSharpAcross - kSharpSlope) * across))));
    }
    const float* first = at - SearchBlock::kStride[0] - SearchBlock::kStride[1] - 1;
    for (int j = 0; j < 4; ++j) {
      Float4 alongX[4], alongY[4], alongZ[4];
      for (int k = 0; k < 4; ++k) {
        alongX[k] = load4(first + k * SearchBlock::kStride[0] + j * SearchBlock::kStride[1]);
        alongY[k] = alongZ[k] = load4(first + j * SearchBlock::kStride[0] + k * SearchBlock::kStride[1]);
      }
      _MM_TRANSPOSE4_PS(alongZ[0], alongZ[1], alongZ[2], alongZ[3]);
      int axis = 0;
      for (const auto* line : {alongX, alongY, alongZ}) {
        bend(line[0], line[1], line[2], inverse[axis]);
        bend(line[1], line[2], line[3], inverse[axis]);
        ++axis;
      }
    }
    return _mm_movemask_ps(_mm_cmpgt_ps(largest, float4(1.0f))) == 0;
  }

  // By row along z, bit k: whether the sign changes at most kSearched cells from cell k. False where it never
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
      const std::uint32_t* own = inside.data() + ((row >> 3) + kSearchHalo) * kSide + (row & 7) + kSearchHalo;
      std::uint32_t changes = 0;
      for (int n = 1; n <= kSearched; ++n) {
        changes |= (*own ^ *own >> n) | (*own ^ *own << n);
        changes |= (*own ^ own[n]) | (*own ^ own[-n]) | (*own ^ own[n * kSide]) | (*own ^ own[-n * kSide]);
      }
      near[row] = static_cast<std::uint8_t>(changes >> kSearchHalo);
      found = found || near[row] != 0;
    }
    return found;
  }

  // The nearest change of sign along an axis, linear between cell centres; there is one at most kSearched
  // cells away.
  Vec3d crossing(int offset) const {
    const float* p = cell(offset);
    double best = kSearched + 1.0;
    int bestAxis = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int d : {-SearchBlock::kStride[axis], SearchBlock::kStride[axis]}) {
        for (int n = 0; n < kSearched; ++n) {
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
    Vec3d x(offset >> 6, (offset >> 3) & 7, offset & 7);
    x[bestAxis] += best;
    return x;
  }

  // Where the surface would be if phi were already a distance; `crossing` where that is too far.
  Vec3d guess(int offset, const Vec3d& crossing) const {
    const float* p = cell(offset);
    const Vec3d slope(0.5 * (p[SearchBlock::kStride[0]] - p[-SearchBlock::kStride[0]]),
                      0.5 * (p[SearchBlock::kStride[1]] - p[-SearchBlock::kStride[1]]),
                      0.5 * (p[SearchBlock::kStride[2]] - p[-SearchBlock::kStride[2]]));
    const double square = slope.lengthSqr();
    if (square < 0.5 || square > 2.0 || std::abs(p[0]) > kSearched) return crossing;
    return Vec3d(offset >> 6, (offset >> 3) & 7, offset & 7) - p[0] / square * slope;
  }
};

// The search for the point of the surface that is closest to a cell.
struct Search {
  Vec3d cell, point;
  double phi[4];  // gradient and value at the point
  std::int16_t offset;
  bool inBlock;
};

// One step of Newton's method, to the closest point of the tangent plane. True when the search has ended;
// `distance` is then that to the surface, or infinite where the search failed.
bool advance(Search& search, const SearchBlock& block, double& distance) {
  distance = std::numeric_limits<double>::infinity();
  if (!search.inBlock) return true;
  const double phi = search.phi[3];
  const Vec3d gradient(search.phi[0], search.phi[1], search.phi[2]);
  const double square = gradient.lengthSqr();
  if (square < 1e-12) return true;
  const Vec3d away = search.cell - search.point;
  const double height = away.dot(gradient);
  Vec3d step = away - (phi + height) / square * gradient;
  const double length = step.lengthSqr();
  if (length < kTolerance * kTolerance) {
    const double slope = std::sqrt(square);
    // The distance to the tangent plane, which differs from that to the surface by half the curvature times
    // the step squared.
    if (block.smooth(search.point, gradient)) distance = std::abs(phi + height) / slope;
    return true;
  }
  if (length > 1.0) step /= std::sqrt(length);
  search.point += step;
  return false;
}

}  // namespace

std::vector<CellDistance> surfaceDistances(const FloatTree& phi, const Coord& origin, float h,
                                           const std::array<bool, kLeafSize>& notAsked) {
  thread_local SearchBlock block;
  thread_local std::vector<Search> searches;
  block.load(phi, origin);
  std::array<std::uint8_t, 64> near;
  std::vector<CellDistance> distances;
  if (!block.nearCells(near)) return distances;
  const float inverse = 1.0f / h;
  for (float& value : block.value) value *= inverse;
  searches.clear();
  for (std::int16_t offset = 0; offset < kLeafSize; ++offset) {
    if ((near[std::size_t(offset >> 3)] >> (offset & 7) & 1) == 0 || notAsked[offset]) continue;
    const Vec3d cell(offset >> 6, (offset >> 3) & 7, offset & 7);
    searches.push_back({cell, block.guess(offset, block.crossing(offset)), {}, offset, true});
  }
  // All cells take their steps together, so that their evaluations overlap.
  for (int n = 0; n < kMaxIterations && !searches.empty(); ++n) {
    for (Search& search : searches) search.inBlock = block.evaluate(search.point, search.phi);
    std::erase_if(searches, [&](Search& search) {
      double distance;
      if (!advance(search, block, distance)) return false;
      // Never 0: the sign is the cell's side.
      const float away = std::max(static_cast<float>(distance), 1e-6f);
      if (distance <= kSearched)
        distances.push_back({search.offset, *block.cell(search.offset) < 0.0f ? -away : away});
      return true;
    });
  }
  return distances;
}

}  // namespace fluidtex::sim
