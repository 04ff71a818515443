// Iso-surface of a level set: a closed manifold mesh that fixes the topology of every mesh of the same frame.
#pragma once

#include "texture/levelset/level_set.h"

namespace fluidtex::texture {

struct IsoSurface {
  std::vector<Vec3f> positions;       // #V, index space, on grid edges (a few inside ambiguous cells)
  std::vector<Vec3I> triangles;       // #T, counter-clockwise seen from outside
  std::vector<openvdb::Coord> cells;  // #T, cell of each triangle
};

// Zero set of phi: closed, oriented, manifold, without duplicate vertices, for every finite phi. Topology of
// marching tetrahedra (six per cell around the diagonal (0,0,0)-(1,1,1)) with a third of the triangles:
// vertices on the diagonals are left out. Zero counts as outside. Vertices keep a small distance from grid
// nodes, so that no triangle degenerates.
IsoSurface isoSurface(const LevelSet& phi);

// Number of squares of phi's scale, in voxels, that fit: the area where the scale is 1.
double squares(const LevelSet& phi, const IsoSurface& surface);

double areaOf(const std::vector<Vec3f>& positions, const Vec3I& triangle);
double area(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles);

}  // namespace fluidtex::texture
