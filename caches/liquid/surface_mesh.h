// The surface of a frame as triangles, in which all kinds of caches meet before the level set is made.
#pragma once

#include <openvdb/openvdb.h>

#include <vector>

namespace fluidtex::caches {

struct SurfaceTriangles {
  std::vector<openvdb::Vec3f> points;     // #P, metres once placed
  std::vector<openvdb::Vec3I> triangles;  // #T
};

// The surface value(x) = iso of a grid, at the places that its transform gives.
SurfaceTriangles surfaceOfGrid(const openvdb::FloatGrid& grid, double iso);

// points = worldFromFile.transform(points)
void place(const openvdb::Mat4d& worldFromFile, std::vector<openvdb::Vec3f>& points);

// Leaves out the pieces, connected by common points, that enclose less than this volume (m3). Their points
// stay.
void dropPieces(double leastVolume, SurfaceTriangles& surface);

// Mean length of the triangles' edges; 0 without triangles.
double meanEdge(const SurfaceTriangles& surface);

// Of all triangles; the square of the points' unit.
double areaOf(const SurfaceTriangles& surface);

openvdb::BBoxd boundsOf(const SurfaceTriangles& surface);

}  // namespace fluidtex::caches
