#include "tools/frames/visible_solids.h"

#include "sim/grid/mac_grid.h"
#include "sim/shapes/shape_distance.h"
#include "sim/shapes/shape_triangles.h"
#include "sim/solids/domain.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::tools {
namespace {

// Where the solid is drawn: in [0, size], and on sides without an end all of it, if it has one.
openvdb::BBoxd drawnBox(const sim::Options& options, const openvdb::BBoxd& bounds, const sim::Pose& pose) {
  openvdb::BBoxd box(sim::Vec3d(0.0), options.size), whole = sim::boundsAt(bounds, pose);
  whole.expand(options.voxelSize());
  for (int a = 0; a < 3; ++a) {
    if (!std::isfinite(whole.min()[a]) || !std::isfinite(whole.max()[a])) return box;
  }
  for (int a = 0; a < 3; ++a) {
    if (options.sides[2 * a] == sim::Side::unbounded) box.min()[a] = std::min(0.0, whole.min()[a]);
    if (options.sides[2 * a + 1] == sim::Side::unbounded)
      box.max()[a] = std::max(options.size[a], whole.max()[a]);
  }
  return box;
}

}  // namespace

const std::vector<render::Solid>& VisibleSolids::at(double time) {
  std::vector<std::pair<std::size_t, sim::Pose>> visible;
  for (std::size_t i = 0; i < m_options.solids.size(); ++i) {
    const sim::Solid& solid = m_options.solids[i];
    if (solid.visible && solid.from <= time && time < solid.until)
      visible.emplace_back(i, sim::poseAt(solid, time));
  }
  if (visible == m_visible) return m_solids;
  if (m_bounds.empty()) {
    const openvdb::BBoxd domain = sim::domainBox(m_options);
    for (const sim::Solid& solid : m_options.solids)
      m_bounds.push_back(
          sim::ShapeDistance(solid.shape, m_options.voxelSize(), domain, sim::reachOf(solid, domain))
              .boundsIn(sim::kEverywhere));
  }
  m_solids.clear();
  for (const auto& [i, pose] : visible) {
    const sim::Solid& solid = m_options.solids[i];
    sim::TriangleMesh mesh =
        sim::triangulate(solid, time, drawnBox(m_options, m_bounds[i], pose), m_options.voxelSize());
    m_solids.push_back({std::move(mesh.positions), std::move(mesh.triangles), solid.color});
  }
  m_visible = std::move(visible);
  return m_solids;
}

}  // namespace fluidtex::tools
