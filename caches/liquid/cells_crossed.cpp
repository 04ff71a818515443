#include "caches/liquid/cells_crossed.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::caches {

using openvdb::Vec3d;

CellsCrossed cellsCrossed(const SurfaceTriangles& surface, double h) {
  CellsCrossed result;
  for (const openvdb::Vec3I& t : surface.triangles) {
    const Vec3d a(surface.points[t[0]]), b(surface.points[t[1]]), c(surface.points[t[2]]);
    const double longest = std::max({(b - a).length(), (c - b).length(), (a - c).length()});
    result.cells += std::max(0.5 * (b - a).cross(c - a).length() / (h * h), longest / h);
    for (const Vec3d& x : {a, b, c})
      result.farthest = std::max({result.farthest, std::abs(x[0]), std::abs(x[1]), std::abs(x[2])});
  }
  return result;
}

}  // namespace fluidtex::caches
