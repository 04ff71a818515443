// The scene's solids as they are drawn at a moment.
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

  // At `time`, s; valid until the next call. Made anew only where a solid has come, gone or moved.
  const std::vector<render::Solid>& at(double time);

 private:
  const sim::Options& m_options;
  std::vector<std::pair<std::size_t, sim::Pose>> m_visible;  // numbers and places of the solids in m_solids
  std::vector<render::Solid> m_solids;
  std::vector<openvdb::BBoxd> m_bounds;  // of all solids, before they are moved; made when first asked for
};

}  // namespace fluidtex::tools
