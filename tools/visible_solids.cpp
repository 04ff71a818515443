#include "tools/visible_solids.h"

#include "sim/shapes.h"

namespace fluidtex::tools {

const std::vector<render::Solid>& VisibleSolids::at(double time) {
  std::vector<std::pair<std::size_t, sim::Pose>> visible;
  for (std::size_t i = 0; i < m_options.solids.size(); ++i) {
    const sim::Solid& solid = m_options.solids[i];
    if (solid.visible && solid.from <= time && time < solid.until)
      visible.emplace_back(i, sim::poseAt(solid, time));
  }
  if (visible == m_visible) return m_solids;
  m_solids.clear();
  for (const auto& [i, pose] : visible) {
    const sim::Solid& solid = m_options.solids[i];
    sim::TriangleMesh mesh = sim::triangulate(solid, time, m_options.size, m_options.voxelSize());
    m_solids.push_back({std::move(mesh.positions), std::move(mesh.triangles), solid.color});
  }
  m_visible = std::move(visible);
  return m_solids;
}

}  // namespace fluidtex::tools
