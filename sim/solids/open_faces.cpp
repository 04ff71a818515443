// Open areas by marching squares on nodal distances: Ng, Min, Gibou, "An efficient fluid-solid coupling
// algorithm for single-phase flows", 2009, section 3; Min and Gibou, "Geometric integration over irregular
// domains", 2007.
#include "sim/solids/open_faces.h"

#include "sim/grid/mac_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace fluidtex::sim {

namespace {

// Open area fractions below this count as closed: they would pass almost nothing and make the matrix
// ill-conditioned.
constexpr double kClosed = 1e-3;

// Largest spacing of samples between cell centres, in cells, so that walls of half a cell are found.
constexpr double kThinnestWall = 0.25;

// At this distance from a surface, in cells, the corners of a cell are on the centre's side: half its
// diagonal, and the error of distances that are interpolated on a lattice.
constexpr double kClear = 1.2;

// Where distances at the ends of an edge of a cell, in cells, put the surface on it, the distance is no more
// than this off 0 as long as they are to one smooth surface: a circle of a cell's radius is 1/8 of a cell
// away from the middle of a chord of that length.
constexpr double kSmooth = 0.125;

// Where a surface crosses an edge between two corners, as a share of it from the first.
double crossing(double from, double to) {
  return from / (from - to);
}

// Area of the part of the unit square where the distance is positive; corners in order, no saddle. cut:
// where a surface crosses the edge from each corner to the next.
double polygonArea(const std::array<double, 4>& d, const std::array<double, 4>& cut) {
  static constexpr double kX[4] = {0, 1, 1, 0}, kY[4] = {0, 0, 1, 1};
  double x[8], y[8];
  int n = 0;
  for (int a = 0; a < 4; ++a) {
    const int b = (a + 1) & 3;
    if (d[a] > 0.0) {
      x[n] = kX[a];
      y[n++] = kY[a];
    }
    if ((d[a] > 0.0) != (d[b] > 0.0)) {
      const double t = cut[a];
      x[n] = kX[a] + t * (kX[b] - kX[a]);
      y[n++] = kY[a] + t * (kY[b] - kY[a]);
    }
  }
  double twice = 0.0;
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    twice += x[i] * y[j] - x[j] * y[i];
  }
  return 0.5 * twice;
}

// Area of a saddle's corner triangle: the corner alone has its sign.
double cornerArea(double corner, double next, double previous) {
  return 0.5 * corner / (corner - next) * corner / (corner - previous);
}

double snapped(double fraction) {
  if (fraction < kClosed) return 0.0;
  constexpr double kRounding = 1e-6;
  return fraction > 1.0 - kRounding ? 1.0 : fraction;
}

std::array<double, 4> straightCuts(const std::array<double, 4>& d) {
  return {crossing(d[0], d[1]), crossing(d[1], d[2]), crossing(d[2], d[3]), crossing(d[3], d[0])};
}

// openAreaFraction with the places where a surface cuts the edges; in a saddle, that of the distances alone.
double openArea(const std::array<double, 4>& d, const std::array<double, 4>& cut) {
  const auto positive = std::count_if(d.begin(), d.end(), [](double distance) { return distance > 0.0; });
  if (positive == 0) return 0.0;
  if (*std::min_element(d.begin(), d.end()) >= 0.0) return 1.0;
  const bool saddle = positive == 2 && (d[0] > 0.0) == (d[2] > 0.0);
  if (!saddle) return snapped(polygonArea(d, cut));
  // The mean decides whether the two equal corners are connected.
  const bool joined = d[0] + d[1] + d[2] + d[3] > 0.0;
  double corners = 0.0;
  for (int a = 0; a < 4; ++a) {
    if ((d[a] > 0.0) != joined) corners += cornerArea(d[a], d[(a + 1) & 3], d[(a + 3) & 3]);
  }
  return snapped(joined ? 1.0 - corners : corners);
}

// Whether a solid crosses the line between two places outside it, `length` metres apart, with distances low
// and high. A distance changes by at most the way covered; samples are at most `least` apart.
bool isCrossed(const SolidDistance& distance, const Vec3d& from, const Vec3d& to, double low, double high,
               double length, double least) {
  if (low + high > length || length <= least) return false;
  const Vec3d middle = 0.5 * (from + to);
  const double there = distance(middle), half = 0.5 * length;
  return there < 0.0 || isCrossed(distance, from, middle, low, there, half, least) ||
         isCrossed(distance, middle, to, there, high, half, least);
}

// Distances at the corners and centres of a block's cells and of those below it, computed on demand.
class CellPlaces {
 public:
  CellPlaces(const SolidDistance& distance, const Coord& origin, double h)
      : m_distance(distance), m_origin(origin), m_h(h) {
    m_corner.fill(kUnknown);
    m_centre.fill(kUnknown);
  }
  static constexpr int kCells = kLeafDim + 1;  // -1 to 7
  static int index(const Coord& cell) {
    return ((cell[0] + 1) * kCells + cell[1] + 1) * kCells + cell[2] + 1;
  }
  Vec3d cornerPlace(const Coord& at) const { return (m_origin + at).asVec3d() * m_h; }
  Vec3d centrePlace(const Coord& cell) const { return ((m_origin + cell).asVec3d() + Vec3d(0.5)) * m_h; }
  // Each from -1 to 8.
  double corner(const Coord& at) {
    double& value = m_corner[((at[0] + 1) * kCorners + at[1] + 1) * kCorners + at[2] + 1];
    if (value == kUnknown) {
      value = m_distance(cornerPlace(at));
      if (std::abs(value) < kOnWall * m_h) value = 0.0;
    }
    return value;
  }
  // Where the edge from a corner outside the solids to a neighbour inside them meets the surface, as a share
  // of the edge. Distances at both ends tell it where they are to one surface. In a gap narrower than a cell
  // the corner outside may be nearer to the other side; then the edge is followed.
  double cut(const Coord& outside, const Coord& inside) {
    const double from = corner(outside), to = corner(inside), straight = crossing(from, to);
    if (from - to >= (1.0 - kOnWall) * m_h) return straight;
    const Vec3d start = cornerPlace(outside), way = cornerPlace(inside) - start;
    if (std::abs(m_distance(start + straight * way)) <= kSmooth * m_h) return straight;
    double gone = from / m_h;
    while (gone < 1.0) {
      const double left = m_distance(start + gone * way) / m_h;
      if (left < kOnWall) return gone;
      gone += left;
    }
    return 1.0;
  }
  // Each from -1 to 7.
  double centre(const Coord& cell) {
    double& value = m_centre[index(cell)];
    if (value == kUnknown) value = m_distance(centrePlace(cell));
    return value;
  }

 private:
  static constexpr int kCorners = kLeafDim + 2;
  static constexpr double kUnknown = std::numeric_limits<double>::max();
  const SolidDistance& m_distance;
  Coord m_origin;
  double m_h;
  std::array<double, kCorners * kCorners * kCorners> m_corner;
  std::array<double, kCells * kCells * kCells> m_centre;
};

// Corners of a cell: number n lies at the upper end of axis a where bit a is set.
constexpr int kCellCorners = 8;
constexpr unsigned kAllCorners = 0xff;

Coord cornerOf(const Coord& cell, int n) {
  return cell.offsetBy(n & 1, n >> 1 & 1, n >> 2);
}

// For a cell that a thin wall divides, the open corners on one side, a bit each: the side of its centre or,
// where that lies in the wall, the larger one. Corners are on one side where the edge between them is open.
// All corners where no wall divides them. A cell must not connect both sides of a wall.
unsigned cornersOfOneSide(CellPlaces& places, const SolidDistance& distance, const Coord& cell, double h) {
  const double diagonal = 0.5 * std::sqrt(3.0) * h, middle = places.centre(cell);
  if (std::abs(middle) >= diagonal) return kAllCorners;
  std::array<double, kCellCorners> d;
  std::array<Vec3d, kCellCorners> place;
  unsigned open = 0;
  for (int n = 0; n < kCellCorners; ++n) {
    d[n] = places.corner(cornerOf(cell, n));
    place[n] = places.cornerPlace(cornerOf(cell, n));
    if (d[n] > 0.0) open |= 1u << n;
  }
  const auto grown = [&](unsigned side) {
    for (unsigned before = 0; before != side;) {
      before = side;
      for (int n = 0; n < kCellCorners; ++n) {
        if ((side >> n & 1u) == 0) continue;
        for (int axis = 0; axis < 3; ++axis) {
          const int other = n ^ (1 << axis);
          if ((open >> other & 1u) == 0 || (side >> other & 1u) != 0) continue;
          if (!isCrossed(distance, place[n], place[other], d[n], d[other], h, kThinnestWall * h))
            side |= 1u << other;
        }
      }
    }
    return side;
  };
  unsigned best = 0;
  if (middle > 0.0) {
    const Vec3d x = places.centrePlace(cell);
    for (int n = 0; n < kCellCorners; ++n) {
      if ((open >> n & 1u) != 0 &&
          !isCrossed(distance, x, place[n], middle, d[n], diagonal, kThinnestWall * h))
        best |= 1u << n;
    }
    best = grown(best);
  } else {
    double most = 0.0;
    for (unsigned left = open; left != 0;) {
      const unsigned side = grown(left & (~left + 1u));
      double room = 0.0;
      for (int n = 0; n < kCellCorners; ++n)
        if ((side >> n & 1u) != 0) room += d[n];
      if (room > most) {
        most = room;
        best = side;
      }
      left &= ~side;
    }
  }
  return best == open ? kAllCorners : best;
}

}  // namespace

FaceShares openFaceShares(const SolidDistance& distance, const FloatTree& cellDistances,
                          const CoordBBox& domain, double h, const Coord& origin) {
  FaceShares faces;
  CellPlaces places(distance, origin, h);
  constexpr int kCells = CellPlaces::kCells;
  std::array<unsigned, kCells * kCells * kCells> side;
  side.fill(0);
  const auto sideOf = [&](const Coord& cell) {
    unsigned& known = side[CellPlaces::index(cell)];
    // 0 stands for not computed: a cell without an open corner gets all of them.
    if (known == 0) known = cornersOfOneSide(places, distance, cell, h);
    return known;
  };
  for (int c = 0; c < kLeafSize; ++c) {
    const Coord local(c >> 6, (c >> 3) & 7, c & 7);
    for (int axis = 0; axis < 3; ++axis) {
      // Only the faces of the domain's own cells are open, also where a side is no wall.
      Coord below = local;
      below[axis] -= 1;
      faces[axis][c] = 0.0f;
      if (!domain.isInside(origin + local) && !domain.isInside(origin + below)) continue;
      // The cell below may not be known.
      const double far = local[axis] > 0 ? std::min(cellDistances.getValue(origin + local),
                                                    cellDistances.getValue(origin + below))
                                         : cellDistances.getValue(origin + local) - h;
      if (far > kClear * h) {
        faces[axis][c] = 1.0f;
        continue;
      }
      const double low = places.centre(below), high = places.centre(local);
      if (std::max(low, high) < -kClear * h) continue;
      if (std::min(low, high) > kClear * h) {
        faces[axis][c] = 1.0f;
        continue;
      }
      // Around the face: the corners of the cell at the lower end of the axis.
      const int s = 1 << (axis + 1) % 3, t = 1 << (axis + 2) % 3, corners[4] = {0, s, s | t, t};
      std::array<double, 4> d;
      for (int n = 0; n < 4; ++n) d[n] = places.corner(cornerOf(local, corners[n]));
      const auto [least, most] = std::minmax({d[0], d[1], d[2], d[3]});
      // All corners on walls: in the plane of one wall the face is closed, between two it is open.
      const bool between = least == 0.0 && most == 0.0 && low > 0.0 && high > 0.0;
      if (most <= 0.0 && !between) continue;
      const unsigned lowSide = sideOf(below) >> (1 << axis), highSide = sideOf(local);
      std::array<bool, 4> otherSide{};
      for (int n = 0; n < 4; ++n) {
        otherSide[n] = (lowSide & highSide & 1u << corners[n]) == 0;
        if (otherSide[n]) d[n] = -std::abs(d[n]);
      }
      std::array<double, 4> cut = straightCuts(d);
      for (int n = 0; n < 4; ++n) {
        const int m = (n + 1) & 3;
        if ((d[n] > 0.0) == (d[m] > 0.0) || otherSide[n] || otherSide[m]) continue;
        const Coord one = cornerOf(local, corners[n]), other = cornerOf(local, corners[m]);
        cut[n] = d[n] > 0.0 ? places.cut(one, other) : 1.0 - places.cut(other, one);
      }
      faces[axis][c] = between ? 1.0f : static_cast<float>(openArea(d, cut));
    }
  }
  return faces;
}

double openAreaFraction(double d00, double d10, double d11, double d01) {
  const std::array<double, 4> d{d00, d10, d11, d01};
  return openArea(d, straightCuts(d));
}

}  // namespace fluidtex::sim
