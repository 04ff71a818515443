// The level set of a frame's surface.
#pragma once

#include "caches/liquid/closest_triangles.h"
#include "caches/liquid/surface_mesh.h"

#include <functional>
#include <vector>

namespace fluidtex::caches {

// Half width of the narrow band, cells: what the stages after it need.
inline constexpr int kBand = 5;

// Distance in metres to the triangles, negative inside, at the centres of cells of side h
// (sim/grid/mac_grid.h); narrow band. Inside is what cannot be reached from far away, however the triangles
// are turned. A surface that encloses nothing becomes a sheet one and a half cells thick; isSheet tells.
struct LevelSet {
  openvdb::FloatGrid::Ptr phi;
  bool isSheet = false;
};
LevelSet levelSetOf(const SurfaceTriangles& surface, double h);
// The same from closest triangles, which are extended as far as is needed.
LevelSet levelSetOf(ClosestTriangles& closest);

// Values at the surface's points, continued off it: each cell within `band` cells of the surface has those of
// the closest point, linear within its triangle. values: #P x components. One grid a component, active where
// known, at the cells' centres: not where a value is no number.
std::vector<openvdb::FloatGrid::Ptr> continuedOff(ClosestTriangles& closest, const std::vector<float>& values,
                                                  int components, int band);

// The same of any function of the closest point: writes `components` values for the closest point of a
// triangle with these corners. Called from several threads.
using ValuesAt =
    std::function<void(const openvdb::Vec3I& corners, const TrianglePoint& closest, double* values)>;
std::vector<openvdb::FloatGrid::Ptr> continuedOff(ClosestTriangles& closest, const ValuesAt& valuesAt,
                                                  int components, int band);

}  // namespace fluidtex::caches
