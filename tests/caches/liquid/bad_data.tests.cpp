// Caches that lack something, or in which something is wrong: one sentence each, or what they hold.
#include "caches/formats/format_error.h"
#include "caches/liquid/cached_flow.h"
#include "caches/liquid/survey.h"
#include "tests/caches/liquid/cache_files.h"
#include "transport/backtrace.h"

#include <openvdb/tools/LevelSetSphere.h>

#include <catch2/catch.hpp>

#include <limits>

using namespace fluidtex;
using namespace fluidtex::caches;
using Catch::Matchers::Contains;
using openvdb::Vec3f;
namespace fs = std::filesystem;

namespace {

Clip moving(int frames = 4) {
  Clip clip;
  clip.flow = translation(Vec3d(0.9, -0.7, 0.5));
  clip.frames = frames;
  clip.h = 1.0 / 20.0;
  return clip;
}

// The sentence that a run ends with; empty where it does not. All else that is thrown is a fault.
std::string endOf(const Options& options, const Clip& clip) {
  std::string sentence;
  try {
    survey(options);
    framesOf(options, clip);
  } catch (const LayoutError& error) {
    sentence = error.what();
  } catch (const FormatError& error) {
    sentence = error.what();
  }
  CHECK(sentence.find('\n') == std::string::npos);
  return sentence;
}

// The files of a frame, whatever its folder.
std::vector<fs::path> filesOf(const fs::path& folder, int frame) {
  std::vector<fs::path> files;
  for (const std::string& name : filesIn(folder)) {
    const std::string last = fs::path(name).filename().string();
    if (last.find("00" + std::to_string(frame) + ".") != std::string::npos ||
        last.find("_" + std::to_string(frame) + ".") != std::string::npos)
      files.push_back(folder / name);
  }
  REQUIRE_FALSE(files.empty());
  return files;
}

bool isEmpty(const sim::Frame& frame) {
  return frame.surfacePhi->activeVoxelCount() == 0 && frame.stats.cells == 0;
}

// spoil(options, file, its bytes) for each file of the third frame, in each way that a cache is written; the
// file is mended afterwards, and the cache is whole then.
template <class Spoil>
void forEachFile(const Spoil& spoil) {
  for (const Way way : kWays) {
    const Scratch scratch;
    const Options options = writeCache(way, moving(), scratch.path).options;
    for (const fs::path& file : filesOf(scratch.path, 3)) {
      INFO(nameOf(way) << ": " << file.filename());
      const std::string whole = readBytes(file);
      spoil(options, file, whole);
      writeBytes(file, whole);
    }
    CHECK(endOf(options, moving()).empty());
  }
}

constexpr int kDamages = 3;

void checkDamage(const Options& options, const fs::path& file, const std::string& whole, int damage) {
  const std::string damaged[kDamages] = {whole.substr(0, whole.size() / 2), whole.substr(0, 5),
                                         "something else entirely"};
  INFO(damaged[damage].size() << " bytes");
  writeBytes(file, damaged[damage]);
  // What is damaged in blur is what makes the unit of the velocities known.
  CHECK_THAT(endOf(options, moving()), Contains(file.filename().string()));
}

}  // namespace

TEST_CASE("bad_data: a frame cut short or replaced ends a run with the file's name", "[caches][slow]") {
  int turn = 0;
  forEachFile([&](const Options& options, const fs::path& file, const std::string& whole) {
    checkDamage(options, file, whole, turn++ % kDamages);
  });
}

TEST_CASE("bad_data: each file cut short or replaced in each way", "[caches][long]") {
  forEachFile([](const Options& options, const fs::path& file, const std::string& whole) {
    for (int damage = 0; damage < kDamages; ++damage) checkDamage(options, file, whole, damage);
  });
}

TEST_CASE("bad_data: a file of no bytes is a frame without liquid, or without velocities", "[caches]") {
  const Clip clip = moving();
  for (const Way way : {Way::staggered, Way::ply, Way::vtk}) {
    INFO(nameOf(way));
    const Scratch scratch;
    const Options options = writeCache(way, clip, scratch.path).options;
    for (const fs::path& file : filesOf(scratch.path, 3)) writeBytes(file, "");
    const std::vector<sim::Frame> frames = framesOf(options, clip);
    CHECK_FALSE(isEmpty(frames[1]));
    CHECK(isEmpty(frames[2]));
    CHECK_FALSE(isEmpty(frames[3]));
  }
  for (const Way way : {Way::plyAndGrids, Way::mantaflowMesh}) {
    INFO(nameOf(way));
    const Scratch scratch;
    const Options options = writeCache(way, clip, scratch.path).options;
    for (const fs::path& file : filesOf(scratch.path, 3))
      if (file.extension() == ".vdb") writeBytes(file, "");
    const std::vector<sim::Frame> frames = framesOf(options, clip);
    // From 2 to 3 by the velocity of 2, from 3 to 4 by that of 4.
    for (const std::size_t n : {2u, 3u}) {
      REQUIRE(frames[n].substeps.size() == 1);
      CHECK(frames[n].substeps[0].u->activeVoxelCount() > 0);
    }
  }
}

TEST_CASE("bad_data: missing frames are named", "[caches]") {
  forEachFile([](const Options& options, const fs::path& file, const std::string&) {
    fs::remove(file);
    const std::string end = endOf(options, moving());
    if (file.filename().string().starts_with("blur"))
      CHECK_THAT(end, Contains("blur####.bobj"));
    else
      CHECK_THAT(end, Contains("number 3 is missing (2 is there, and then 4)"));
  });
}

TEST_CASE("bad_data: numbers that are none", "[caches]") {
  const Clip clip = moving();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Scratch scratch;
  const Options options = writeCache(Way::ply, clip, scratch.path).options;
  std::vector<Vec3d> points, velocities;
  std::vector<openvdb::Vec3I> triangles;
  ballMesh(clip.at(3), 3, points, triangles);
  velocities.assign(points.size(), Vec3d(0.9, -0.7, 0.5));
  const auto with = [&](std::vector<Vec3d>& where, double number) {
    const double right = std::exchange(where[5][1], number);
    writeBytes(scratch.path / "water.0003.ply", plyBytes(points, triangles, velocities));
    where[5][1] = right;
    return endOf(options, clip);
  };
  CHECK_THAT(with(points, nan), Contains("water.0003.ply"));
  CHECK_THAT(with(velocities, nan), Contains("water.0003.ply") && Contains("v is no number at point 5"));
  CHECK_THAT(with(velocities, HUGE_VAL), Contains("v is no number at point 5"));
  CHECK(with(points, points[5][1]).empty());
  // Vertices or speeds beyond all bounds are no crash.
  with(velocities, 1e30);
}

TEST_CASE("bad_data: a vertex far away takes no memory", "[caches]") {
  const Clip clip = moving(1);
  const Scratch scratch;
  const Options options = writeCache(Way::ply, clip, scratch.path).options;
  std::vector<Vec3d> points, velocities;
  std::vector<openvdb::Vec3I> triangles;
  ballMesh(clip.at(1), 3, points, triangles);
  velocities.assign(points.size(), Vec3d(0.0));
  points[5] = Vec3d(1e30, 0, 0);
  writeBytes(scratch.path / "water.0001.ply", plyBytes(points, triangles, velocities));
  CHECK_THAT(endOf(options, clip), Contains("water.0001.ply"));
}

TEST_CASE("bad_data: velocities that lie elsewhere than the surface", "[caches]") {
  const Clip clip = moving();
  const Scratch scratch;
  Options options = writeCache(Way::plyAndGrids, clip, scratch.path).options;
  // Meshes in the room of the clip, velocities of one that is ten metres off.
  Clip elsewhere = clip;
  elsewhere.ball.center += Vec3d(10, 0, 0);
  writeCache(Way::plyAndGrids, elsewhere, scratch.path / "elsewhere");
  for (int n = 1; n <= clip.frames; ++n) {
    const std::string name = "velocity_000" + std::to_string(n) + ".vdb";
    fs::copy_file(scratch.path / "elsewhere" / name, scratch.path / name,
                  fs::copy_options::overwrite_existing);
  }
  CHECK_THAT(endOf(options, clip), Contains("velocity_0001.vdb: its velocities lie from (") &&
                                       Contains("and the surface from (") && Contains("one unit"));
}

TEST_CASE("bad_data: liquid that goes and comes back", "[caches]") {
  const Clip clip = moving(6);
  for (const Way way : {Way::ply, Way::mantaflowMesh, Way::flipFluids}) {
    INFO(nameOf(way));
    const Scratch scratch;
    const Options options = writeCache(way, clip, scratch.path).options;
    const std::string none(way == Way::mantaflowMesh ? 12 : 8, '\0');
    for (const int frame : {3, 4})
      for (const fs::path& file : filesOf(scratch.path, frame)) {
        const std::string ending = file.extension().string();
        if (ending == ".ply") writeBytes(file, plyBytes({}, {}, {}));
        if (ending == ".gz") writeBytes(file, gzipped(none));
        if (ending == ".bobj") writeBytes(file, none);
      }
    const std::vector<sim::Frame> frames = framesOf(options, clip);
    for (int n = 1; n <= clip.frames; ++n) CHECK(isEmpty(frames[std::size_t(n - 1)]) == (n == 3 || n == 4));
    CHECK(frames[5].stats.explained.value() > 0.99);
    for (const sim::Frame& frame : frames)
      for (const sim::Substep& substep : frame.substeps) CHECK(std::isfinite(substep.dt));
  }
}

TEST_CASE("bad_data: one frame alone", "[caches]") {
  const Clip clip = moving(1);
  for (const Way way : kWays) {
    INFO(nameOf(way));
    const Scratch scratch;
    const Options options = writeCache(way, clip, scratch.path).options;
    const std::vector<sim::Frame> frames = framesOf(options, clip);
    CHECK_FALSE(isEmpty(frames[0]));
    CHECK(frames[0].substeps.empty());
    CachedFlow flow(cacheOf(options, clip));
    flow.next();
    CHECK_THROWS_AS(flow.next(), LayoutError);
  }
}

TEST_CASE("bad_data: velocities of another mesh", "[caches]") {
  const Clip clip = moving();
  const Scratch scratch;
  const Options options = writeCache(Way::flipFluids, clip, scratch.path).options;
  std::string bytes;
  put(bytes, std::int32_t(2));
  bytes += bytesOf<float>({1, 2, 3, 4, 5, 6});
  put(bytes, std::int32_t(0));
  writeBytes(scratch.path / "bakefiles" / "velocity000002.bobj", bytes);
  CHECK_THAT(endOf(options, clip), Contains("velocity000002.bobj: holds 2 vectors, the mesh"));
}

TEST_CASE("bad_data: an attribute that later frames lack", "[caches]") {
  const Clip clip = moving();
  const Scratch scratch;
  const Options options = writeCache(Way::ply, clip, scratch.path).options;
  std::vector<Vec3d> points;
  std::vector<openvdb::Vec3I> triangles;
  ballMesh(clip.at(2), 3, points, triangles);
  writeBytes(scratch.path / "water.0002.ply", plyBytes(points, triangles, {}));
  CHECK_THAT(endOf(options, clip), Contains("water.0002.ply: lacks the attribute v"));
}

TEST_CASE("bad_data: an open surface is a sheet, and is said to be one", "[caches]") {
  const Clip clip = moving(2);
  const Scratch scratch;
  const Options options = writeCache(Way::ply, clip, scratch.path).options;
  for (const int n : {1, 2}) {
    const double x = 0.9 / 24.0 * (n - 1);
    writeBytes(scratch.path / ("water.000" + std::to_string(n) + ".ply"),
               plyBytes({Vec3d(x, 0, 0.5), Vec3d(x + 1, 0, 0.5), Vec3d(x + 1, 1, 0.5), Vec3d(x, 1, 0.5)},
                        {openvdb::Vec3I(0, 1, 2), openvdb::Vec3I(0, 2, 3)},
                        std::vector<Vec3d>(4, Vec3d(0.9, 0, 0))));
  }
  CachedFlow flow(cacheOf(options, clip));
  CHECK_FALSE(isEmpty(flow.next()));
  flow.next();
  REQUIRE(flow.warnings().size() == 1);
  CHECK_THAT(flow.warnings()[0], Contains("water.####.ply: encloses no volume"));
}

TEST_CASE("bad_data: velocities without active voxels are told as such", "[caches]") {
  const Clip clip{translation(Vec3d(0.0)), {}, 4};
  const Scratch scratch;
  const Options options = writeCache(Way::plyAndGrids, clip, scratch.path).options;
  const auto none = openvdb::Vec3SGrid::create(openvdb::Vec3f(0.0f));
  none->setName("vel");
  for (const int n : {2, 3})
    openvdb::io::File((scratch.path / ("velocity_000" + std::to_string(n) + ".vdb")).string()).write({none});
  CachedFlow flow(cacheOf(options, clip));
  flow.next();
  CHECK(flow.warnings().empty());
  for (int frame = 2; frame <= 4; ++frame) flow.next();
  REQUIRE(flow.warnings().size() == 1);
  CHECK_THAT(flow.warnings()[0], Contains("velocity_####.vdb: has no active voxels in some frames"));
}
