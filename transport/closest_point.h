// Closest points on a triangle mesh, with regard to which side they lie on.
#pragma once

#include <openvdb/Types.h>

#include <array>
#include <cstdint>
#include <vector>

namespace fluidtex::transport {

using openvdb::Vec3d;
using openvdb::Vec3f;
using openvdb::Vec3I;

struct SurfacePoint {
  std::uint32_t triangle = 0;
  Vec3f weight{0.0f};     // of the triangle's corners, barycentric
  Vec3d position{0.0};    // metres
  double distance = 0.0;  // from the position asked for, metres
};

// Triangles sorted into cubes of about two edge lengths, the cubes into blocks of 8^3. Surface meshes are
// even, so that a cube holds a handful of triangles and most queries look into one to eight cubes; far away
// from the surface whole blocks are ruled out at once.
class ClosestPoint {
 public:
  // The arrays are referred to, not copied; at least one triangle, all of whose vertices exist. Else throws
  // std::invalid_argument.
  ClosestPoint(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles);

  // The point with the least distance^2 + (penalty * disagreement)^2 over all triangles. Disagreement is 0 up
  // to 60 degrees between the triangle's normal and `normal` (unit), and rises with the cosine to 1 for the
  // opposite side; `penalty` is in metres. Ties go to the triangle with the smaller index.
  SurfacePoint nearest(const Vec3d& x, const Vec3f& normal, double penalty) const;

 private:
  static constexpr int kSide = 8;  // cells along the side of a block
  struct Block {
    openvdb::Coord origin;                                         // first cell
    std::array<std::uint32_t, kSide * kSide * kSide + 1> first{};  // into m_entries, by cell
  };
  // What rules a triangle out before its corners are looked up.
  struct Bounds {
    Vec3f center{0.0f};
    float radius = -1.0f;  // of a ball around its corners, metres; below 0 where it has no area
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
  std::vector<std::uint32_t> m_table;    // open addressing by block origin: index + 1, 0 where free
  std::vector<std::uint32_t> m_entries;  // triangles by cell, rising within each
};

}  // namespace fluidtex::transport
