#include "texture/levelset/point_scale.h"

#include "tests/texture/levelset/level_sets.h"
#include "tests/texture/mesh/mesh_quality.h"
#include "tests/threads.h"
#include "texture/levelset/isosurface.h"
#include "texture/mesh/prepare.h"

#include <catch2/catch.hpp>

#include <limits>

using namespace fluidtex::texture;

namespace {

constexpr double kVoxel = 0.05;

// The same function of the place for all positions.
template <typename Function>
PointScale scaleOf(const Function& function) {
  return [function](const std::vector<Vec3f>& positions) {
    std::vector<float> result;
    for (const Vec3f& p : positions) result.push_back(float(function(Vec3d(p))));
    return result;
  };
}

// From half the size at one end of the unit sphere to twice at the other.
const PointScale kRising = scaleOf([](const Vec3d& p) { return std::exp2(p.x()); });

SurfaceMesh prepared(const FloatGrid& grid, const Seeds& seeds, const PointScale& scale) {
  return prepareSurface(grid, kVoxel, seeds, 1, SurfaceOptions{}, scale).levels[0];
}

// The mesh as seen with the ruler that its scale is: edges over the mean of their ends' scales.
double variation(const SurfaceMesh& mesh) {
  double sum = 0.0, squares = 0.0;
  const double edges = 3.0 * double(mesh.triangles.size());
  for (const Vec3I& t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      const double length =
          (mesh.positions[a] - mesh.positions[b]).length() / (0.5 * (mesh.spacingAt(a) + mesh.spacingAt(b)));
      sum += length;
      squares += length * length;
    }
  }
  const double mean = sum / edges;
  return std::sqrt(squares / edges - mean * mean) / mean;
}

}  // namespace

TEST_CASE("point scale: it rises nowhere faster than it may, and is the given one where that does not") {
  const auto grid = sphereGrid(1.0, kVoxel);
  const float rise = kScaleSlope / 2.0f;  // a voxel, at a spacing of two
  LevelSet phi(*grid);
  layScale(phi, grid->transform(), scaleOf([](const Vec3d& p) { return p.x() > 0.0 ? 3.0 : 1.0; }), 2.0f);
  for (const Vec3f& p : isoSurface(phi).positions) {
    const float x = p.x(), scale = phi.scale(p);  // the step lies at 0, in voxels
    if (x <= 0.0f) {
      CHECK(scale == Approx(1.0f).margin(1e-5));
    } else {
      // By way of voxels, which is at most a tenth longer than the straight way; linear between them.
      CHECK(scale <= std::min(3.0f, 1.0f + rise * 1.1f * (x + 1.0f)));
      CHECK(scale >= std::min(3.0f, 1.0f + rise * (x - 1.0f)) - 1e-4f);
    }
  }
  LevelSet gentle(*grid);
  const auto linear = [](const Vec3d& p) { return 1.5 + 0.5 * p.x(); };  // 0.025 a voxel
  layScale(gentle, grid->transform(), scaleOf(linear), 2.0f);
  for (const Vec3f& p : isoSurface(gentle).positions)
    CHECK(gentle.scale(p) == Approx(linear(grid->indexToWorld(Vec3d(p)))).margin(1e-4));
}

TEST_CASE("point scale: factors are brought into their range, another number of them is refused") {
  const auto grid = sphereGrid(1.0, kVoxel);
  const auto scaleEverywhere = [&](double factor) {
    LevelSet phi(*grid);
    CHECK_FALSE(phi.scaled());
    layScale(phi, grid->transform(), scaleOf([=](const Vec3d&) { return factor; }), 1.0f);
    CHECK(phi.scaled());
    return phi.scale(isoSurface(phi).positions.front());
  };
  CHECK(scaleEverywhere(2.0) == 2.0f);
  CHECK(scaleEverywhere(100.0) == float(kLargestScale));
  CHECK(scaleEverywhere(-1.0) == float(kLeastScale));
  CHECK(scaleEverywhere(std::numeric_limits<double>::quiet_NaN()) == 1.0f);
  LevelSet phi(*grid);
  const PointScale wrong = [](const std::vector<Vec3f>&) { return std::vector<float>(3, 1.0f); };
  CHECK_THROWS_AS(layScale(phi, grid->transform(), wrong, 1.0f), std::invalid_argument);
}

TEST_CASE("point scale: a scale of one everywhere changes no point") {
  const auto grid = torusGrid(1.0, 0.4, kVoxel);
  const SurfaceMesh plain = prepared(*grid, {}, {});
  const SurfaceMesh same = prepared(*grid, {}, scaleOf([](const Vec3d&) { return 1.0; }));
  CHECK(plain.scale.empty());
  CHECK(same.scale == std::vector<float>(same.positions.size(), 1.0f));
  CHECK(same.positions == plain.positions);
  CHECK(same.triangles == plain.triangles);
}

TEST_CASE("point scale: points are a scaled spacing apart, in triangles as good as elsewhere") {
  const auto grid = sphereGrid(1.0, kVoxel, Vec3d(0.0));
  SurfaceMesh mesh = prepared(*grid, {}, kRising);
  // Twice as drawn at random, then as points that drift along from frame to frame.
  for (int frame = 0; frame < 3; ++frame) {
    INFO("frame " << frame);
    const Vec3d drift(0.0, 0.02 * frame, 0.0);
    const auto now = sphereGrid(1.0, kVoxel, drift);
    if (frame > 0) {
      Seeds seeds{mesh.positions, mesh.positions, mesh.triangles, mesh.scale};
      for (Vec3f& p : seeds.positions) p.y() += 0.02f;
      mesh = prepared(*now, seeds, kRising);
    }
    requireSound(mesh, *now);
    const Quality q = measure(mesh, *now);
    CHECK(variation(mesh) <= 0.15);
    CHECK(q.slim <= 0.001);
    CHECK(q.folded == 0);
    CHECK(q.distance < 0.1);
    CHECK(q.worstDistance < 0.5);
    double squares = 0.0;
    for (const Vec3I& t : mesh.triangles) {
      const double scale = (mesh.scale[t[0]] + mesh.scale[t[1]] + mesh.scale[t[2]]) / 3.0;
      squares += areaOf(mesh.positions, t) / (scale * scale);
    }
    CHECK(double(mesh.positions.size()) == Approx(squares / (kVoxel * kVoxel)).epsilon(0.03));
    for (std::size_t v = 0; v < mesh.scale.size(); ++v)
      CHECK(mesh.scale[v] == Approx(std::exp2(mesh.positions[v].x())).epsilon(0.02));
  }
}

TEST_CASE("point scale: a steep step keeps good triangles too") {
  const auto grid = torusGrid(1.0, 0.4, kVoxel);
  const PointScale step = scaleOf([](const Vec3d& p) { return p.x() > 0.0 ? 4.0 : 0.5; });
  const SurfaceMesh mesh = prepared(*grid, {}, step);
  requireSound(mesh, *grid);
  const Quality q = measure(mesh, *grid);
  CHECK(variation(mesh) <= 0.16);
  CHECK(q.slim <= 0.001);
  CHECK(q.folded == 0);
}

TEST_CASE("point scale: at rest nothing moves, unless the scale does") {
  const auto grid = torusGrid(1.0, 0.4, kVoxel);
  const SurfaceMesh first = prepared(*grid, {}, kRising);
  const Seeds seeds{first.positions, first.positions, first.triangles, first.scale};
  CHECK(prepared(*grid, seeds, kRising).positions == first.positions);
  const PointScale tenth = scaleOf([](const Vec3d& p) { return 1.1 * std::exp2(p.x()); });
  const SurfaceMesh larger = prepared(*grid, seeds, tenth);
  CHECK(double(larger.positions.size()) == Approx(double(first.positions.size()) / 1.21).epsilon(0.03));
  CHECK(variation(larger) <= 0.15);
}

TEST_CASE("point scale: the number of points for a spacing and back, coarser levels, any number of threads") {
  const auto grid = sphereGrid(1.0, kVoxel);
  const double spacing = spacingForPoints(*grid, 4000, kRising);
  const auto run = [&](int threads) {
    return onThreads(threads,
                     [&] { return prepareSurface(*grid, spacing, Seeds{}, 2, SurfaceOptions{}, kRising); });
  };
  const Surface one = run(1), two = run(2);
  CHECK(double(one.levels[0].positions.size()) == Approx(4000.0).epsilon(0.04));
  CHECK(double(one.levels[1].positions.size()) == Approx(1000.0).epsilon(0.06));
  for (std::size_t level = 0; level < 2; ++level) {
    CHECK(one.levels[level].positions == two.levels[level].positions);
    CHECK(one.levels[level].scale == two.levels[level].scale);
  }
}
