// At corners of cells distances are OpenVDB's, without signs; the signs are those of winding numbers.
// OpenVDB's own signs, by a flood fill from outside, fill cavities and gaps narrower than two cells, and need
// all of the mesh. Between corners distances are those of the closest triangle: interpolated ones would miss
// walls and gaps that have no corner in them, and round off those that have few.
#include "sim/meshes/mesh_distance.h"

#include "sim/grid/mac_grid.h"
#include "sim/meshes/inside_test.h"
#include "sim/options.h"

#include <openvdb/tools/MeshToVolume.h>
#include <openvdb/tools/SignedFloodFill.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>
#include <sstream>

namespace fluidtex::sim {
namespace {

using openvdb::BBoxd;
using openvdb::Vec3f;
using openvdb::Vec3I;
using Leaf = openvdb::FloatTree::LeafNodeType;

// Cells with a distance that a level set may have: 2.5 GB.
constexpr double kMostCells = 268435456.0;

BBoxd boundsOf(const TriangleMesh& mesh) {
  BBoxd bounds;
  for (const Vec3f& x : mesh.positions) bounds.expand(Vec3d(x));
  return bounds;
}

BBoxd common(const BBoxd& a, const BBoxd& b) {
  return {openvdb::math::maxComponent(a.min(), b.min()), openvdb::math::minComponent(a.max(), b.max())};
}

// The part of a convex polygon within a box.
std::vector<Vec3d> clipped(std::vector<Vec3d> polygon, const BBoxd& box) {
  for (int a = 0; a < 3; ++a) {
    for (const double sign : {-1.0, 1.0}) {
      const double end = sign < 0.0 ? box.min()[a] : box.max()[a];
      if (!std::isfinite(end)) continue;
      std::vector<Vec3d> part;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Vec3d &x = polygon[i], &y = polygon[(i + 1) % polygon.size()];
        const double dx = sign * (x[a] - end), dy = sign * (y[a] - end);
        if (dx <= 0.0) part.push_back(x);
        if ((dx < 0.0 && dy > 0.0) || (dx > 0.0 && dy < 0.0)) part.push_back(x + (y - x) * (dx / (dx - dy)));
      }
      polygon = std::move(part);
    }
  }
  return polygon;
}

// Triangles within the box, clipped to it. Not closed.
TriangleMesh within(const TriangleMesh& mesh, const BBoxd& box) {
  TriangleMesh part;
  for (const Vec3I& t : mesh.triangles) {
    std::vector<Vec3d> polygon;
    polygon.reserve(3);
    for (int c = 0; c < 3; ++c) polygon.emplace_back(mesh.positions[t[c]]);
    bool beyond = false;
    for (int a = 0; a < 3; ++a) {
      const auto [low, high] = std::minmax({polygon[0][a], polygon[1][a], polygon[2][a]});
      beyond = beyond || high < box.min()[a] || low > box.max()[a];
    }
    if (beyond) continue;
    polygon = clipped(std::move(polygon), box);
    const auto first = static_cast<openvdb::Index32>(part.positions.size());
    for (const Vec3d& x : polygon) part.positions.emplace_back(x);
    for (openvdb::Index32 i = 2; i < polygon.size(); ++i)
      part.triangles.emplace_back(first, first + i - 1, first + i);
  }
  return part;
}

double areaOf(const TriangleMesh& mesh) {
  double twice = 0.0;
  for (const Vec3I& t : mesh.triangles) {
    const Vec3d a(mesh.positions[t[0]]);
    twice += (Vec3d(mesh.positions[t[1]]) - a).cross(Vec3d(mesh.positions[t[2]]) - a).length();
  }
  return 0.5 * twice;
}

std::string sizeText(const Vec3d& extents) {
  std::ostringstream text;
  text.precision(3);
  text << extents.x() << " x " << extents.y() << " x " << extents.z() << " m";
  return text.str();
}

// Winding numbers at nodes, with the crossings of the columns of a block of 8 x 8 x 8 kept.
class Columns {
 public:
  Columns(const InsideTest& inside, double h) : m_inside(inside), m_h(h) {}

  int winding(const openvdb::Coord& node) {
    const int n = (node[0] & 7) * 8 + (node[1] & 7);
    const openvdb::Coord column(node[0] >> 3, node[1] >> 3, 0);
    if (column != m_column) {
      m_column = column;
      for (auto& crossings : m_crossings) crossings.reset();
    }
    auto& crossings = m_crossings[std::size_t(n)];
    if (!crossings) m_inside.crossings(node[0] * m_h, node[1] * m_h, crossings.emplace());
    return InsideTest::winding(*crossings, node[2] * m_h);
  }

 private:
  const InsideTest& m_inside;
  double m_h;
  openvdb::Coord m_column = openvdb::Coord::max();
  std::array<std::optional<InsideTest::Crossings>, 64> m_crossings;
};

// Leaves, those above each other together.
std::vector<Leaf*> leavesByColumn(openvdb::FloatGrid& grid) {
  std::vector<Leaf*> leaves;
  grid.tree().getNodes(leaves);
  std::sort(leaves.begin(), leaves.end(),
            [](const Leaf* a, const Leaf* b) { return a->origin() < b->origin(); });
  return leaves;
}

template <class Body>
void forLeaves(const std::vector<Leaf*>& leaves, const InsideTest& inside, double h, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, leaves.size(), 64),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      Columns columns(inside, h);
                      for (std::size_t n = range.begin(); n < range.end(); ++n) body(*leaves[n], columns);
                    });
}

// Sets the signs of the distances.
void setSigns(openvdb::FloatGrid& grid, const InsideTest& inside, double h) {
  forLeaves(leavesByColumn(grid), inside, h, [&](Leaf& leaf, Columns& columns) {
    for (int n = 0; n < int(Leaf::SIZE); ++n) {
      const auto offset = static_cast<openvdb::Index>(n);
      if (columns.winding(leaf.offsetToGlobalCoord(offset)) > 0)
        leaf.setValueOnly(offset, -std::abs(leaf.getValue(offset)));
    }
  });
}

// Whether there is a surface where all is inside: of parts that cross each other, or lie side by side.
bool hasInnerSurface(const openvdb::FloatGrid& grid, double h) {
  std::atomic<bool> found{false};
  std::vector<const Leaf*> leaves;
  grid.tree().getNodes(leaves);
  const float near = static_cast<float>(-0.6 * h);  // a node beside any surface is no farther
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    const auto values = grid.getConstAccessor();
    for (auto it = leaves[n]->cbeginValueOn(); it && !found; ++it) {
      if (!std::signbit(*it) || *it < near) continue;
      bool within = true;
      for (int side = 0; side < 6 && within; ++side) {
        openvdb::Coord beside = it.getCoord();
        beside[side / 2] += side % 2 == 0 ? 1 : -1;
        within = std::signbit(values.getValue(beside));
      }
      if (within) found = true;
    }
  });
  return found;
}

// Pieces of triangles, no longer than two cells, that have no solid on both sides: where parts cross each
// other, what of one lies inside the other is not a surface.
class OuterPieces {
 public:
  OuterPieces(const InsideTest& inside, double h) : m_inside(inside), m_h(h) {}

  TriangleMesh of(const TriangleMesh& mesh) const {
    constexpr std::size_t kGrain = 256;
    std::vector<std::vector<Vec3d>> kept((mesh.triangles.size() + kGrain - 1) / kGrain);
    tbb::parallel_for(std::size_t{0}, kept.size(), [&](std::size_t g) {
      for (std::size_t n = g * kGrain; n < std::min((g + 1) * kGrain, mesh.triangles.size()); ++n) {
        const Vec3I& t = mesh.triangles[n];
        add(Vec3d(mesh.positions[t[0]]), Vec3d(mesh.positions[t[1]]), Vec3d(mesh.positions[t[2]]), kept[g]);
      }
    });
    TriangleMesh pieces;
    for (const auto& corners : kept) {
      for (const Vec3d& x : corners) pieces.positions.emplace_back(x);
    }
    for (openvdb::Index32 n = 0; n < pieces.positions.size(); n += 3)
      pieces.triangles.emplace_back(n, n + 1, n + 2);
    return pieces;
  }

 private:
  void add(const Vec3d& a, const Vec3d& b, const Vec3d& c, std::vector<Vec3d>& kept) const {
    const double ab = (b - a).length(), bc = (c - b).length(), ca = (a - c).length();
    if (std::max({ab, bc, ca}) > 2.0 * m_h) {
      // The longest side is halved.
      if (ab >= bc && ab >= ca) return addHalves(a, b, c, kept);
      return bc >= ca ? addHalves(b, c, a, kept) : addHalves(c, a, b, kept);
    }
    const Vec3d middle = (a + b + c) / 3.0;
    Vec3d normal = (b - a).cross(c - a);
    const double length = normal.length();
    normal *= length > 0.0 ? 1e-3 * m_h / length : 0.0;
    const auto isSurface = [&](const Vec3d& x) {
      return m_inside.winding(x + normal) <= 0 || m_inside.winding(x - normal) <= 0;
    };
    // Slightly inside the corners, which may lie on what crosses the triangle.
    if (isSurface(middle) || isSurface(0.9 * a + 0.1 * middle) || isSurface(0.9 * b + 0.1 * middle) ||
        isSurface(0.9 * c + 0.1 * middle))
      kept.insert(kept.end(), {a, b, c});
  }
  void addHalves(const Vec3d& a, const Vec3d& b, const Vec3d& c, std::vector<Vec3d>& kept) const {
    const Vec3d middle = 0.5 * (a + b);
    add(a, middle, c, kept);
    add(middle, b, c, kept);
  }

  const InsideTest& m_inside;
  double m_h;
};

// Gives blocks without a distance that lie inside that of the band's end.
void fillInside(openvdb::FloatGrid& grid, const InsideTest& inside, const BBoxd& box, double h) {
  const CoordBBox cells = cellsIn(box, h);
  const openvdb::Coord first = cells.min() >> 3, last = cells.max() >> 3;
  std::vector<std::vector<openvdb::Coord>> full(std::size_t(std::max(0, last[0] - first[0] + 1)));
  tbb::parallel_for(std::size_t{0}, full.size(), [&](std::size_t i) {
    const auto tree = grid.getConstAccessor();
    Columns columns(inside, h);
    for (int j = first[1]; j <= last[1]; ++j) {
      for (int k = first[2]; k <= last[2]; ++k) {
        const openvdb::Coord block = openvdb::Coord(first[0] + int(i), j, k) << 3;
        if (tree.probeConstLeaf(block) == nullptr && columns.winding(block.offsetBy(4)) > 0)
          full[i].push_back(block);
      }
    }
  });
  for (const auto& blocks : full)
    for (const openvdb::Coord& block : blocks) grid.tree().addTile(1, block, -grid.background(), false);
}

constexpr double kHalfDiagonal = 0.866026;  // of a cell

// The distances at the corners of the cell that a place (in cells) lies in.
class Corners {
 public:
  Corners(const openvdb::FloatTree& tree, const Vec3d& place) {
    const openvdb::Coord first = openvdb::Coord::floor(place);
    m_share = place - first.asVec3d();
    const Leaf* leaf = tree.probeConstLeaf(first);
    constexpr int kLast = int(Leaf::DIM) - 1;
    const bool within =
        (first[0] & kLast) < kLast && (first[1] & kLast) < kLast && (first[2] & kLast) < kLast;
    for (int n = 0; n < 8; ++n) {
      const openvdb::Coord corner = first.offsetBy(n >> 2, n >> 1 & 1, n & 1);
      m_value[n] = leaf != nullptr && within ? leaf->getValue(corner) : tree.getValue(corner);
    }
  }
  double interpolated() const {
    const auto along = [](double t, double a, double b) { return a + t * (b - a); };
    double face[4];
    for (int n = 0; n < 4; ++n) face[n] = along(m_share[2], m_value[2 * n], m_value[2 * n + 1]);
    return along(m_share[0], along(m_share[1], face[0], face[1]), along(m_share[1], face[2], face[3]));
  }
  // The surface is no farther away than this, in metres, but for the rounding of the corners' distances.
  double farthest(double h) const {
    double most = kForever;
    for (int n = 0; n < 8; ++n)
      most = std::min(most, std::abs(double(m_value[n])) + (way(n) + kRounding) * h);
    return most;
  }
  // The value of a corner that is nearer than the surface, so many cells away: there is none between.
  std::optional<float> joined(double distance) const {
    for (int n = 0; n < 8; ++n)
      if (way(n) < distance - kRounding) return m_value[n];
    return {};
  }

 private:
  static constexpr double kRounding = 1e-3;  // cells
  double way(int n) const { return (m_share - Vec3d(n >> 2, n >> 1 & 1, n & 1)).length(); }
  std::array<float, 8> m_value;
  Vec3d m_share;
};

}  // namespace

void checkCells(const TriangleMesh& mesh, const Vec3d& extents, double voxelSize, double band) {
  const double h = voxelSize;
  const Vec3d grown = extents / h + Vec3d(2.0 * (band + 2.0));
  const double cells =
      std::min(grown.x() * grown.y() * grown.z(), 2.0 * (band + 1.0) * areaOf(mesh) / (h * h));
  if (cells <= kMostCells) return;
  double scale = 1.0;
  while (cells * scale * scale > 0.01 * kMostCells) scale *= 0.1;
  std::ostringstream text;
  text.precision(2);
  text << "measures " << sizeText(extents) << ", which takes " << cells << " cells of " << h << " m, and "
       << kMostCells << " at most can be had; with a scale of " << scale
       << " times the present one it measures " << sizeText(scale * extents);
  throw std::runtime_error(text.str());
}

MeshDistance meshDistanceIn(const BBoxd& region, const TriangleMesh& mesh, double voxelSize, double band) {
  const double h = voxelSize, margin = (band + 2.0) * h;
  BBoxd reach(region.min() - Vec3d(margin), region.max() + Vec3d(margin)), whole = boundsOf(mesh);
  const auto transform = openvdb::math::Transform::createLinearTransform(h);
  if (mesh.triangles.empty() || !reach.hasOverlap(whole)) {
    auto nothing = openvdb::FloatGrid::create(static_cast<float>(band * h));
    nothing->setTransform(transform);
    return {nothing, nullptr, nullptr, {}};
  }
  const bool allThere = reach.isInside(whole);
  const TriangleMesh part = allThere ? TriangleMesh{} : within(mesh, reach);
  const TriangleMesh& there = allThere ? mesh : part;
  checkCells(there, common(reach, whole).extents(), h, band);
  const Vec3d extents = whole.extents();
  whole.expand(margin);
  const BBoxd box = common(reach, whole);
  constexpr double kMostBlocks = 16777216.0;
  if (!allThere && box.volume() > kMostBlocks * 512.0 * h * h * h)
    throw std::runtime_error(
        "measures " + sizeText(extents) +
        " and goes on beyond the domain where that has sides, but is too large where it has none");

  const auto distances = [&](const TriangleMesh& surface) {
    auto grid = openvdb::tools::meshToUnsignedDistanceField<openvdb::FloatGrid>(
        *transform, surface.positions, surface.triangles, {}, static_cast<float>(band));
    grid->setGridClass(openvdb::GRID_LEVEL_SET);
    return grid;
  };
  MeshDistance result;
  const auto all = std::make_shared<const TriangleTree>(mesh);
  const auto inside = std::make_shared<const InsideTest>(all);
  openvdb::FloatGrid::Ptr grid = distances(there);
  setSigns(*grid, *inside, h);
  if (hasInnerSurface(*grid, h)) {
    const auto outer = std::make_shared<const TriangleTree>(OuterPieces(*inside, h).of(there));
    grid = distances(outer->mesh());
    setSigns(*grid, *inside, h);
    result.surface = outer;
  } else {
    result.surface = allThere ? all : std::make_shared<const TriangleTree>(there);
  }
  // Beyond the leaves there is a surface on every way outward only where all of them are there.
  if (allThere) {
    openvdb::tools::signedFloodFill(grid->tree());
  } else {
    fillInside(*grid, *inside, box, h);
  }
  result.corners = grid;
  result.inside = inside;
  result.bounds = box;
  return result;
}

double MeshDistance::at(const Vec3d& x) const {
  const double h = corners->voxelSize()[0];
  const Vec3d place = x / h;
  const Corners around(corners->constTree(), place);
  const double between = around.interpolated();
  // Farther than this from the surface by interpolation, it is farther than the band from all corners.
  if (surface == nullptr || std::abs(between) > (kExactMeshBand + kHalfDiagonal) * h) return between;
  const TriangleTree::Closest closest = surface->closest(x, around.farthest(h));
  if (closest.triangle < 0) return between;
  const double distance = std::sqrt(closest.square);
  if (const auto corner = around.joined(distance / h)) return std::copysign(distance, *corner);
  Vec3d way = x;
  const openvdb::Vec3I& t = surface->mesh().triangles[closest.triangle];
  for (int k = 0; k < 3; ++k) way -= closest.weight[k] * Vec3d(surface->mesh().positions[t[k]]);
  return inside->winding(x, int(openvdb::math::MaxIndex(openvdb::math::Abs(way)))) > 0 ? -distance : distance;
}

}  // namespace fluidtex::sim
