// Reading a frame of a liquid that another program has simulated: Blender's (mantaflow), FLIP Fluids',
// meshes, grids and particles of others. Which files are what is known by caches/layouts.
#pragma once

#include "caches/liquid/cache.h"

namespace fluidtex::caches {

// The surface of the frame of this number as triangles in metres, without its level set and velocity; pieces
// below Options::leastPiece are left out. A file of no bytes is a frame without liquid. Throws LayoutError or
// FormatError.
SurfaceTriangles readSurface(const Cache& cache, int number);

// The mesh of a frame as its file has it, placed: all points in their order, polygons cut into triangles.
struct CachedMesh {
  SurfaceTriangles surface;
  std::map<std::string, std::vector<float>> attributes;  // #P each: Layout::fields by scalarNames()
};

// Requires SurfaceKind::mesh. Pieces below Options::leastPiece have no triangles. Throws as readSurface().
CachedMesh readMesh(const Cache& cache, int number);

// All of it. Velocities at points are known within a frame's motion of the surface (reachInCells()), others
// wherever the files have them.
LiquidFrame readFrame(const Cache& cache, int number);

// Side of the cells that suit a frame of this surface, metres: the voxels of grids, the spacing of particles,
// else the mean edge.
double suitingVoxel(const Cache& cache, int number, const SurfaceTriangles& surface);

// Half the mean distance of the particles of a frame that are neighbours, in the files' unit; 0 where there
// are too few. Requires SurfaceKind::particles. Throws as readSurface().
double particleRadius(const Cache& cache, int number);

}  // namespace fluidtex::caches
