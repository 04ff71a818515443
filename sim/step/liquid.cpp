#include "sim/step/liquid.h"

#include "sim/velocity/acceleration.h"

namespace fluidtex::sim {

Velocity movingVelocity(const Liquid& liquid) {
  return liquid.expansion ? plus(liquid.velocity, liquid.expansion, 1.0) : liquid.velocity;
}

bool isEmpty(const Liquid& liquid) {
  return liquid.phi->empty();
}

void setTransforms(Liquid& liquid, double h) {
  forEachGrid(liquid, [&](const char*, const FloatGrid::Ptr& grid, int axis) {
    if (grid != nullptr) grid->setTransform(axis == kAtCentres ? cellTransform(h) : faceTransform(h, axis));
  });
}

}  // namespace fluidtex::sim
