// Which triangle of a surface is closest to each cell near it.
#pragma once

#include "caches/liquid/cell_triangles.h"
#include "caches/liquid/triangle_raster.h"
#include "sim/grid/leaf_table.h"
#include "sim/grid/voxel_mask.h"

#include <memory>
#include <vector>

namespace fluidtex::caches {

// Cells of side h in blocks of 8^3, those that are near the surface only. Up to two cells away the closest
// triangle is found exactly. From there on each cell, in the order of distance, takes the best of its
// neighbours' triangles, then of those around it on the surface: where several parts of the surface are about
// as near, one that is nearer may be missed. On a splash that is 0.01 cells too far or more in one cell of a
// hundred, and never 0.3. The same on any number of threads.
class ClosestTriangles {
 public:
  // All cells nearer than two cells. Keeps a reference to the surface.
  ClosestTriangles(const SurfaceTriangles& surface, double h);

  // All cells nearer than `reach`, cells; goes on from those that are known.
  void extend(double reach);

  double cellSize() const { return m_cellSize; }
  const SurfaceTriangles& surface() const { return m_asGiven; }

  // The blocks; cells of block n are voxels 512 n to 512 n + 511.
  const sim::LeafTable& blocks() const { return m_blocks; }
  // The cells that are nearer than `reach`, by block.
  const sim::VoxelMask& known() const { return m_known; }
  // What lies closest to a cell that is known.
  Nearest at(std::int64_t cell) const;
  TrianglePoint closestPointOf(std::int64_t cell) const;
  // Of the first blocks, all that the surface reaches into: which lines between cells it crosses.
  const std::vector<CrossedLines>& crossed() const { return m_crossed; }

 private:
  struct Found {
    std::int16_t offset;
    bool isNear;  // enough to be known now
    Nearest nearest;
  };

  openvdb::Vec3d placeOf(std::int64_t cell) const;
  // block: its place in units of blocks, from the surface's origin on.
  void addBlock(const openvdb::Coord& block);
  // The blocks beside those whose known cells touch their sides.
  void addNeighbors();
  // For the cells beside those of a block that are known. square: of the distance up to which they become
  // known; lastSquare: of that up to which they were known a round before.
  std::vector<Found> findAround(std::size_t block, float square, float lastSquare) const;

  double m_cellSize, m_reach, m_lastReach = 0.0;
  const SurfaceTriangles& m_asGiven;
  CellTriangles m_surface;
  sim::LeafTable m_blocks;
  openvdb::Int32Tree m_numbers{-1};  // of the blocks, at their places in units of blocks
  sim::VoxelMask m_known;
  std::vector<std::unique_ptr<BlockNearest>> m_nearest;
  std::vector<CrossedLines> m_crossed;
};

}  // namespace fluidtex::caches
