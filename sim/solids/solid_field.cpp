#include "sim/solids/solid_field.h"

#include "sim/grid/mac_grid.h"
#include "sim/grid/normal.h"
#include "sim/solids/open_faces.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace fluidtex::sim {

namespace {

// Calls body(origin, size) for the parts of a chunk that touch the box: for the whole chunk where that
// settles it, else for each of its blocks.
template <class Body>
void forPieces(const Coord& chunk, const CoordBBox& box, const Body& body) {
  const CoordBBox all = CoordBBox::createCube(chunk, kChunkDim);
  if (box.isInside(all) && body(chunk, kChunkDim)) return;
  for (int n = 0; n < 64; ++n) {
    const Coord origin = chunk + (Coord(n >> 4, (n >> 2) & 3, n & 3) << 3);
    if (box.hasOverlap(CoordBBox::createCube(origin, kLeafDim))) body(origin, kLeafDim);
  }
}

// The place at these fractions of a cell along the axes.
Vec3d placeOf(const Coord& cell, const Vec3d& share, double h) {
  return (cell.asVec3d() + share) * h;
}

Vec3d middleOf(const Coord& origin, int size, double h) {
  return (origin.asVec3d() + Vec3d(0.5 * size)) * h;
}

// The tree level whose tiles have this many cells a side.
int levelOf(int size) {
  return size == kChunkDim ? 2 : 1;
}

// The distance at a cell's centre. Inside solids that touch, the nearest surface may be a joint between two
// of them. A place outside has a ball of its own distance around it that holds no solid: the distance to the
// nearest of these balls is the depth. Where none is near and all around is solid, it is half a cell.
double centreDistance(const SolidDistance& distance, const Coord& cell, double h) {
  // Share of a cell by which the balls may miss the surface's nearest point.
  constexpr double kAside = 0.15;
  // Between two solids a closed gap may be left: balls below this radius, in cells, do not count.
  constexpr double kSmallest = 0.1;
  // Width of differences, in cells: little beside a wall's thickness.
  constexpr double kWidth = 0.02;
  const Vec3d centre = placeOf(cell, Vec3d(0.5), h);
  const double d = distance(centre);
  if (d > 0.0 || d <= -0.5 * h) return d;
  double depth = kForever;
  bool allSolid = true;
  const auto look = [&](const Vec3d& way, double closed) {
    const double there = distance(centre + way * h);
    allSolid = allSolid && there <= closed;
    if (there > kSmallest * h) depth = std::min(depth, std::max(0.0, way.length() * h - there));
    return there;
  };
  const auto isTrue = [&] { return depth <= -d + kAside * h; };
  // Straight out of the solid. In a corner or gap the next surface may be near: from there on away from it, a
  // step for each surface that can meet there.
  constexpr double kBeyond = kSmallest + kWidth;
  Vec3d ahead = normalAt(distance, centre, kWidth * h), way = (kBeyond - d / h) * ahead;
  double beyond = look(way, kSmallest * h);
  for (int n = 0; n < 3 && !isTrue() && beyond > 0.0; ++n) {
    way += (kBeyond - beyond / h) * normalAt(distance, centre + way * h, kWidth * h);
    beyond = look(way, kSmallest * h);
  }
  if (isTrue()) return d;
  // Where the solid has no slope at the centre, in the direction in which it ends first.
  for (int a = 0; a < 3; ++a) {
    Vec3d unit(0.0);
    unit[a] = 1.0;
    ahead[a] = look(unit, 0.0) - look(-unit, 0.0);
  }
  if (ahead.normalize()) look((0.25 - d / h) * ahead, kOnWall * h);
  for (const double far : {0.5, 0.375, 0.25, 0.125}) {
    for (int n = 0; n < 27 && !isTrue(); ++n)
      if (n != 13) look(far * Coord(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1).asVec3d(), kOnWall * h);
  }
  if (isTrue()) return d;
  return depth < kForever || allSolid ? -std::min(depth, 0.5 * h) : d;
}

FloatGrid::Ptr cellDistances(const SolidDistance& distance, const CoordBBox& domain, const Chunks& chunks,
                             double h) {
  const float band = static_cast<float>(kSolidBand * h);
  FloatGrid::Ptr grid = makePhi(h, band);
  grid->setName("solidPhi");
  struct Piece {
    Coord origin;
    int size;
    std::unique_ptr<FloatLeaf> leaf;  // null: all solid
  };
  const CoordBBox box = grown(domain, kSolidMargin);
  std::vector<std::vector<Piece>> pieces(chunks.size());
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t n) {
    forPieces(chunks[n], box, [&](const Coord& origin, int size) {
      // If the surface is farther than this from the centre, no cell is in the narrow band.
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

// The three grids of open area fractions.
FaceGrids openFaces(const SolidDistance& distance, const CoordBBox& domain, const Chunks& chunks,
                    const FloatTree& phi, double h) {
  struct Piece {
    Coord origin;
    int size;
    std::unique_ptr<FaceShares> faces;  // null: all open
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
          {origin, size, std::make_unique<FaceShares>(openFaceShares(distance, phi, domain, h, origin))});
      return true;
    });
  });
  FaceGrids open;
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
    open.component[axis] = grid;
  }
  return open;
}

// Closes gaps between solids that are narrower than a cell, in which no grid corner lies: nothing passes into
// a cell without an open face, or out of it. The gap becomes part of the solids. Otherwise liquid poured into
// it would stay for ever, and make surface beside it in each step.
void closeNarrowGaps(FloatGrid& phi, const FaceGrids& open, const CoordBBox& domain, double h) {
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
        if (!faces[axis]) faces[axis].emplace(open[axis].constTree());
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
  field.open = openFaces(openDistance, domain, chunks, field.phi->tree(), h);
  closeNarrowGaps(*field.phi, field.open, domain, h);
  if (field.phiMirrored != field.phi) closeNarrowGaps(*field.phiMirrored, field.open, domain, h);
  field.visibility = visibilityOf(*field.phi, field.open);
  field.chunks = std::move(chunks);
  return field;
}

}  // namespace fluidtex::sim
