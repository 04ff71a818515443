// Symmetry, alignment and places kept clear of singularities.
#include "texture/orientation/orient.h"

#include "tests/texture/levelset/level_sets.h"
#include "tests/texture/orientation/orientation_fields.h"
#include "texture/mesh/carried_mesh.h"
#include "texture/mesh/prepare.h"
#include "texture/orientation/directions.h"
#include "texture/orientation/tangent.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numbers>
#include <numeric>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

// Of the directions equal by symmetry, how far the nearest is from `to`, radians.
double offBy(const Vec3f& d, const Vec3f& n, const Vec3f& to, int symmetry) {
  const Vec3f nearest = nearestTurn(d, n, to, symmetry);
  return angleBetween(nearest, to);
}

double meanOffBy(const SurfaceMesh& mesh, const std::vector<Vec3f>& to, int symmetry) {
  double sum = 0.0, weights = 0.0;
  for (std::size_t v = 0; v < to.size(); ++v) {
    const double length = to[v].length();
    if (length < 0.05) continue;
    sum += length * offBy(mesh.orientation[v], mesh.normals[v], to[v], symmetry);
    weights += length;
  }
  return sum / weights;
}

// Edges whose ends do not agree as arrows, though the field is smooth there.
double seams(const SurfaceMesh& mesh) {
  const VertexGraph graph = buildVertexGraph(mesh);
  const Connection connection = buildConnection(mesh, graph, mesh.orientation);
  const auto breaks = std::count_if(connection.rotation.begin(), connection.rotation.end(),
                                    [](const Complexf& r) { return r.real() < 0.5f; });
  return double(breaks) / double(connection.rotation.size());
}

}  // namespace

TEST_CASE("orientation: with a symmetry, turns sum to it times the Euler characteristic", "[texture]") {
  for (const int symmetry : {1, 2, 4}) {
    Surface sphere = sphereLevels();
    orient(sphere, {}, {.symmetry = symmetry});
    Surface torus = levelsOf({torusMesh(48, 24), torusMesh(24, 12)});
    orient(torus, {}, {.symmetry = symmetry});
    for (const SurfaceMesh& mesh : sphere.levels) {
      const std::vector<Singularity> found = singularities(mesh, symmetry);
      CHECK(sumOfTurns(found) == 2 * symmetry);
      // The smoothest field has the smallest turns, as far from each other as they can be.
      CHECK(found.size() == 2u * unsigned(symmetry));
    }
    for (const SurfaceMesh& mesh : torus.levels) CHECK(sumOfTurns(singularities(mesh, symmetry)) == 0);
  }
}

TEST_CASE(
    "orientation: on every component of a splash, the smallest too, turns sum to N times its characteristic",
    "[texture]") {
  const double voxel = 0.1;
  Surface surface = prepareSurface(*splashGrid(120, voxel, 1), voxel, Seeds{}, 3, SurfaceOptions{});
  for (const int symmetry : {1, 2, 4}) {
    orient(surface, {}, {.symmetry = symmetry});
    for (const SurfaceMesh& mesh : surface.levels) {
      const std::vector<std::uint32_t> component = components(mesh.positions.size(), mesh.triangles);
      std::map<std::uint32_t, long> expected, found;
      for (const Components::Part& part : componentsOf(mesh.positions, mesh.triangles).parts)
        expected[part.first] = symmetry * part.characteristic;
      for (const auto& [first, turns] : expected) found[first] = 0;
      // The centre of a triangle tells whose it is.
      std::map<std::array<float, 3>, std::uint32_t> owner;
      for (const Vec3I& t : mesh.triangles) {
        const Vec3f centre = (mesh.positions[t[0]] + mesh.positions[t[1]] + mesh.positions[t[2]]) / 3.0f;
        owner[{centre.x(), centre.y(), centre.z()}] = component[t[0]];
      }
      for (const Singularity& s : singularities(mesh, symmetry))
        found[owner.at({s.position.x(), s.position.y(), s.position.z()})] += s.turns;
      CHECK(found == expected);
    }
  }
}

TEST_CASE("orientation: equal directions are chosen so that arrows seldom jump", "[texture]") {
  Surface torus = levelsOf({torusMesh(96, 12, 1.0, 0.1), torusMesh(48, 6, 1.0, 0.1)});
  orient(torus, {}, {.symmetry = 4});
  CHECK(singularities(torus.levels[0], 4).empty());
  CHECK(seams(torus.levels[0]) == 0.0);
  // On a sphere there have to be seams between the eight turns, lines and no areas.
  Surface sphere = sphereLevels();
  orient(sphere, {}, {.symmetry = 4});
  CHECK(seams(sphere.levels[0]) < 0.08);
}

TEST_CASE("orientation: carried on with a symmetry, no vertex takes another of its equal directions",
          "[texture]") {
  for (const int symmetry : {2, 4}) {
    Surface surface = sphereLevels();
    orient(surface, {}, {.symmetry = symmetry});
    surface.levels.resize(1);
    const std::vector<Vec3f> start = surface.levels[0].orientation;
    for (int frame = 0; frame < 5; ++frame)
      orient(surface, carriedFrom(surface.levels[0]), {.symmetry = symmetry});
    for (std::size_t v = 0; v < start.size(); ++v)
      REQUIRE(surface.levels[0].orientation[v].dot(start[v]) > std::cos(0.9 * std::numbers::pi / symmetry));
    CHECK(sumOfTurns(singularities(surface.levels[0], symmetry)) == 2 * symmetry);
  }
}

TEST_CASE("orientation: follows a direction, more closely with more weight", "[texture]") {
  const Vec3f down(0.0f, 0.0f, -1.0f);
  for (const int symmetry : {1, 2, 4}) {
    double last = 1e9;
    for (const float weight : {0.001f, 0.02f, 0.3f, 1.0f}) {
      Surface surface = levelsOf({torusMesh(48, 24), torusMesh(24, 12)});
      const auto wished = [&](const SurfaceMesh& mesh) {
        std::vector<Vec3f> result = alongDirection(mesh, down);
        for (Vec3f& x : result) x *= weight;
        return result;
      };
      orient(surface, {}, {.symmetry = symmetry}, {.direction = wished, .stiffness = {}});
      const double off = meanOffBy(surface.levels[0], alongDirection(surface.levels[0], down), symmetry);
      CHECK(off <= last);
      last = off;
    }
    CHECK(last < 2.0 * kDegree);
  }
}

TEST_CASE("orientation: turns towards a direction over some frames", "[texture]") {
  Surface surface = levelsOf({torusMesh(48, 24)});
  orient(surface, {});
  const auto along = [](const SurfaceMesh& mesh) { return alongDirection(mesh, Vec3f(0.0f, 0.0f, -1.0f)); };
  const auto wished = [&](const SurfaceMesh& mesh) {
    std::vector<Vec3f> result = along(mesh);
    for (Vec3f& x : result) x *= 0.2f;
    return result;
  };
  double last = meanOffBy(surface.levels[0], along(surface.levels[0]), 1);
  const double start = last;
  for (int frame = 0; frame < 20; ++frame) {
    orient(surface, carriedFrom(surface.levels[0]), {}, {.direction = wished, .stiffness = {}});
    const double off = meanOffBy(surface.levels[0], along(surface.levels[0]), 1);
    CHECK(off < last + 1e-3);
    last = off;
  }
  CHECK(last < 0.3 * start);
}

TEST_CASE("orientation: singularities keep out of marked places, at once and when carried into them",
          "[texture]") {
  // A field around an axis has one singularity at each pole; both caps are marked.
  const Vec3f axis = Vec3f(0.3f, -0.5f, 0.8f).unit();
  const auto inside = [&](const Vec3f& x) { return std::abs(x.unit().dot(axis)) > 0.8f; };
  const auto stiff = [&](const SurfaceMesh& mesh) {
    std::vector<float> result;
    for (const Vec3f& x : mesh.positions) result.push_back(inside(x) ? 100.0f : 1.0f);
    return result;
  };
  const auto marked = [&](const SurfaceMesh& mesh, int symmetry) {
    const std::vector<Singularity> found = singularities(mesh, symmetry);
    CHECK(sumOfTurns(found) == 2 * symmetry);
    return std::count_if(found.begin(), found.end(),
                         [&](const Singularity& s) { return inside(s.position); });
  };
  for (const int symmetry : {1, 2, 4}) {
    Surface surface = sphereLevels();
    orient(surface, {}, {.symmetry = symmetry}, {.direction = {}, .stiffness = stiff});
    CHECK(marked(surface.levels[0], symmetry) == 0);
  }
  Surface carried = levelsOf({sphereMesh(24)});
  SurfaceMesh& mesh = carried.levels[0];
  const Vec3f tilted = (axis + Vec3f(0.15f, 0.1f, 0.0f)).unit();
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    Vec3f d = tilted.cross(mesh.positions[v]);
    mesh.orientation.push_back(d.unit());
  }
  REQUIRE(marked(mesh, 1) == 2);
  for (int frame = 0; frame < 20; ++frame)
    orient(carried, carriedFrom(mesh), {}, {.direction = {}, .stiffness = stiff});
  CHECK(marked(mesh, 1) == 0);
}

TEST_CASE("orientation: wishes that are not one a vertex are refused", "[texture]") {
  Surface surface = levelsOf({sphereMesh(6)});
  const auto few = [](const SurfaceMesh&) { return std::vector<Vec3f>(3); };
  const auto none = [](const SurfaceMesh&) { return std::vector<float>(); };
  CHECK_THROWS_AS(orient(surface, {}, {}, {.direction = few, .stiffness = {}}), std::invalid_argument);
  CHECK_THROWS_AS(orient(surface, {}, {}, {.direction = {}, .stiffness = none}), std::invalid_argument);
}
