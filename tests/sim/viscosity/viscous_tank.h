// A tank with liquid and a velocity, for tests of the viscous solve.
#pragma once

#include "sim/viscosity/viscosity.h"
#include "tests/sim/velocity/velocity_field.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace fluidtex::sim {

inline constexpr double kDensity = 1000.0;
using Field = std::function<Vec3d(const Vec3d&)>;
using Distance = std::function<double(const Vec3d&)>;

// A box of cells with liquid where `level` is negative and the velocity `speed` everywhere.
struct Tank {
  Options options;
  double h = 0.0;
  SolidField solid;
  FloatGrid::Ptr phi;
  Velocity velocity;

  Tank(const Options& scene, const Distance& level, const Field& speed)
      : options(scene), h(scene.voxelSize()), solid(*Solids(scene).at(0.0)), phi(makePhi(h, 6.0 * h)) {
    const Coord cells = solid.domain.dim();
    const Coord blocks((cells[0] + 15) / 8, (cells[1] + 15) / 8, (cells[2] + 15) / 8);
    for (int i = -1; i < blocks[0]; ++i) {
      for (int j = -1; j < blocks[1]; ++j) {
        for (int k = -1; k < blocks[2]; ++k) phi->tree().touchLeaf(Coord(8 * i, 8 * j, 8 * k))->setValuesOn();
      }
    }
    for (auto it = phi->beginValueOn(); it; ++it) {
      const double d = level(phi->indexToWorld(it.getCoord()));
      it.setValue(static_cast<float>(std::clamp(d, -6.0 * h, 6.0 * h)));
    }
    velocity = velocityField(h, phi->tree(), speed);
  }

  // Applies viscosity such that viscosity dt / (density h^2) is `number`.
  ViscosityReport apply(double number, const ViscosityOptions& settings = {}) {
    const double dt = 0.01;
    return applyViscosity(velocity, *phi, solid, dt, kDensity, {.constant = number * kDensity * h * h / dt},
                          settings);
  }

  // Gives the surfaces of solids this velocity.
  void setWallVelocity(const Field& speed) { solid.slide = velocityField(h, phi->tree(), speed); }

  // Gives the solids themselves this velocity.
  void setSolidVelocity(const Field& speed) { solid.speed = velocityField(h, phi->tree(), speed); }

  // Largest difference from `exact` over the liquid's open faces with keep(x).
  double error(const Field& exact, const std::function<bool(const Vec3d&)>& keep) const {
    double largest = 0.0;
    for (int a = 0; a < 3; ++a) {
      for (auto it = velocity.component[a]->cbeginValueOn(); it; ++it) {
        Coord below = it.getCoord();
        below[a] -= 1;
        const Vec3d x = velocity.component[a]->indexToWorld(it.getCoord());
        const bool wet = phi->tree().getValue(it.getCoord()) < 0.0f || phi->tree().getValue(below) < 0.0f;
        const double gap = solid.phi->tree().getValue(it.getCoord()) + solid.phi->tree().getValue(below);
        if (wet && gap > 1e-3 * h && keep(x)) largest = std::max(largest, std::abs(*it - exact(x)[a]));
      }
    }
    return largest;
  }
};

inline Options tankOf(int n, Vec3d size = Vec3d(1.0)) {
  Options options;
  options.size = size;
  options.resolution = n;
  return options;
}

inline Vec3d mixed(const Vec3d& x) {
  return Vec3d(std::sin(9 * x[1]) + 0.3 * std::cos(31 * x[2]), std::cos(7 * x[2]) * std::sin(17 * x[0]),
               std::sin(11 * x[0]) - x[1]);
}

inline double dropDistance(const Vec3d& x) {
  return (x - Vec3d(0.52, 0.47, 0.5)).length() - 0.31;
}

}  // namespace fluidtex::sim
