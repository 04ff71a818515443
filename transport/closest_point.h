// Closest points on a triangle mesh, with a penalty on opposite sides.
#pragma once

#include "numerics/block_table.h"

#include <openvdb/Types.h>

#include <array>
#include <cstdint>
#include <vector>

namespace fluidtex::transport {

using openvdb::Vec3d;
using openvdb::Vec3f;
using openvdb::Vec3I;

// Penalty on opposite sides (see ClosestPoint::nearest) where values are transferred to another surface, in
// units of the length scale of that transfer.
inline constexpr double kOtherSide = 4.0;

struct SurfacePoint {
  std::uint32_t triangle = 0;
  Vec3f weight{0.0f};     // barycentric
  Vec3d position{0.0};    // metres
  double distance = 0.0;  // from the query, metres
};

// Triangles in cells of about two edge lengths, cells in blocks of 8^3. Surface meshes are even, so a cell
// holds a handful of triangles and most queries visit one to eight cells; far from the surface whole blocks
// are culled.
class ClosestPoint {
 public:
  // Keeps references to the arrays. Throws std::invalid_argument if there is no triangle, or one with a
  // vertex that does not exist.
  ClosestPoint(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles);

  // The point that minimises distance^2 + (penalty * disagreement)^2 over all triangles. disagreement: (1/2 -
  // c) / (3/2), clamped to 0..1, c being the cosine between the triangle's normal and `normal` (unit): 0 up
  // to 60 degrees, 1 for the opposite side. penalty: metres. Ties: smaller triangle index.
  SurfacePoint nearest(const Vec3d& x, const Vec3f& normal, double penalty) const;

 private:
  static constexpr int kSide = 8;  // cells along the side of a block
  struct Block {
    openvdb::Coord origin;                                         // first cell
    std::array<std::uint32_t, kSide * kSide * kSide + 1> first{};  // into m_entries, by cell
  };
  // Culling data of a triangle.
  struct Bounds {
    Vec3f center{0.0f};
    float radius = -1.0f;  // bounding sphere, metres; negative if degenerate
    Vec3f normal{0.0f};    // unit
  };
  struct Search;

  openvdb::Coord cellOf(const Vec3d& x) const;
  const Block* findBlock(const openvdb::Coord& origin) const;
  Block& makeBlock(const openvdb::Coord& origin);
  template <typename Visit>
  void forEachCell(std::uint32_t triangle, const Visit& visit) const;
  double squaredDistance(const Vec3d& x, const openvdb::Coord& lower, int cells) const;
  void visitTriangle(std::uint32_t triangle, Search& search) const;
  void visitCells(const openvdb::Coord& lower, const openvdb::Coord& upper, Search& search) const;
  void visitAll(Search& search) const;

  const std::vector<Vec3f>& m_positions;
  const std::vector<Vec3I>& m_triangles;
  double m_cellSize = 0.0, m_cellsPerMetre = 0.0;
  std::vector<Bounds> m_bounds;  // of the triangles
  std::vector<Block> m_blocks;
  BlockTable m_places;                   // of the blocks
  std::vector<std::uint32_t> m_entries;  // triangles by cell, ascending in each
};

}  // namespace fluidtex::transport
