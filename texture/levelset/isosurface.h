// The iso-surface of a level set: a closed manifold mesh that fixes the topology of every mesh made from the
// same level set.
#pragma once

#include "texture/levelset/level_set.h"

namespace fluidtex::texture {

struct IsoSurface {
  std::vector<Vec3f> positions;       // #V, index space, on grid edges (a few inside ambiguous cells)
  std::vector<Vec3I> triangles;       // #T, counter-clockwise seen from outside
  std::vector<openvdb::Coord> cells;  // #T, the cell that a triangle lies in
};

// The zero set of phi = 0 by cells: closed, oriented, manifold, without duplicate vertices, for every finite
// phi. It has the topology of marching tetrahedra (six tetrahedra a cell around the diagonal (0,0,0)-(1,1,1))
// with a third of the triangles: vertices on the diagonals of that division are left out. Zero counts as
// outside; vertices keep a little distance from the grid's nodes, so that no triangle degenerates.
IsoSurface isoSurface(const LevelSet& phi);

// How many squares of phi's scale, in voxels, have room on it: its area where the scale is 1 everywhere.
double squares(const LevelSet& phi, const IsoSurface& surface);

double areaOf(const std::vector<Vec3f>& positions, const Vec3I& triangle);
double area(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles);

}  // namespace fluidtex::texture
