// A pool of liquid with a temperature.
#pragma once

#include "sim/heat/heat.h"
#include "sim/scalars/carried_scalar.h"
#include "sim/solids/solids.h"

#include <algorithm>
#include <functional>

namespace fluidtex::sim {

// A tank with liquid up to `level` and a temperature.
struct Pool {
  Options options;
  double h = 0.0;
  SolidField solid;
  FloatGrid::Ptr phi, temperature;

  Pool(int n, double level, const std::function<double(const Vec3d&)>& field) {
    options.resolution = n;
    h = options.voxelSize();
    solid = *Solids(options).at(0.0);
    phi = makePhi(h, 6.0 * h);
    for (int i = -8; i < n + 8; i += 8) {
      for (int j = -8; j < n + 8; j += 8) {
        for (int k = -8; k < n + 8; k += 8) phi->tree().touchLeaf(Coord(i, j, k))->setValuesOn();
      }
    }
    for (auto it = phi->beginValueOn(); it; ++it) {
      const double d = phi->indexToWorld(it.getCoord())[2] - level;
      it.setValue(static_cast<float>(std::clamp(d, -6.0 * h, 6.0 * h)));
    }
    temperature = makeScalar(*makeScalar(h, 300.0), phi->tree());
    for (auto it = temperature->beginValueOn(); it; ++it)
      it.setValue(static_cast<float>(field(temperature->indexToWorld(it.getCoord()))));
  }

  double at(int i, int j, int k) const { return temperature->tree().getValue(Coord(i, j, k)); }
};

}  // namespace fluidtex::sim
