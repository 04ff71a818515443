#include "caches/liquid/triangle_raster.h"

#include "caches/liquid/cell_triangles.h"
#include "numerics/lanes.h"

#include <immintrin.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::caches {
namespace {

using openvdb::Vec3d;

constexpr int kLast = sim::kLeafDim - 1;
constexpr double kSliver = 1e-5;

// The cells of a block from low to high, along one axis; none where low > high.
struct Range {
  int low, high;
};

Range cellsBetween(double low, double high) {
  return {int(std::ceil(std::clamp(low, 0.0, kLast + 1.0))),
          int(std::floor(std::clamp(high, -1.0, double(kLast))))};
}

double lowest(const BlockTriangle& x, int axis) {
  return std::min({x[0][axis], x[1][axis], x[2][axis]});
}

double highest(const BlockTriangle& x, int axis) {
  return std::max({x[0][axis], x[1][axis], x[2][axis]});
}

struct Lanes3 {
  Float8 x, y, z;

  Lanes3() = default;
  Lanes3(Float8 first, Float8 second, Float8 third) : x(first), y(second), z(third) {}
  Lanes3(const Vec3d& v) : x(float8(float(v[0]))), y(float8(float(v[1]))), z(float8(float(v[2]))) {}
  Lanes3 operator-(const Lanes3& b) const { return {x - b.x, y - b.y, z - b.z}; }
  // This less t times b.
  Lanes3 less(Float8 t, const Lanes3& b) const {
    return {_mm256_fnmadd_ps(t, b.x, x), _mm256_fnmadd_ps(t, b.y, y), _mm256_fnmadd_ps(t, b.z, z)};
  }
  Float8 dot(const Lanes3& b) const { return _mm256_fmadd_ps(x, b.x, _mm256_fmadd_ps(y, b.y, z * b.z)); }
};

// Distances of eight places at a time.
class LaneTriangle {
 public:
  explicit LaneTriangle(const BlockTriangle& corner) {
    const Vec3d cross = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    double longest = 0.0;
    for (int n = 0; n < 3; ++n) {
      const Vec3d along = corner[(n + 1) % 3] - corner[n];
      const double square = along.lengthSqr();
      m_corner[n] = corner[n];
      m_along[n] = along;
      m_inverse[n] = float8(square > 0.0 ? float(1.0 / square) : 0.0f);
      m_inward[n] = cross.cross(along);
      longest = std::max(longest, square);
    }
    const double doubleArea = cross.length();
    m_hasFace = doubleArea > kSliver * longest;
    if (m_hasFace) m_normal = cross / doubleArea;
  }

  Float8 squares(const Lanes3& place) const {
    const Float8 zero{}, one = float8(1.0f);
    Float8 best = float8(1e30f), above = _mm256_castsi256_ps(_mm256_set1_epi32(-1));
    Lanes3 from;
    for (int n = 0; n < 3; ++n) {
      from = place - m_corner[n];
      const Float8 t = _mm256_max_ps(zero, _mm256_min_ps(one, from.dot(m_along[n]) * m_inverse[n]));
      const Lanes3 away = from.less(t, m_along[n]);
      best = _mm256_min_ps(best, away.dot(away));
      above = _mm256_and_ps(above, _mm256_cmp_ps(from.dot(m_inward[n]), zero, _CMP_GE_OQ));
    }
    if (!m_hasFace) return best;
    const Float8 height = from.dot(m_normal);
    return _mm256_blendv_ps(best, height * height, above);
  }

 private:
  Lanes3 m_corner[3], m_along[3], m_inward[3];
  Float8 m_inverse[3];
  Lanes3 m_normal;
  bool m_hasFace = false;
};

// Four cells of a row along z.
void keepNearer(const Float4& squares, std::uint32_t number, float* square, std::uint32_t* triangle) {
  const Float4 old = load4(square), nearer = _mm_cmplt_ps(squares, old);
  if (_mm_movemask_ps(nearer) == 0) return;
  store4(square, _mm_blendv_ps(old, squares, nearer));
  auto* const at = reinterpret_cast<__m128i*>(triangle);
  _mm_storeu_si128(
      at, _mm_blendv_epi8(_mm_loadu_si128(at), _mm_set1_epi32(int(number)), _mm_castps_si128(nearer)));
}

}  // namespace

void rasterDistances(const BlockTriangle& corners, std::uint32_t number, BlockNearest& nearest) {
  Range range[3];
  for (int axis = 0; axis < 3; ++axis) {
    range[axis] = cellsBetween(lowest(corners, axis) - kRasterReach, highest(corners, axis) + kRasterReach);
    if (range[axis].low > range[axis].high) return;
  }
  const LaneTriangle triangle(corners);
  const Float4 steps = float4(0.0f, 1.0f, 2.0f, 3.0f);
  const int width = range[1].high - range[1].low + 1, rows = (range[0].high - range[0].low + 1) * width;
  // Rows two at a time, in pieces of four cells, which must not reach beyond the row.
  for (int piece = std::min(range[2].low, sim::kLeafDim - 4); piece <= range[2].high; piece += 4) {
    const int k = std::min(piece, sim::kLeafDim - 4);
    const Float4 z = float(k) + steps;
    for (int row = 0; row < rows; row += 2) {
      int i[2], j[2];
      for (int n = 0; n < 2; ++n) {
        const int at = std::min(row + n, rows - 1);
        i[n] = range[0].low + at / width;
        j[n] = range[1].low + at % width;
      }
      const Lanes3 place(joined8(float4(float(i[0])), float4(float(i[1]))),
                         joined8(float4(float(j[0])), float4(float(j[1]))), joined8(z, z));
      const Float8 squares = triangle.squares(place);
      for (int n = 0; n < 2; ++n) {
        const int offset = 64 * i[n] + 8 * j[n] + k;
        keepNearer(n == 0 ? low4(squares) : high4(squares), number, nearest.square.data() + offset,
                   nearest.triangle.data() + offset);
      }
    }
  }
}

void rasterCrossings(const BlockTriangle& corners, CrossedLines& crossed) {
  for (int axis = 0; axis < 3; ++axis)
    if (highest(corners, axis) < -kTouch || lowest(corners, axis) > sim::kLeafDim + kTouch) return;
  const Vec3d edge[3] = {corners[1] - corners[0], corners[2] - corners[1], corners[0] - corners[2]};
  const Vec3d normal = edge[0].cross(corners[2] - corners[0]);
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    const double bottom = lowest(corners, axis), top = highest(corners, axis);
    if (top + kTouch < 0.0 || bottom - kTouch >= sim::kLeafDim) continue;
    const Range across = cellsBetween(lowest(corners, u) - kTouch, highest(corners, u) + kTouch),
                up = cellsBetween(lowest(corners, v) - kTouch, highest(corners, v) + kTouch);
    const bool isParallel = std::abs(normal[axis]) <= kTouch * (std::abs(normal[u]) + std::abs(normal[v]));
    double slack[3];
    for (int n = 0; n < 3; ++n) slack[n] = kTouch * (std::abs(edge[n][u]) + std::abs(edge[n][v]));
    for (int p = across.low; p <= across.high; ++p)
      for (int q = up.low; q <= up.high; ++q) {
        bool isLeft = true, isRight = true;
        for (int n = 0; n < 3; ++n) {
          const double side = edge[n][u] * (q - corners[n][v]) - edge[n][v] * (p - corners[n][u]);
          isLeft = isLeft && side >= -slack[n];
          isRight = isRight && side <= slack[n];
        }
        if (!isLeft && !isRight) continue;
        double low = bottom, high = top;
        if (!isParallel) {
          const double at =
              corners[0][axis] -
              (normal[u] * (p - corners[0][u]) + normal[v] * (q - corners[0][v])) / normal[axis];
          low = high = std::clamp(at, bottom, top);
        }
        const int first = int(std::floor(std::clamp(low - kTouch, -1.0, double(sim::kLeafDim)))),
                  last = int(std::floor(std::clamp(high + kTouch, -1.0, double(sim::kLeafDim))));
        for (int k = std::max(first, 0); k <= std::min(last, kLast); ++k)
          sim::setBit(crossed[std::size_t(axis)],
                      sim::kLeafStride[axis] * k + sim::kLeafStride[u] * p + sim::kLeafStride[v] * q);
      }
  }
}

}  // namespace fluidtex::caches
