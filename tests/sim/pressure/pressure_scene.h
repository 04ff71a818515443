// A tank with liquid in it, for tests of one pressure projection.
#pragma once

#include "sim/grid/mac_grid.h"
#include "sim/pressure/pressure.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <vector>

namespace fluidtex::sim {

inline constexpr double kGravity = 9.81, kDensity = 1000.0, kDt = 0.01;
inline constexpr double kStep = kGravity * kDt;  // the velocity gravity gives in one step

// A tank of unit side with liquid where `level` is negative; velocities in and around it set by `velocity`.
struct Scene {
  Options options;
  double h;
  std::shared_ptr<const SolidField> solid;
  FloatGrid::Ptr phi;
  Velocity velocity;

  Scene(int n, std::vector<Shape> shapes, const std::function<double(const Vec3d&)>& level,
        Vec3d size = Vec3d(1.0)) {
    options.size = size;
    options.resolution = n;
    for (Shape& shape : shapes) {
      options.solids.emplace_back();
      options.solids.back().shape = std::move(shape);
    }
    h = options.voxelSize();
    solid = Solids(options).at(0.0);
    phi = makePhi(h, 3 * h);
    velocity = makeVelocity(h);
    const Coord cells = solid->domain.dim();
    for (int i = -2; i < cells[0] + 2; ++i) {
      for (int j = -2; j < cells[1] + 2; ++j) {
        for (int k = -2; k < cells[2] + 2; ++k) {
          const Coord c(i, j, k);
          phi->tree().setValueOn(c, static_cast<float>(level(phi->indexToWorld(c))));
        }
      }
    }
    setVelocity([](const Vec3d&) { return Vec3d(0.0, 0.0, -kStep); });
  }

  void setVelocity(const std::function<Vec3d(const Vec3d&)>& speed) {
    for (int a = 0; a < 3; ++a) {
      FloatGrid& grid = *velocity.component[a];
      for (auto it = phi->cbeginValueOn(); it; ++it) {
        const Coord c = it.getCoord();
        grid.tree().setValueOn(c, static_cast<float>(speed(grid.indexToWorld(c))[a]));
      }
    }
  }

  Projection projected(PressureOptions pressureOptions = {}) {
    pressureOptions.keepPressure = true;
    Projection result = project(velocity, *phi, *solid, kDt, kDensity, pressureOptions);
    CHECK(result.report.converged);
    return result;
  }

  float open(int axis, const Coord& c) const { return solid->open[axis].tree().getValue(c); }

  // Largest sum of open area times outward velocity over the liquid's cells, leaving out those in `except`.
  double largestDivergence(const MaskGrid& except) const {
    double largest = 0.0;
    for (auto it = phi->cbeginValueOn(); it; ++it) {
      const Coord c = it.getCoord();
      if (*it >= 0.0f || except.tree().isValueOn(c)) continue;
      double sum = 0.0;
      for (int a = 0; a < 3; ++a) {
        Coord up = c;
        ++up[a];
        sum += open(a, up) * velocity.component[a]->tree().getValue(up) -
               open(a, c) * velocity.component[a]->tree().getValue(c);
      }
      largest = std::max(largest, std::abs(sum));
    }
    return largest;
  }

  // Largest speed on the faces that the projection answers for.
  double largestSpeed(const FaceMasks& valid) const {
    double largest = 0.0;
    const auto& masks = valid.component;
    for (int a = 0; a < 3; ++a) {
      for (auto it = masks[a]->cbeginValueOn(); it; ++it) {
        largest = std::max(largest, std::abs(double(velocity.component[a]->tree().getValue(it.getCoord()))));
      }
    }
    return largest;
  }
};

}  // namespace fluidtex::sim
