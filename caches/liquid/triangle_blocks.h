// The triangles of a surface by the blocks of cells that they come near.
#pragma once

#include "caches/liquid/cell_triangles.h"

#include <cstdint>
#include <span>
#include <vector>

namespace fluidtex::caches {

struct TriangleBlocks {
  std::vector<openvdb::Coord> blocks;  // in units of blocks, from the surface's origin on
  // Those of block n: triangles[first[n]] to triangles[first[n + 1] - 1], ascending.
  std::vector<std::uint32_t> first, triangles;

  std::span<const std::uint32_t> of(std::size_t block) const {
    return std::span(triangles).subspan(first[block], first[block + 1] - first[block]);
  }
};

// Blocks that have cells within `reach` cells of a triangle, each with those triangles and some that are
// farther away. The order of the blocks is that of the triangles.
TriangleBlocks trianglesByBlock(const CellTriangles& surface, double reach);

}  // namespace fluidtex::caches
