// What surface preparation promises while the spacing is at most one voxel, on smooth, sharp, thin and small
// surfaces.
#include "mesh_quality.h"
#include "tests/texture/levelset/level_sets.h"
#include "tests/threads.h"
#include "texture/mesh/patches.h"
#include "texture/mesh/prepare.h"
#include "tools/benchmarks/deformed_shapes.h"

#include <catch2/catch.hpp>

#include <map>

using namespace fluidtex::texture;

namespace {

constexpr double kVoxel = 0.1;

// A wavy surface over a flat bed, cut by the walls of a box.
FloatGrid::Ptr riverGrid() {
  return levelSetOf(kVoxel, Vec3d(1.5, 1.3, 0.9), [](const Vec3d& p) {
    const double top = p.z() - 0.2 - 0.12 * std::sin(4.0 * p.x()) * std::cos(3.0 * p.y());
    return std::max({top, -p.z() - 0.4, std::abs(p.x()) - 1.03, std::abs(p.y()) - 0.87});
  });
}

constexpr double kLigamentRadius = 1.5 * kVoxel, kLigamentLength = 2.0;

FloatGrid::Ptr ligamentGrid() {
  return levelSetOf(kVoxel, Vec3d(1.6, 0.5, 0.5), [](const Vec3d& p) {
    const Vec3d axis(std::clamp(p.x(), -0.5 * kLigamentLength, 0.5 * kLigamentLength), 0.01, 0.02);
    return (p - axis).length() - kLigamentRadius;
  });
}

double dropletRadius(int i) {
  return kVoxel * (1.2 + 0.4 * i);
}

FloatGrid::Ptr dropletsGrid() {
  return levelSetOf(kVoxel, Vec3d(1.6, 0.8, 0.8), [](const Vec3d& p) {
    double nearest = 10.0;
    for (int i = 0; i < 4; ++i)
      nearest = std::min(nearest, (p - Vec3d(0.7 * i - 1.03, 0.02 * i, 0.0)).length() - dropletRadius(i));
    return nearest;
  });
}

double ballVolume(double radius) {
  return 4.0 / 3.0 * M_PI * radius * radius * radius;
}

struct Shape {
  FloatGrid::Ptr grid;
  double volume = 0.0;  // m3; 0: not known
};

std::map<std::string, Shape> shapes() {
  double droplets = 0.0;
  for (int i = 0; i < 4; ++i) droplets += ballVolume(dropletRadius(i));
  const double ligament =
      ballVolume(kLigamentRadius) + M_PI * kLigamentRadius * kLigamentRadius * kLigamentLength;
  std::map<std::string, Shape> result{
      {"sphere", {sphereGrid(1.0, kVoxel), ballVolume(1.0)}},
      {"torus", {torusGrid(1.0, 0.4, kVoxel), 2.0 * M_PI * M_PI * 0.16}},
      {"tank", {boxGrid(Vec3d(1.013, 0.76, 0.532), kVoxel), 8.0 * 1.013 * 0.76 * 0.532}},
      {"river cut by the domain", {riverGrid(), 0.0}},
      {"sheet two voxels thin", {boxGrid(Vec3d(1.0, 1.0, kVoxel), kVoxel), 8.0 * kVoxel}},
      {"ligament", {ligamentGrid(), ligament}},
      {"droplets", {dropletsGrid(), droplets}}};
  for (const double gap : {-0.04, 0.04})
    result["drops with a gap of " + std::to_string(gap)] = {twoSpheresGrid(gap, kVoxel),
                                                            2.0 * ballVolume(1.0)};
  return result;
}

Surface prepare(const FloatGrid& grid, double spacing, const Seeds& seeds = {}) {
  return prepareSurface(grid, spacing, seeds, 1, SurfaceOptions{});
}

Seeds resting(const SurfaceMesh& mesh) {
  return {mesh.positions, mesh.positions, mesh.triangles, {}};
}

void requireGuarantees(const SurfaceMesh& mesh, const FloatGrid& grid) {
  requireSound(mesh, grid);
  const Quality q = measure(mesh, grid);
  checkPromises(q);
  CHECK(q.slim <= 0.001);
}

}  // namespace

TEST_CASE("guarantees: near the level set, nothing folded or slim, topology and volume kept") {
  for (const auto& [name, shape] : shapes()) {
    for (const double ratio : {1.0, 0.6}) {
      INFO(name << ", spacing " << ratio << " voxels");
      const SurfaceMesh random = prepare(*shape.grid, ratio * kVoxel).levels[0];
      // Without their mesh the points are connected again.
      const SurfaceMesh again =
          prepare(*shape.grid, ratio * kVoxel, {random.positions, {}, {}, {}}).levels[0];
      for (const SurfaceMesh& mesh : {random, again}) {
        requireGuarantees(mesh, *shape.grid);
        // Flat triangles with corners on a ball of radius 2 voxels and edges of one lose a tenth of it.
        if (shape.volume > 0.0)
          CHECK(enclosed(mesh.positions, mesh.triangles) ==
                Approx(shape.volume).epsilon(ratio == 1.0 ? 0.15 : 0.07));
      }
    }
  }
}

TEST_CASE("guarantees: a liquid at rest keeps its points and its mesh exactly") {
  auto all = shapes();
  all["splash"] = {splashGrid(120, kVoxel, 1), 0.0};
  all["one voxel"] = {oneVoxelGrid(kVoxel), 0.0};
  for (const auto& [name, shape] : all) {
    INFO(name);
    const FloatGrid::Ptr& grid = shape.grid;
    const SurfaceMesh first = prepare(*grid, kVoxel).levels[0];
    const SurfaceMesh second = prepare(*grid, kVoxel, resting(first)).levels[0];
    const SurfaceMesh third = prepare(*grid, kVoxel, resting(second)).levels[0];
    CHECK(second.positions == first.positions);
    CHECK(second.triangles == first.triangles);
    CHECK(third.positions == first.positions);
    CHECK(third.normals == second.normals);
  }
}

TEST_CASE("guarantees: a surface that drifts, turns and is sheared keeps them from frame to frame") {
  // A ball that is stretched along one axis and shrinks along another, while it drifts.
  const auto shapeAt = [](double t) {
    const Vec3d axes(1.0 + t, 1.0 / (1.0 + t), 1.0);
    return levelSetOf(kVoxel, Vec3d(2.2, 1.6, 1.6), [=](const Vec3d& p) {
      const Vec3d q((p.x() - t) / axes.x(), p.y() / axes.y(), p.z() / axes.z());
      const Vec3d slope(q.x() / axes.x(), q.y() / axes.y(), q.z() / axes.z());
      if (q.length() < 0.3) return -0.5;  // deep inside
      return q.length() * (q.length() - 1.0) / slope.length();
    });
  };
  SurfaceMesh mesh = prepare(*shapeAt(0.0), kVoxel).levels[0];
  for (double t = 0.1; t < 0.55; t += 0.1) {
    INFO("t " << t);
    const double before = t - 0.1;
    Seeds seeds = resting(mesh);
    for (Vec3f& p : seeds.positions)
      p = Vec3f(float((p.x() - before) * (1.0 + t) / (1.0 + before) + t),
                float(p.y() * (1.0 + before) / (1.0 + t)), p.z());
    const auto grid = shapeAt(t);
    mesh = prepare(*grid, kVoxel, seeds).levels[0];
    requireGuarantees(mesh, *grid);
    const IsoSurface iso = isoSurface(LevelSet(*grid));
    CHECK(double(mesh.positions.size()) == Approx(area(iso.positions, iso.triangles)).epsilon(0.03));
  }
}

TEST_CASE("guarantees: two drops that merge and a drop that tears get the topology of their surface") {
  for (const auto& [from, to] : {std::pair(0.04, -0.04), std::pair(-0.04, 0.04)}) {
    INFO("gap " << from << " -> " << to);
    const SurfaceMesh before = prepare(*twoSpheresGrid(from, kVoxel), kVoxel).levels[0];
    Seeds seeds = resting(before);
    for (Vec3f& p : seeds.positions) p.x() += float(p.x() > 0.0f ? to - from : from - to) * 0.5f;
    const auto grid = twoSpheresGrid(to, kVoxel);
    requireGuarantees(prepare(*grid, kVoxel, seeds).levels[0], *grid);
  }
}

TEST_CASE("guarantees: the Enright sphere at its most stretched", "[slow]") {
  namespace shapes = fluidtex::benchmarks;
  // With fewer points the sheet is thinner than a voxel at its rim.
  constexpr int kPoints = 60000;
  const double voxel = std::sqrt(shapes::kStretchedArea / kPoints);
  const auto grid = shapes::levelSetOf(shapes::deformed(shapes::enrightSphere(4 * kPoints), 0.0, 1.5), voxel);
  const SurfaceMesh random = prepare(*grid, voxel).levels[0];
  CHECK(double(random.positions.size()) == Approx(double(kPoints)).epsilon(0.03));
  // Carried on for a while and brought back: thinned, filled and connected anew.
  Seeds seeds{random.positions, {}, {}, {}};
  for (Vec3f& p : seeds.positions) p = Vec3f(shapes::carriedByDeformation(Vec3d(p), 1.5, 1.6));
  for (const SurfaceMesh& mesh : {random, prepare(*grid, voxel, seeds).levels[0]})
    requireGuarantees(mesh, *grid);
}

TEST_CASE("guarantees: the same bytes on any number of threads, with the last mesh or without") {
  // So large that many patches are worked on at once.
  const auto grid = splashGrid(60, kVoxel, 5);
  constexpr double kSpacing = 0.06;
  const auto run = [&](int threads) {
    return onThreads(threads, [&] {
      std::vector<SurfaceMesh> meshes{prepare(*grid, kSpacing).levels[0]};
      Seeds moved = resting(meshes[0]);
      for (Vec3f& p : moved.positions) p += Vec3f(0.01f * std::sin(20.0f * p.y()), 0.0f, 0.005f);
      meshes.push_back(prepare(*grid, kSpacing, moved).levels[0]);
      meshes.push_back(prepare(*grid, kSpacing, {moved.positions, {}, {}, {}}).levels[0]);
      return meshes;
    });
  };
  const auto one = run(1);
  REQUIRE(patchesOf(one[0].positions, 40.0f * float(kSpacing)).count() >= 8);
  for (const std::size_t threads : {2, 7}) {
    INFO(threads << " threads");
    const auto more = run(threads);
    for (std::size_t k = 0; k < one.size(); ++k) {
      CHECK(one[k].positions == more[k].positions);
      CHECK(one[k].normals == more[k].normals);
      CHECK(one[k].triangles == more[k].triangles);
    }
  }
}
