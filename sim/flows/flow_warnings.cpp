// Shapes are evaluated and not sampled on the grid: only blocks of cells that a surface may cross are divided
// into eight.
#include "sim/flows/flows.h"
#include "sim/shapes/shape_distance.h"
#include "sim/solids/domain.h"

#include <cmath>
#include <functional>
#include <sstream>

namespace fluidtex::sim {
namespace {

enum class Found { nothing, inSolid, open };

// What is found at the centres of the domain's cells inside a shape at time t; the search ends at the first
// one outside solids.
Found look(const Shape& shape, const Options& options, const Solids& solids, double t) {
  const double h = options.voxelSize();
  const ShapeDistance distance(shape, h, domainBox(options));
  CoordBBox cells = cellsIn(distance.boundsIn(domainBox(options)), h);
  cells.intersect(domainCells(options));
  Found found = Found::nothing;
  if (cells.empty()) return found;
  const std::function<void(const Coord&, int)> visit = [&](const Coord& low, int size) {
    if (found == Found::open || !cells.hasOverlap(CoordBBox::createCube(low, size))) return;
    const int half = size / 2;
    const Coord cell = low.offsetBy(half);
    const Vec3d x = h * (cell.asVec3d() + Vec3d(0.5));
    const double d = distance(x);
    // Distance to the farthest cell centre of the block, and one cell more for the error of distances to
    // meshes.
    const double reach = h * (std::sqrt(3.0) * half + 1.0);
    if (d < 0.0 && cells.isInside(cell)) found = solids.distance(x, t) > 0.0 ? Found::open : Found::inSolid;
    if (size == 1 || found == Found::open || d > reach) return;
    if (d < -reach && solids.distance(x, t) < -reach) {
      found = Found::inSolid;
      return;
    }
    for (int n = 0; n < 8; ++n)
      visit(low.offsetBy((n & 1) * half, (n >> 1 & 1) * half, (n >> 2) * half), half);
  };
  int size = 1;
  while (size < cells.extents()[cells.maxExtent()] + 1) size *= 2;
  visit(cells.min(), size);
  return found;
}

}  // namespace

std::vector<std::string> flowWarnings(const Options& options, const Solids& solids) {
  std::vector<std::string> warnings;
  // inSolid, unseen: what happens to it in a solid, or where no cell centre is in it.
  const auto tell = [&](const std::string& name, const std::string& inSolid, const std::string& unseen,
                        const Shape& shape, double t) {
    const Found found = look(shape, options, solids, t);
    if (found == Found::open) return;
    std::ostringstream text;
    if (found == Found::inSolid)
      text << name << " lies wholly inside solids or walls: " << inSolid
           << "; put a part of it into the open";
    else
      text << name << " holds no cell's middle: " << unseen << "; make it larger than a cell, "
           << options.voxelSize() << " m, or give a higher domain.resolution";
    warnings.push_back(text.str());
  };
  if (options.liquid.empty() && options.sources.empty()) {
    warnings.emplace_back("the scene has no liquid: give it a [[liquid]] or a [[source]]");
  }
  for (std::size_t n = 0; n < options.liquid.size(); ++n) {
    const LiquidBody& body = options.liquid[n];
    tell("liquid " + std::to_string(n), "nothing is poured",
         "it has no surface, and counts as volume deficit until the flow gathers it", body.shape, body.from);
  }
  for (std::size_t n = 0; n < options.sources.size(); ++n) {
    const Source& source = options.sources[n];
    tell("source " + std::to_string(n), "nothing comes from it", "nothing comes from it", source.shape,
         source.from);
  }
  for (std::size_t n = 0; n < options.drains.size(); ++n) {
    const Drain& drain = options.drains[n];
    tell("drain " + std::to_string(n), "it takes nothing away", "it takes nothing away", drain.shape,
         drain.from);
  }
  return warnings;
}

}  // namespace fluidtex::sim
