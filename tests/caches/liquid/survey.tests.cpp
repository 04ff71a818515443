#include "caches/liquid/survey.h"

#include "tests/caches/liquid/cache_files.h"

#include <catch2/catch.hpp>

using namespace fluidtex::caches;
using Catch::Matchers::Contains;

namespace {

Clip falling() {
  Clip clip;
  clip.flow = freeFall();
  clip.frames = 5;
  return clip;
}

}  // namespace

TEST_CASE("survey: bounds of the first, a middle and the last frame, and cells as the files have them",
          "[caches]") {
  const Clip clip = falling();
  for (const Way way : {Way::staggered, Way::turned, Way::yUpMillimeters, Way::ply, Way::mantaflowGrids,
                        Way::mantaflowMesh, Way::vtk}) {
    INFO(nameOf(way));
    const Scratch scratch;
    const Survey found = survey(writeCache(way, clip, scratch.path).options);
    CHECK(found.layout.frames() == 5);
    const double slack = (way == Way::vtk ? 1.0 : 0.2) * clip.h;
    const Vec3d low = clip.at(5).center - Vec3d(clip.ball.radius),
                high = clip.ball.center + Vec3d(clip.ball.radius);
    INFO(found.bounds);
    CHECK(found.bounds.min().eq(low, slack));
    CHECK(found.bounds.max().eq(high, slack));
    const bool isMesh = way == Way::ply || way == Way::mantaflowMesh;
    CHECK(found.voxel == Approx(clip.h).epsilon(isMesh ? 0.5 : way == Way::vtk ? 0.02 : 1e-3));
  }
}

TEST_CASE("survey: one radius for all frames of particles", "[caches]") {
  Clip clip = falling();
  const Scratch scratch;
  const Options options = writeCache(Way::vtk, clip, scratch.path).options;
  const double radius = survey(options).radius;
  CHECK(radius == Approx(0.5 * clip.h).epsilon(0.02));
  // Half as many a length in the last frame, as where particles were left out: the other two have the say.
  const Scratch sparse;
  clip.h *= 2.0;
  writeCache(Way::vtk, clip, sparse.path);
  std::filesystem::copy_file(sparse.path / "ParticleData_Fluid_5.vtk",
                             scratch.path / "ParticleData_Fluid_5.vtk",
                             std::filesystem::copy_options::overwrite_existing);
  CHECK(survey(options).radius == Approx(radius).epsilon(0.02));
  // The first frame without liquid.
  writeBytes(scratch.path / "ParticleData_Fluid_1.vtk", "");
  CHECK(survey(options).radius > 0.9 * radius);
  Options given = options;
  given.radius = 0.7 * clip.h;
  CHECK(survey(given).radius == given.radius);
  const Scratch other;
  CHECK(survey(writeCache(Way::ply, falling(), other.path).options).radius == 0.0);
}

TEST_CASE("survey: cells that are given stay", "[caches]") {
  const Scratch scratch;
  Options options = writeCache(Way::staggered, falling(), scratch.path).options;
  options.voxel = 0.123;
  CHECK(survey(options).voxel == 0.123);
}

TEST_CASE("survey: the first frames may hold no surface, not all", "[caches]") {
  const Clip clip = falling();
  const Scratch scratch;
  const Options options = writeCache(Way::ply, clip, scratch.path).options;
  writeBytes(scratch.path / "water.0001.ply", "");
  writeBytes(scratch.path / "water.0002.ply", plyBytes({}, {}, {}));
  const Survey found = survey(options);
  CHECK(found.layout.first == 1);
  CHECK(found.bounds.max()[2] == Approx(clip.at(3).center[2] + clip.ball.radius).margin(0.2 * clip.h));
  for (int number = 3; number <= 5; ++number)
    writeBytes(scratch.path / ("water.000" + std::to_string(number) + ".ply"), plyBytes({}, {}, {}));
  CHECK_THROWS_WITH(survey(options), Contains("no frame holds a surface"));
}

TEST_CASE("survey: a particle alone does not tell how large it is", "[caches]") {
  const Scratch scratch;
  writeBytes(scratch.path / "drop_1.vtk", vtkBytes({Vec3d(0.5)}, {Vec3d(0.0)}));
  Options options;
  options.path = scratch.path;
  CHECK_THROWS_WITH(survey(options), Contains("no frame holds a surface") && Contains("files.radius"));
}

TEST_CASE("survey: a middle frame that is missing is no matter yet", "[caches]") {
  const Scratch scratch;
  const Options options = writeCache(Way::ply, falling(), scratch.path).options;
  std::filesystem::remove(scratch.path / "water.0003.ply");
  CHECK(survey(options).layout.last == 5);
}
