// Textured surfaces to be carried, and what every carried state must be.
#pragma once

#include "tests/texture/mesh/closed_meshes.h"
#include "tests/transport/velocity_grids.h"
#include "transport/carry.h"
#include "transport/trust.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

namespace fluidtex::testing {

using texture::Carried;
using texture::SurfaceMesh;
using texture::TexturedSurface;
using texture::Vec2f;
using texture::Vec3f;
using texture::Vec4f;

inline constexpr double kDegree = std::numbers::pi / 180.0;
inline constexpr double kTexelsPerMeter = 50.0;

inline double angleBetween(const Vec3d& a, const Vec3d& b) {
  return std::atan2(a.cross(b).length(), a.dot(b));
}

inline Vec3f projected(const Vec3f& x, const Vec3f& n) {
  return x - n * n.dot(x);
}

// The state that the next frame starts from, with nothing synthesised in between.
inline TexturedSurface continued(const Carried& carried, const SurfaceMesh& mesh) {
  TexturedSurface result;
  static_cast<SurfaceMesh&>(result) = mesh;
  static_cast<texture::VertexTexture&>(result) = carried;
  result.orientation = carried.orientation;
  return result;
}

// Exemplar coordinates that are one linear function of position all over; colour and age likewise.
inline TexturedSurface texturedMesh(const SurfaceMesh& mesh, const Flow& direction) {
  Carried texture;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3f &x = mesh.positions[v], &n = mesh.normals[v];
    Vec3f d = projected(Vec3f(direction(Vec3d(x))), n);
    d.normalize();
    texture.orientation.push_back(d);
    texture.color.emplace_back(0.5f + 0.1f * x.x(), 0.5f + 0.1f * x.y(), 0.5f + 0.1f * x.z(), 1.0f);
    texture.coordinate.emplace_back(float(kTexelsPerMeter * x.x()), float(kTexelsPerMeter * x.y()));
    texture.gradient.push_back({projected(Vec3f(float(kTexelsPerMeter), 0, 0), n),
                                projected(Vec3f(0, float(kTexelsPerMeter), 0), n)});
    // What fades lies elsewhere in the exemplar, turned by a quarter.
    texture.fading.coordinate.emplace_back(float(50 + kTexelsPerMeter * x.y()),
                                           float(-kTexelsPerMeter * x.x()));
    texture.fading.gradient.push_back({projected(Vec3f(0, float(kTexelsPerMeter), 0), n),
                                       projected(Vec3f(-float(kTexelsPerMeter), 0, 0), n)});
    texture.fading.weight.push_back(0.25f);
    texture.fading.speed.push_back(2.5f);
    texture.age.push_back(2.0f + x.z());
    texture.trust.push_back(1.0f);
  }
  texture.previousPosition = mesh.positions;
  return continued(texture, mesh);
}

// The textures here are stretched without end where the surface is upright to a plane of their coordinates;
// what else speaks against a vertex is left when that is taken out. 1 where the stretch leaves nothing.
inline float trustBesidesStretch(const Carried& carried, const TexturedSurface& previous, std::size_t v) {
  return carried.trust[v] / transport::stretchTrust(carried.gradient[v], previous.spacing);
}

inline Flow constantDirection(const Vec3d& d) {
  return [d](const Vec3d&) { return d; };
}

// The mesh after a linear map F: normals turn with F^-T.
inline SurfaceMesh mappedMesh(SurfaceMesh mesh, const Mat3d& f) {
  for (Vec3f& x : mesh.positions) x = Vec3f(f * Vec3d(x));
  const Mat3d normalMap = f.inverse().transpose();
  for (Vec3f& n : mesh.normals) {
    n = Vec3f(normalMap * Vec3d(n));
    n.normalize();
  }
  return mesh;
}

inline void requireWhole(const Carried& carried, const SurfaceMesh& mesh) {
  const std::size_t count = mesh.positions.size();
  REQUIRE(carried.orientation.size() == count);
  REQUIRE(carried.color.size() == count);
  REQUIRE(carried.coordinate.size() == count);
  REQUIRE(carried.gradient.size() == count);
  REQUIRE(carried.fading.coordinate.size() == count);
  REQUIRE(carried.fading.gradient.size() == count);
  REQUIRE(carried.fading.weight.size() == count);
  REQUIRE(carried.fading.speed.size() == count);
  REQUIRE(carried.age.size() == count);
  REQUIRE(carried.trust.size() == count);
  REQUIRE(carried.previousPosition.size() == count);
  for (std::size_t v = 0; v < count; ++v) {
    REQUIRE(carried.orientation[v].length() == Approx(1.0).epsilon(1e-5));
    REQUIRE(std::abs(carried.orientation[v].dot(mesh.normals[v])) < 1e-5f);
    REQUIRE(std::abs(carried.gradient[v].s.dot(mesh.normals[v])) < 1e-4f * kTexelsPerMeter);
    REQUIRE(std::abs(carried.gradient[v].t.dot(mesh.normals[v])) < 1e-4f * kTexelsPerMeter);
    REQUIRE((carried.trust[v] >= 0.0f && carried.trust[v] <= 1.0f));
    REQUIRE(std::isfinite(carried.color[v].lengthSqr()));
    REQUIRE(std::isfinite(carried.coordinate[v].lengthSqr()));
    REQUIRE(std::isfinite(carried.age[v]));
  }
}

}  // namespace fluidtex::testing
