#include "sim/step/liquid_fields.h"

#include "sim/grid/leaf_table.h"
#include "sim/solids/solid_layers.h"

#include <tbb/parallel_for.h>

namespace fluidtex::sim {
namespace {

// Layers of voxels outside the domain in which phi and velocity may have leaves.
constexpr int kMargin = kLeafDim;

}  // namespace

double voxelSize(const Liquid& liquid) {
  return liquid.phi->voxelSize()[0];
}

Velocity velocityFor(const FloatGrid& phi, const SolidField& solid) {
  const auto origins = wetLeaves(phi, grown(solid.domain, kMargin));
  FloatTree topology(0.0f);
  for (const Coord& origin : origins) topology.touchLeaf(origin);
  const auto leaves = leavesOf(topology);
  const float deepest = -kSolidLayers * static_cast<float>(phi.voxelSize()[0]);
  tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
    float phiScratch[kLeafSize], solidScratch[kLeafSize];
    const float* p = leafValues(phi.constTree(), leaves[n]->origin(), phiScratch);
    const float* s = leafValues(solid.phi->constTree(), leaves[n]->origin(), solidScratch);
    for (int i = 0; i < kLeafSize; ++i)
      leaves[n]->setActiveState(i, p[i] < phi.background() && s[i] > deepest);
  });
  return makeVelocity(phi.voxelSize()[0], topology);
}

void addGravity(Velocity& velocity, const Vec3d& change) {
  for (int a = 0; a < 3; ++a) {
    const float add = static_cast<float>(change[a]);
    const auto leaves = leavesOf(velocity.component[a]->tree());
    if (add == 0.0f) continue;
    tbb::parallel_for(std::size_t{0}, leaves.size(), [&](std::size_t n) {
      for (auto it = leaves[n]->beginValueOn(); it; ++it) it.setValue(*it + add);
    });
  }
}

void setInSources(FloatGrid& scalar, const RunningFlows& flows, double SourceGrids::*value) {
  for (const auto& [source, factor] : flows.sources) {
    for (FloatLeaf* leaf : leavesOf(scalar.tree())) {
      float scratch[kLeafSize];
      const float* phi = leafValues(source->phi->constTree(), leaf->origin(), scratch);
      for (int i = 0; i < kLeafSize; ++i) {
        if (phi[i] < 0.0f) leaf->setValueOnly(i, static_cast<float>(source->*value));
      }
    }
  }
}

}  // namespace fluidtex::sim
