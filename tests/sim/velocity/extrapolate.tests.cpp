#include "sim/velocity/extrapolate.h"

#include "tests/sim/velocity/liquid_faces.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;

TEST_CASE("extrapolate: a constant stays the same constant, everywhere") {
  LiquidFaces f(0.1, 16, [](const Vec3d& x) { return x.length() - 0.5; });
  f.setValid([](const Vec3d&, int a) { return 1.0 + a; });
  extrapolate(f.velocity, f.valid, *f.phi, *f.solidPhi);
  for (int a = 0; a < 3; ++a) {
    for (auto it = f.velocity.component[a]->cbeginValueOn(); it; ++it)
      REQUIRE(std::abs(*it - (1.0f + a)) < 1e-5f);
  }
}

TEST_CASE("extrapolate: constant along normals of a sphere, to first order") {
  // A function of the direction alone is its own extension.
  const auto exact = [](const Vec3d& x) { return x.x() / x.length(); };
  double error[2];
  for (int level = 0; level < 2; ++level) {
    const double h = 0.1 / (1 << level);
    LiquidFaces f(h, 16 << level, [](const Vec3d& x) { return x.length() - 0.6; });
    f.setValid([&](const Vec3d& x, int) { return exact(x); });
    extrapolate(f.velocity, f.valid, *f.phi, *f.solidPhi);
    double sum = 0.0, count = 0.0;
    const FloatGrid& u = *f.velocity.component[0];
    for (auto it = u.cbeginValueOn(); it; ++it) {
      const Vec3d x = u.indexToWorld(it.getCoord());
      if (x.length() < 0.6 || x.length() > 1.0) continue;
      sum += std::abs(*it - exact(x));
      count += 1.0;
    }
    error[level] = sum / count;
  }
  INFO("mean errors " << error[0] << " " << error[1]);
  CHECK(error[1] < 0.02);
  CHECK(error[1] < 0.65 * error[0]);
}

TEST_CASE("extrapolate: faces in solids take the value in front of the solid") {
  // Liquid everywhere above a floor at z = 0; the velocity depends on x alone.
  LiquidFaces f(0.1, 16, [](const Vec3d&) { return -1.0; });
  f.solidPhi = f.phi->deepCopy();
  for (auto it = f.solidPhi->beginValueOn(); it; ++it) {
    it.setValue(static_cast<float>(f.solidPhi->indexToWorld(it.getCoord()).z()));
  }
  const FloatGrid& u = *f.velocity.component[0];
  for (auto it = f.velocity.component[0]->beginValueOn(); it; ++it) {
    const Vec3d x = u.indexToWorld(it.getCoord());
    if (x.z() < 0.0) continue;
    it.setValue(static_cast<float>(x.x()));
    f.valid.component[0]->tree().setValueOn(it.getCoord());
  }
  extrapolate(f.velocity, f.valid, *f.phi, *f.solidPhi);
  for (auto it = u.cbeginValueOn(); it; ++it) {
    REQUIRE(std::abs(*it - u.indexToWorld(it.getCoord()).x()) < 1e-5);
  }
}

TEST_CASE("extrapolate: without a valid face all is zero") {
  LiquidFaces f(0.1, 8, [](const Vec3d& x) { return x.length() - 0.3; });
  for (auto it = f.velocity.component[1]->beginValueOn(); it; ++it) it.setValue(5.0f);
  extrapolate(f.velocity, f.valid, *f.phi, *f.solidPhi);
  CHECK(maxAbs(f.velocity) == 0.0);
}
