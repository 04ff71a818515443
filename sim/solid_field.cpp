// Open areas by marching squares on nodal distances: Ng, Min, Gibou, "An efficient fluid-solid coupling
// algorithm for single-phase flows", 2009, section 3; Min and Gibou, "Geometric integration over irregular
// domains", 2007.
#include "sim/solid_field.h"

#include "sim/mac_grid.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace fluidtex::sim {

namespace {

// Open shares below this count as closed: they would let next to nothing through and spoil the matrix.
constexpr double kClosed = 1e-3;

// Distances below this share of a cell are 0, so that a wall in the plane of a face closes it in spite of
// rounding.
constexpr double kOnWall = 1e-6;

// Walls of half a cell are seen: samples between cell centres are no farther apart than this share of one.
constexpr double kThinnestWall = 0.25;

// So many cells from a surface, a cell's centre has none at the cell's corners: its half diagonal, and what
// distances that are interpolated between places of a lattice may be off.
constexpr double kClear = 1.2;

// Area of the part of the unit square where the distance is positive; corners in order, no saddle.
double polygonArea(const std::array<double, 4>& d) {
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
      const double t = d[a] / (d[a] - d[b]);
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

// Corner triangle of a saddle: corner a alone has its sign.
double cornerArea(double corner, double next, double previous) {
  return 0.5 * corner / (corner - next) * corner / (corner - previous);
}

double snapped(double fraction) {
  if (fraction < kClosed) return 0.0;
  return fraction > 1.0 - kOnWall ? 1.0 : fraction;
}

// Open shares of the lower faces of a block's cells.
using Faces = std::array<std::array<float, kLeafSize>, 3>;

// Whether a solid crosses the way between two places outside it, so many metres apart, where the distance is
// low and high. Distances never change by more than one gets on; samples are no farther apart than `least`.
bool isCrossed(const SolidDistance& distance, const Vec3d& from, const Vec3d& to, double low, double high,
               double length, double least) {
  if (low + high > length || length <= least) return false;
  const Vec3d middle = 0.5 * (from + to);
  const double there = distance(middle), half = 0.5 * length;
  return there < 0.0 || isCrossed(distance, from, middle, low, there, half, least) ||
         isCrossed(distance, middle, to, there, high, half, least);
}

// Distances at the corners and centres of a block's cells and of those below it, found when they are asked
// for.
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

// Of a cell that a thin wall parts, the open corners on one side, a bit each: that of its centre, or where
// that lies in the wall, the roomier one. Corners are together where the edge between them is open. All
// corners where nothing parts them. A cell must not join both sides of a wall.
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

// From distances at the corners of the block's cells. A wall thinner than a cell may have no corner in it,
// and yet nothing passes: faces between cells that it parts are shut, and of a cell that it runs through,
// what is not on the cell's own side.
// phi: the distances of cells, to more than that maybe.
Faces openShares(const SolidDistance& distance, const FloatTree& phi, const CoordBBox& domain, double h,
                 const Coord& origin) {
  Faces faces;
  CellPlaces places(distance, origin, h);
  constexpr int kCells = CellPlaces::kCells;
  std::array<unsigned, kCells * kCells * kCells> side;
  side.fill(0);
  const auto sideOf = [&](const Coord& cell) {
    unsigned& known = side[CellPlaces::index(cell)];
    // A cell without an open corner has all of them on its side.
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
      // What lies below may not be known.
      const double far = local[axis] > 0
                             ? std::min(phi.getValue(origin + local), phi.getValue(origin + below))
                             : phi.getValue(origin + local) - h;
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
      // All corners on walls: in the plane of one the face is shut, between two it is open.
      const bool between = least == 0.0 && most == 0.0 && low > 0.0 && high > 0.0;
      if (most <= 0.0 && !between) continue;
      if (low > 0.0 && high > 0.0 &&
          isCrossed(distance, places.centrePlace(below), places.centrePlace(local), low, high, h,
                    kThinnestWall * h))
        continue;
      const unsigned lowSide = sideOf(below) >> (1 << axis), highSide = sideOf(local);
      for (int n = 0; n < 4; ++n)
        if ((lowSide & highSide & 1u << corners[n]) == 0) d[n] = -std::abs(d[n]);
      faces[axis][c] = between ? 1.0f : static_cast<float>(openAreaFraction(d[0], d[1], d[2], d[3]));
    }
  }
  return faces;
}

// Calls body(origin, size) for the parts of a chunk that touch the box: for the chunk as a whole where
// that says it is settled, and else for each of its blocks.
template <class Body>
void forPieces(const Coord& chunk, const CoordBBox& box, const Body& body) {
  const CoordBBox all = CoordBBox::createCube(chunk, kChunkDim);
  if (box.isInside(all) && body(chunk, kChunkDim)) return;
  for (int n = 0; n < 64; ++n) {
    const Coord origin = chunk + (Coord(n >> 4, (n >> 2) & 3, n & 3) << 3);
    if (box.hasOverlap(CoordBBox::createCube(origin, kLeafDim))) body(origin, kLeafDim);
  }
}

// At these shares of a cell along the axes.
Vec3d placeOf(const Coord& cell, const Vec3d& share, double h) {
  return (cell.asVec3d() + share) * h;
}

Vec3d middleOf(const Coord& origin, int size, double h) {
  return (origin.asVec3d() + Vec3d(0.5 * size)) * h;
}

// Which level of a tree has tiles of this many cells.
int levelOf(int size) {
  return size == kChunkDim ? 2 : 1;
}

// The distance at a cell's centre, where that is in a solid no less than half a cell if all corners and the
// centres beside are, too: solids that touch know only their own surfaces, and where they meet there is none.
double centreDistance(const SolidDistance& distance, const Coord& cell, double h) {
  const double d = distance(placeOf(cell, Vec3d(0.5), h));
  if (d > 0.0 || d <= -0.5 * h) return d;
  for (int n = 0; n < kCellCorners; ++n)
    if (distance(placeOf(cell, Vec3d(n & 1, n >> 1 & 1, n >> 2), h)) > kOnWall * h) return d;
  for (int side = 0; side < 6; ++side) {
    Vec3d beside(0.5);
    beside[side / 2] += side % 2 == 0 ? -1.0 : 1.0;
    if (distance(placeOf(cell, beside, h)) > 0.0) return d;
  }
  return -0.5 * h;
}

FloatGrid::Ptr cellDistances(const SolidDistance& distance, const CoordBBox& domain, const Chunks& chunks,
                             double h) {
  const float band = static_cast<float>(kSolidBand * h);
  FloatGrid::Ptr grid = makePhi(h, band);
  grid->setName("solidPhi");
  struct Piece {
    Coord origin;
    int size;
    std::unique_ptr<FloatLeaf> leaf;  // null: solid throughout
  };
  const CoordBBox box = grown(domain, kSolidMargin);
  std::vector<std::vector<Piece>> pieces(chunks.size());
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t n) {
    forPieces(chunks[n], box, [&](const Coord& origin, int size) {
      // Farther than this from its middle, none of its cells is in the band.
      const double radius = (0.5 * std::sqrt(3.0) * (size - 1) + kSolidBand) * h;
      const double middle = distance(middleOf(origin, size, h));
      if (std::abs(middle) > radius) {
        if (middle < 0.0) pieces[n].push_back({origin, size, nullptr});
        return true;
      }
      if (size > kLeafDim) return false;
      auto leaf = std::make_unique<FloatLeaf>(origin, band, false);
      for (int c = 0; c < kLeafSize; ++c) {
        const double d = centreDistance(distance, leaf->offsetToGlobalCoord(c), h);
        leaf->setValueOnly(c, std::clamp(static_cast<float>(d), -band, band));
        if (std::abs(d) < band) leaf->setActiveState(c, true);
      }
      pieces[n].push_back({origin, size, std::move(leaf)});
      return true;
    });
  });
  for (auto& ofChunk : pieces) {
    for (Piece& piece : ofChunk) {
      if (piece.leaf != nullptr) {
        grid->tree().addLeaf(piece.leaf.release());
      } else {
        grid->tree().addTile(levelOf(piece.size), piece.origin, -band, false);
      }
    }
  }
  return grid;
}

// The three grids of open shares.
std::array<FloatGrid::Ptr, 3> openFaces(const SolidDistance& distance, const CoordBBox& domain,
                                        const Chunks& chunks, const FloatTree& phi, double h) {
  struct Piece {
    Coord origin;
    int size;
    std::unique_ptr<Faces> faces;  // null: open throughout
  };
  const CoordBBox box(domain.min(), domain.max().offsetBy(1));  // the last cells' upper faces as well
  std::vector<std::vector<Piece>> pieces(chunks.size());
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t n) {
    forPieces(chunks[n], box, [&](const Coord& origin, int size) {
      const double radius = 0.5 * std::sqrt(3.0) * size * h;
      const double middle = distance(middleOf(origin, size, h));
      if (middle < -radius) return true;
      if (middle > radius && domain.isInside(CoordBBox::createCube(origin, size))) {
        pieces[n].push_back({origin, size, nullptr});
        return true;
      }
      if (size > kLeafDim) return false;
      pieces[n].push_back(
          {origin, size, std::make_unique<Faces>(openShares(distance, phi, domain, h, origin))});
      return true;
    });
  });
  std::array<FloatGrid::Ptr, 3> open;
  static constexpr const char* kNames[3] = {"openU", "openV", "openW"};
  for (int axis = 0; axis < 3; ++axis) {
    FloatGrid::Ptr grid = FloatGrid::create(0.0f);
    grid->setTransform(faceTransform(h, axis));
    grid->setName(kNames[axis]);
    for (const auto& ofChunk : pieces) {
      for (const Piece& piece : ofChunk) {
        if (piece.faces == nullptr) {
          grid->tree().addTile(levelOf(piece.size), piece.origin, 1.0f, true);
          continue;
        }
        FloatLeaf* leaf = grid->tree().touchLeaf(piece.origin);
        const auto& shares = (*piece.faces)[axis];
        for (int c = 0; c < kLeafSize; ++c) {
          if (shares[c] > 0.0f) leaf->setValueOn(c, shares[c]);
        }
      }
    }
    grid->tree().prune();
    open[axis] = grid;
  }
  return open;
}

// Gaps between solids that are narrower than a cell, so that no corner of the grid lies in them, are closed:
// nothing gets into a cell without an open face, or out of it. It is made part of the solids: liquid that was
// poured into it would be there for ever, and make surface beside it anew in each step.
void closeNarrowGaps(FloatGrid& phi, const std::array<FloatGrid::Ptr, 3>& open, const CoordBBox& domain,
                     double h) {
  const auto leaves = leavesOf(phi.tree());
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    FloatLeaf& leaf = *leaves[n];
    const float edge = 0.5f * static_cast<float>(h);
    std::array<std::optional<openvdb::tree::ValueAccessor<const FloatTree>>, 3> faces;
    for (int i = 0; i < kLeafSize; ++i) {
      const float value = leaf.getValue(i);
      const Coord cell = leaf.offsetToGlobalCoord(i);
      if (!(value > 0.0f) || value >= edge || !domain.isInside(cell)) continue;
      bool any = false;
      for (int axis = 0; axis < 3 && !any; ++axis) {
        if (!faces[axis]) faces[axis].emplace(open[axis]->constTree());
        Coord above = cell;
        above[axis] += 1;
        any = faces[axis]->getValue(cell) > 0.0f || faces[axis]->getValue(above) > 0.0f;
      }
      if (!any) leaf.setValueOnly(i, -edge);
    }
  });
}

}  // namespace

SolidField makeSolidField(const SolidDistance& distance, const SolidDistance& openDistance,
                          const SolidDistance& mirrored, const CoordBBox& domain, Chunks chunks, double h) {
  SolidField field;
  field.voxelSize = h;
  field.domain = domain;
  field.phi = cellDistances(distance, domain, chunks, h);
  field.phiMirrored = mirrored ? cellDistances(mirrored, domain, chunks, h) : field.phi;
  const std::array<FloatGrid::Ptr, 3> open = openFaces(openDistance, domain, chunks, field.phi->tree(), h);
  const auto& [u, v, w] = open;
  field.openU = u;
  field.openV = v;
  field.openW = w;
  closeNarrowGaps(*field.phi, open, domain, h);
  if (field.phiMirrored != field.phi) closeNarrowGaps(*field.phiMirrored, open, domain, h);
  field.visibility = visibilityOf(*field.phi, {u.get(), v.get(), w.get()});
  field.chunks = std::move(chunks);
  return field;
}

double openAreaFraction(double d00, double d10, double d11, double d01) {
  const std::array<double, 4> d{d00, d10, d11, d01};
  const int positive = (d00 > 0.0) + (d10 > 0.0) + (d11 > 0.0) + (d01 > 0.0);
  if (positive == 0) return 0.0;
  if (std::min({d00, d10, d11, d01}) >= 0.0) return 1.0;
  const bool saddle = positive == 2 && (d00 > 0.0) == (d11 > 0.0);
  if (!saddle) return snapped(polygonArea(d));
  // The middle decides whether the two equal corners are joined.
  const bool joined = d00 + d10 + d11 + d01 > 0.0;
  double corners = 0.0;
  for (int a = 0; a < 4; ++a) {
    if ((d[a] > 0.0) != joined) corners += cornerArea(d[a], d[(a + 1) & 3], d[(a + 3) & 3]);
  }
  return snapped(joined ? 1.0 - corners : corners);
}

}  // namespace fluidtex::sim
