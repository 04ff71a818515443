#include "caches/liquid/read_frame.h"

#include "caches/formats/format_error.h"
#include "caches/liquid/face_sampler.h"
#include "tests/caches/liquid/ball_with_fields.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::caches;
using Catch::Matchers::Contains;

namespace {

constexpr double kClipSpeed = 3.0;  // m/s along x

Clip slidingBall() {
  Clip clip;
  clip.flow = translation(Vec3d(kClipSpeed, 0, 0));
  clip.frames = 2;
  return clip;
}

Cache writtenCache(Way way, const std::filesystem::path& folder, double scale = 1.0) {
  const Clip clip = slidingBall();
  Options options = writeCache(way, clip, folder).options;
  options.scale = scale;
  return cacheOf(options, clip);
}

}  // namespace

TEST_CASE("read frame: the surface in metres, in each way that a cache is written", "[caches]") {
  const Clip clip = slidingBall();
  for (const Way way : kWays) {
    INFO(nameOf(way));
    const Scratch scratch;
    const CacheFiles files = writeCache(way, clip, scratch.path);
    const SurfaceTriangles surface = readSurface(cacheOf(files.options, clip), 1);
    REQUIRE(surface.triangles.size() > 500);
    double sum = 0.0;
    for (const openvdb::Vec3f& x : surface.points) sum += std::abs(clip.ball.distance(Vec3d(x)));
    CHECK(sum / double(surface.points.size()) < files.accuracy * clip.h);
    const openvdb::BBoxd bounds = boundsOf(surface);
    CHECK(
        bounds.min().eq(clip.ball.center - Vec3d(clip.ball.radius), (way == Way::vtk ? 1.0 : 0.2) * clip.h));
    CHECK(
        bounds.max().eq(clip.ball.center + Vec3d(clip.ball.radius), (way == Way::vtk ? 1.0 : 0.2) * clip.h));
  }
}

TEST_CASE("read frame: pieces that are too small have no triangles, a mesh keeps their points", "[caches]") {
  const Scratch scratch;
  std::vector<Vec3d> points, drop;
  std::vector<openvdb::Vec3I> triangles, small;
  ballMesh({}, 3, points, triangles);
  ballMesh({Vec3d(2, 0, 0), 0.02}, 1, drop, small);
  const std::size_t inBall = triangles.size();
  for (const openvdb::Vec3I& t : small)
    triangles.push_back(t + openvdb::Vec3I(openvdb::Index32(points.size())));
  points.insert(points.end(), drop.begin(), drop.end());
  writeBytes(scratch.path / "a_1.ply", plyBytes(points, triangles, {}));
  Options options;
  CHECK(readSurface(cacheAt(scratch.path, options), 1).triangles.size() == triangles.size());
  options.leastPiece = 1e-4;
  CHECK(readSurface(cacheAt(scratch.path, options), 1).triangles.size() == inBall);
  const CachedMesh mesh = readMesh(cacheAt(scratch.path, options), 1);
  CHECK(mesh.surface.triangles.size() == inBall);
  CHECK(mesh.surface.points.size() == points.size());
  CHECK(readFrame(cacheAt(scratch.path, options), 1).surface.triangles.size() == inBall);
}

TEST_CASE("read frame: a file of no bytes is no liquid, one that is missing or damaged is told", "[caches]") {
  const Scratch scratch;
  const Cache cache = writtenCache(Way::ply, scratch.path);
  const auto file = scratch.path / "water.0001.ply";
  CHECK_THROWS_AS(readSurface(cache, 3), LayoutError);
  CHECK_THROWS_AS(readFrame(cache, 3), LayoutError);
  const std::string whole = readBytes(file);
  writeBytes(file, whole.substr(0, whole.size() / 2));
  CHECK_THROWS_AS(readSurface(cache, 1), FormatError);
  CHECK_THROWS_WITH(readFrame(cache, 1), Contains("water.0001.ply: "));
  CHECK_THROWS_AS(readMesh(cache, 1), FormatError);
  writeBytes(file, "");
  CHECK(readSurface(cache, 1).points.empty());
  CHECK(readMesh(cache, 1).surface.points.empty());
  const LiquidFrame frame = readFrame(cache, 1);
  CHECK(frame.surface.triangles.empty());
  CHECK_FALSE(frame.isSheet);
  CHECK(frame.phi->activeVoxelCount() == 0);
  CHECK_FALSE(frame.velocity);
  CHECK(frame.fields.empty());
}

TEST_CASE("read frame: a level set of the cells that are asked for, and the surface that it is of",
          "[caches]") {
  const Scratch scratch;
  Cache cache = writtenCache(Way::ply, scratch.path);
  cache.voxel = 0.04;
  const LiquidFrame frame = readFrame(cache, 1);
  CHECK(frame.phi->transform() == *sim::cellTransform(0.04));
  CHECK_FALSE(frame.isSheet);
  double largest = 0.0;
  for (auto value = frame.phi->cbeginValueOn(); value; ++value)
    largest =
        std::max(largest, std::abs(*value - Ball{}.distance(frame.phi->indexToWorld(value.getCoord()))));
  CHECK(largest < 0.05 * cache.voxel);
  CHECK(frame.surface.points == readSurface(cache, 1).points);
  cache.voxel = 1e-5;
  CHECK_THROWS_AS(readFrame(cache, 1), LayoutError);
  CHECK_THROWS_WITH(readFrame(cache, 1),
                    Contains("water.0001.ply: its surface crosses") && Contains("give larger cells"));
}

TEST_CASE("read frame: velocities of points reach as far as a frame's motion, others as the files",
          "[caches]") {
  for (const Way way :
       {Way::ply, Way::flipFluids, Way::mantaflowMesh, Way::plyYUp, Way::staggered, Way::vtk}) {
    INFO(nameOf(way));
    const Scratch scratch;
    Cache cache = writtenCache(way, scratch.path);
    const LiquidFrame frame = readFrame(cache, 1);
    REQUIRE(frame.velocity);
    const FaceSampler sampler(frame.velocity);
    const bool isAtPoints = way == Way::ply || way == Way::flipFluids || way == Way::plyYUp;
    const double reach = isAtPoints ? kClipSpeed / cache.frameRate : 2.0 * cache.voxel;
    for (const Vec3d& direction : {Vec3d(1, 0, 0), Vec3d(0, -1, 0), Vec3d(0.6, 0, 0.8)}) {
      Vec3d velocity;
      CHECK(sampler.at(Ball{}.center + (Ball{}.radius + reach) * direction, velocity));
      CHECK((velocity - Vec3d(kClipSpeed, 0, 0)).length() < 1e-3 * kClipSpeed);
      CHECK_FALSE(sampler.at(Ball{}.center + 3.0 * direction, velocity));
    }
    cache.layout.velocityKind = VelocityKind::none;
    CHECK_FALSE(readFrame(cache, 1).velocity);
  }
}

TEST_CASE("read frame: cells as large as voxels, particles apart or edges, in the world", "[caches]") {
  const double h = slidingBall().h;
  for (const Way way : {Way::staggered, Way::fog, Way::turned, Way::yUpMillimeters, Way::mantaflowGrids}) {
    INFO(nameOf(way));
    const Scratch scratch;
    CHECK(suitingVoxel(writtenCache(way, scratch.path, 2.5), 1, {}) == Approx(2.5 * h).epsilon(1e-5));
  }
  const Scratch scratch;
  Cache particles = writtenCache(Way::vtk, scratch.path, 2.5);
  CHECK(suitingVoxel(particles, 1, {}) == Approx(2.5 * h).epsilon(0.02));
  particles.options.unit = 0.1;
  CHECK(suitingVoxel(particles, 1, {}) == Approx(0.25 * h).epsilon(0.02));
  particles.options.radius = 0.7;
  CHECK(suitingVoxel(particles, 1, {}) == Approx(0.7 * 2.0 * 0.1 * 2.5));
  const Scratch other;
  const SurfaceTriangles edges{{openvdb::Vec3f(0, 0, 0), openvdb::Vec3f(3, 0, 0), openvdb::Vec3f(0, 4, 0)},
                               {openvdb::Vec3I(0, 1, 2)}};
  CHECK(suitingVoxel(writtenCache(Way::ply, other.path, 2.5), 1, edges) == Approx(4.0));
}

TEST_CASE("read frame: a particle's radius is half of the way to the next, as in the files", "[caches]") {
  const Scratch scratch;
  Cache cache = writtenCache(Way::vtk, scratch.path, 2.5);
  cache.options.unit = 0.001;
  CHECK(particleRadius(cache, 1) == Approx(0.5 * slidingBall().h).epsilon(0.02));
  const auto file = scratch.path / "ParticleData_Fluid_1.vtk";
  writeBytes(file, vtkBytes({Vec3d(0.5)}, {Vec3d(0.0)}));
  CHECK(particleRadius(cache, 1) == 0.0);
  writeBytes(file, "");
  CHECK(particleRadius(cache, 1) == 0.0);
  CHECK_THROWS_AS(particleRadius(cache, 3), LayoutError);
}

TEST_CASE("read frame: the mesh of a frame as it came, points in their order", "[caches]") {
  const Scratch scratch;
  const auto [points, triangles] = writeBall(scratch.path / "a_1.ply", 2);
  Options options;
  options.unit = 0.001;
  options.move = Vec3d(1.0, 0.0, 0.0);
  const CachedMesh mesh = readMesh(cacheAt(scratch.path, options), 1);
  REQUIRE(mesh.surface.points.size() == points.size());
  CHECK(mesh.surface.triangles == triangles);
  CHECK(mesh.attributes.size() == 4);
  for (std::size_t n = 0; n < points.size(); ++n) {
    CHECK((Vec3d(mesh.surface.points[n]) - (0.001 * points[n] + options.move)).length() < 1e-6);
    CHECK(mesh.attributes.at("heat")[n] == Approx(heatAt(points[n])));
    CHECK(mesh.attributes.at("Cd_x")[n] == Approx(points[n][0]));
  }
}
