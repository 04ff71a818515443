#include "pipeline/motion.h"

#include "pipeline/take_cache.h"
#include "tests/pipeline/written_caches.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <chrono>
#include <fstream>
#include <utility>
#include <variant>

using namespace fluidtex;
using namespace fluidtex::pipeline;
using Catch::Contains;

namespace {

// Of files in this folder, with what is found out from them.
scenes::Scene takenFrom(const std::filesystem::path& folder) {
  scenes::Scene scene = sceneIn(folder);
  scene.motion.flow = sim::MotionKind::files;
  takeCache(scene);
  return scene;
}

scenes::Scene poolScene() {
  scenes::Scene scene;
  scene.sim = pool();
  return scene;
}

// A tetrahedron of half a metre at that height, with velocities.
void writeMesh(const std::filesystem::path& file, double height) {
  std::ofstream out(file);
  out << "ply\nformat ascii 1.0\nelement vertex 4\n";
  for (const char* name : {"x", "y", "z", "vx", "vy", "vz"}) out << "property float " << name << "\n";
  out << "element face 4\nproperty list uchar int vertex_indices\nend_header\n";
  for (const char* corner : {"0 0 ", "0.5 0 ", "0 0.5 "}) out << corner << height << " 0 0 0\n";
  out << "0 0 " << height + 0.5 << " 0 0 0\n";
  out << "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
}

// Two frames, and a third from the state after them; whether that is the third of a source that did not stop.
std::pair<sim::Frame, sim::Frame> thirdFrames(const scenes::Scene& scene) {
  Motion whole = makeMotion(scene);
  CHECK(nextFrame(whole).index == 1);
  CHECK(stateOf(whole).frame == 1);
  CHECK(nextFrame(whole).index == 2);
  Motion rest = makeMotion(scene, stateOf(whole));
  CHECK(rest.index() == whole.index());
  CHECK(stateOf(rest).frame == 2);
  CHECK(stateOf(rest).time == stateOf(whole).time);
  std::pair<sim::Frame, sim::Frame> third{nextFrame(whole), nextFrame(rest)};
  for (const sim::Frame* frame : {&third.first, &third.second}) {
    CHECK(frame->index == 3);
    CHECK(frame->time == Approx(2.0 / scene.sim.frameRate));
    CHECK_FALSE(frame->substeps.empty());
  }
  return third;
}

void checkSameSurface(const sim::Frame& a, const sim::Frame& b) {
  REQUIRE(a.surfacePhi->activeVoxelCount() == b.surfacePhi->activeVoxelCount());
  auto left = a.surfacePhi->cbeginValueOn(), right = b.surfacePhi->cbeginValueOn();
  for (; left; ++left, ++right) REQUIRE((left.getCoord() == right.getCoord() && *left == *right));
}

}  // namespace

TEST_CASE("motion of a scene: solver, analytic flow, another program's files or recorded frames") {
  scenes::Scene scene = poolScene();
  CHECK(std::holds_alternative<sim::Solver>(std::get<sim::Motion>(makeMotion(scene))));
  scene.motion.flow = sim::MotionKind::rest;
  CHECK(std::holds_alternative<sim::AnalyticFlow>(std::get<sim::Motion>(makeMotion(scene))));
  const Scratch scratch;
  writeBalls(scratch.path, 1, 1);
  CHECK(std::holds_alternative<caches::CachedFlow>(makeMotion(takenFrom(scratch.path))));
  const Scratch other;
  writePool(other.path, 1);
  CHECK(std::holds_alternative<caches::RecordedFlow>(makeMotion(takenFrom(other.path))));
}

TEST_CASE("motion of a scene: files come in their order and at the scene's rate, where they are placed") {
  const Scratch scratch;
  writeBalls(scratch.path, 5, 7);
  scenes::Scene scene = takenFrom(scratch.path);
  // Twice as many frames a second, in which the balls go as far.
  scene.sim.frameRate = 48.0;
  scene.files.velocityScale = 2.0;
  Motion motion = makeMotion(scene);
  CHECK(stateOf(motion).frame == 0);
  for (int n = 0; n < 3; ++n) {
    double told = 0.0;
    const sim::Frame frame = nextFrame(motion, [&](double share) { told = share; });
    CHECK(frame.index == n + 1);
    CHECK(frame.time == Approx(n / 48.0));
    CHECK(told == 1.0);
    CHECK(stateOf(motion).frame == n + 1);
    CHECK(stateOf(motion).time == frame.time);
    CHECK(frame.surfacePhi->voxelSize()[0] == Approx(kBallCell));
    const auto at = [&](double x) {
      const openvdb::FloatGrid& phi = *frame.surfacePhi;
      return phi.tree().getValue(openvdb::Coord::round(phi.worldToIndex(Vec3d(x, 2.0, 3.0))));
    };
    const double center = 1.0 + 0.25 * n, edge = kBallRadius + kBallCell;
    CHECK(at(center) < 0.0f);
    CHECK(at(center - edge) > 0.0f);
    CHECK(at(center + edge) > 0.0f);
  }
  CHECK_THROWS_AS(nextFrame(motion), caches::LayoutError);
}

TEST_CASE("motion of a scene: each source goes on from its state") {
  SECTION("solver") {
    const auto [whole, rest] = thirdFrames(poolScene());
    checkSameSurface(whole, rest);
  }
  SECTION("analytic flow") {
    scenes::Scene scene = poolScene();
    scene.motion.flow = sim::MotionKind::rotation;
    const auto [whole, rest] = thirdFrames(scene);
    checkSameSurface(whole, rest);
  }
  SECTION("files of another program") {
    const Scratch scratch;
    writeBalls(scratch.path, 1, 3);
    const auto [whole, rest] = thirdFrames(takenFrom(scratch.path));
    checkSameSurface(whole, rest);
  }
  SECTION("recorded frames") {
    const Scratch scratch;
    writePool(scratch.path, 3);
    const auto [whole, rest] = thirdFrames(takenFrom(scratch.path));
    checkSameSurface(whole, rest);
  }
}

TEST_CASE("motion of a scene: a state of other cells and files that are gone are refused") {
  scenes::Scene scene = poolScene();
  Motion motion = makeMotion(scene);
  nextFrame(motion);
  scene.sim.resolution = 15;
  CHECK_THROWS_AS(makeMotion(scene, stateOf(motion)), sim::SolverError);
  const Scratch scratch;
  writeBalls(scratch.path, 1, 1);
  scene = takenFrom(scratch.path);
  std::filesystem::remove(scratch.path / "water_1.vdb");
  CHECK_THROWS_AS(makeMotion(scene), caches::LayoutError);
}

TEST_CASE("motion of a scene: meshes are those of the frame's own file, and there are none else") {
  const Scratch scratch;
  writeMesh(scratch.path / "water_7.ply", 1.0);
  writeMesh(scratch.path / "water_8.ply", 2.0);
  Motion motion = makeMotion(takenFrom(scratch.path));
  for (const int frame : {2, 1}) {
    const std::optional<caches::CachedMesh> mesh = meshOf(motion, frame);
    REQUIRE(mesh);
    REQUIRE(mesh->surface.points.size() == 4);
    CHECK(mesh->surface.triangles.size() == 4);
    CHECK(mesh->surface.points[0].eq({0.0f, 0.0f, float(frame)}));
    CHECK(mesh->surface.points[3].eq({0.0f, 0.0f, float(frame) + 0.5f}));
  }
  CHECK(stateOf(motion).frame == 0);
  const Scratch balls, recorded;
  writeBalls(balls.path, 1, 1);
  writePool(recorded.path, 1);
  CHECK_FALSE(meshOf(makeMotion(takenFrom(balls.path)), 1));
  CHECK_FALSE(meshOf(makeMotion(takenFrom(recorded.path)), 1));
  CHECK_FALSE(meshOf(makeMotion(poolScene()), 1));
}

TEST_CASE("motion of a scene: a frame that is still to be written is waited for where the scene says so") {
  const Scratch scratch;
  writeBalls(scratch.path, 1, 2);
  const std::filesystem::path second = scratch.path / "water_2.vdb", away = scratch.path / "water_2.part";
  scenes::Scene scene = takenFrom(scratch.path);
  std::filesystem::rename(second, away);
  // Long enough ago that it is whole.
  std::filesystem::last_write_time(
      scratch.path / "water_1.vdb",
      std::filesystem::last_write_time(scratch.path / "water_1.vdb") - std::chrono::minutes(1));
  Motion still = makeMotion(scene);
  scene.files.follow = true;
  Motion following = makeMotion(scene);
  CHECK_FALSE(awaitedFile(following));
  nextFrame(following);
  nextFrame(still);
  CHECK(awaitedFile(following) == second);
  CHECK_FALSE(awaitedFile(still));
  std::filesystem::last_write_time(away, std::filesystem::last_write_time(away) - std::chrono::minutes(1));
  std::filesystem::rename(away, second);
  CHECK_FALSE(awaitedFile(following));
  CHECK(nextFrame(following).index == 2);
  Motion solver = makeMotion(poolScene());
  CHECK_FALSE(awaitedFile(solver));
}

TEST_CASE("motion of a scene: warnings are those of its source") {
  scenes::Scene scene = poolScene();
  CHECK(warningsOf(scene).empty());
  scene.sim.solids.resize(1);
  scene.sim.solids[0].name = "far";
  scene.sim.solids[0].shape = {sim::Sphere{Vec3d(9.0), 0.5}};
  REQUIRE(warningsOf(scene).size() == 1);
  CHECK_THAT(warningsOf(scene)[0], Contains("far"));
  CHECK(warningsOf(makeMotion(scene)) == warningsOf(scene));
  // Frames out of files have no solids of the scene.
  const Scratch scratch;
  writeMesh(scratch.path / "water_1.ply", 1.0);
  scenes::Scene files = takenFrom(scratch.path);
  files.sim.solids = scene.sim.solids;
  CHECK(warningsOf(files).empty());
  CHECK(warningsOf(makeMotion(files)).empty());
  // What is found while they are read: a tetrahedron that is smaller than a cell encloses none.
  files.files.voxel = 2.0;
  Motion motion = makeMotion(files);
  nextFrame(motion);
  REQUIRE(warningsOf(motion).size() == 1);
  CHECK_THAT(warningsOf(motion)[0], Contains("encloses no volume"));
  const Scratch recorded;
  writePool(recorded.path, 1);
  CHECK(warningsOf(makeMotion(takenFrom(recorded.path))).empty());
}
