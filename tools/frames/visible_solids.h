// The scene's solids as drawn at a given time.
#pragma once

#include "render/render.h"
#include "sim/options.h"
#include "sim/shapes/pose.h"

#include <utility>
#include <vector>

namespace fluidtex::tools {

class VisibleSolids {
 public:
  explicit VisibleSolids(const sim::Options& options) : m_options(options) {}

  // At `time`, s; valid until the next call. Remade only if a solid has appeared, vanished or moved.
  const std::vector<render::Solid>& at(double time);

 private:
  const sim::Options& m_options;
  std::vector<std::pair<std::size_t, sim::Pose>> m_visible;  // indices and poses of the solids in m_solids
  std::vector<render::Solid> m_solids;
  std::vector<openvdb::BBoxd> m_bounds;  // of all solids, before their motion; computed on first use
};

}  // namespace fluidtex::tools
