// A level set of a shape in a box without solids, and what its surface encloses.
#pragma once

#include "sim/surface/advect_phi.h"
#include "sim/surface/level_set.h"
#include "tests/sim/velocity/velocity_field.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace fluidtex::sim {

using Distance = std::function<double(const Vec3d&)>;

// phi of a shape in a box of cells from 0, band 6 cells, no solids.
struct Surface {
  double h;
  Coord cells;
  FloatGrid::Ptr phi;
  FloatGrid::Ptr noSolid;

  Surface(double voxel, const Coord& box, const Distance& distance)
      : h(voxel), cells(box), phi(makePhi(voxel, 6 * voxel)), noSolid(makePhi(voxel, 3 * voxel)) {
    unite(*phi, distance, firstCells(cells));
    trimBand(*phi, *noSolid);
  }

  // All faces of the box's leaves, set from a field.
  Velocity velocity(const std::function<Vec3d(const Vec3d&)>& field) const {
    FloatTree topology(0.0f);
    for (int i = -8; i < cells.x() + 8; i += 8) {
      for (int j = -8; j < cells.y() + 8; j += 8) {
        for (int k = -8; k < cells.z() + 8; k += 8) topology.touchLeaf(Coord(i, j, k))->setValuesOn();
      }
    }
    return velocityField(h, topology, field);
  }

  // Visits every cell of the box with phi at 4^3 points inside, phi trilinear.
  template <class Visit>
  void subSample(const Visit& visit) const {
    const auto acc = phi->getConstUnsafeAccessor();
    constexpr int kParts = 4;
    for (int i = 0; i < cells.x() - 1; ++i) {
      for (int j = 0; j < cells.y() - 1; ++j) {
        for (int k = 0; k < cells.z() - 1; ++k) {
          float c[2][2][2];
          bool cut = false;
          for (int n = 0; n < 8; ++n) {
            c[n >> 2][(n >> 1) & 1][n & 1] =
                acc.getValue(Coord(i + (n >> 2), j + ((n >> 1) & 1), k + (n & 1)));
          }
          for (int n = 1; n < 8; ++n) cut = cut || (c[n >> 2][(n >> 1) & 1][n & 1] < 0) != (c[0][0][0] < 0);
          for (int s = 0; s < kParts * kParts * kParts; ++s) {
            const Vec3d t((s / 16 + 0.5) / kParts, (s / 4 % 4 + 0.5) / kParts, (s % 4 + 0.5) / kParts);
            double p = c[0][0][0];
            if (cut) {
              const auto mix = [](double a, double b, double w) { return a + w * (b - a); };
              p = mix(mix(mix(c[0][0][0], c[0][0][1], t.z()), mix(c[0][1][0], c[0][1][1], t.z()), t.y()),
                      mix(mix(c[1][0][0], c[1][0][1], t.z()), mix(c[1][1][0], c[1][1][1], t.z()), t.y()),
                      t.x());
            }
            visit(phi->indexToWorld(Vec3d(i, j, k) + t), p, h * h * h / (kParts * kParts * kParts));
          }
        }
      }
    }
  }

  double volume() const {
    double sum = 0.0;
    subSample([&](const Vec3d&, double p, double dv) { sum += p < 0.0 ? dv : 0.0; });
    return sum;
  }

  // Volume of the symmetric difference with an exact shape.
  double difference(const Distance& exact) const {
    double sum = 0.0;
    subSample([&](const Vec3d& x, double p, double dv) { sum += (p < 0.0) != (exact(x) < 0.0) ? dv : 0.0; });
    return sum;
  }

  void advance(const Velocity& velocity, double dt) {
    advectPhi(*phi, velocity, *noSolid, dt);
    trimBand(*phi, *noSolid);
  }

  // Largest | |grad phi| - 1 | and phi's error over cells nearer to the surface than `width` cells.
  double distanceError(double width, const Distance& exact) const {
    double worst = 0.0;
    for (auto it = phi->cbeginValueOn(); it; ++it) {
      if (std::abs(*it) > width * h) continue;
      worst = std::max(worst, std::abs(*it - exact(phi->indexToWorld(it.getCoord()))));
    }
    return worst;
  }
};

inline Distance ball(const Vec3d& center, double radius) {
  return [=](const Vec3d& x) { return (x - center).length() - radius; };
}

}  // namespace fluidtex::sim
