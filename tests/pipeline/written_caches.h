// Folders of frames, as other programs and this one write them.
#pragma once

#include "caches/recorded/recorded_frame.h"
#include "caches/recorded/recording.h"
#include "scenes/scene.h"
#include "sim/step/solver.h"

#include <openvdb/tools/LevelSetSphere.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

namespace fluidtex::pipeline {

using sim::Vec3d;

inline constexpr double kBallCell = 0.05, kBallRadius = 0.4;

// Balls at (1, 2, 3) that go a quarter of a metre a frame along x, and how hot they are.
inline void writeBalls(const std::filesystem::path& folder, int first, int last,
                       double radius = kBallRadius) {
  openvdb::initialize();
  for (int number = first; number <= last; ++number) {
    const Vec3d center(1.0 + 0.25 * (number - first), 2.0, 3.0);
    const auto ball = openvdb::tools::createLevelSetSphere<openvdb::FloatGrid>(
        float(radius), openvdb::Vec3f(center), float(kBallCell));
    ball->setName("surface");
    const auto cells = ball->evalActiveVoxelBoundingBox();
    const auto velocity = openvdb::Vec3SGrid::create(openvdb::Vec3f(0.0f));
    velocity->setName("vel");
    velocity->setTransform(ball->transformPtr());
    velocity->denseFill(cells, openvdb::Vec3f(6.0f, 0.0f, 0.0f));
    const auto heat = openvdb::FloatGrid::create(0.0f);
    heat->setName("temperature");
    heat->setTransform(ball->transformPtr());
    heat->denseFill(cells, 300.0f);
    openvdb::io::File((folder / ("water_" + std::to_string(number) + ".vdb")).string())
        .write({ball, velocity, heat});
  }
}

// A scene that leaves all to the files, as one without a scene file does.
inline scenes::Scene sceneIn(const std::filesystem::path& folder) {
  scenes::Scene scene;
  scene.files.path = folder;
  scene.frames = 0;
  scene.sim.size = Vec3d(0.0);
  scene.render.camera.from = scene.render.camera.at = Vec3d(std::numeric_limits<double>::quiet_NaN());
  return scene;
}

inline sim::Options pool() {
  sim::Options options;
  options.size = Vec3d(0.75, 0.5, 0.5);
  options.resolution = 12;
  options.sides[5] = sim::Side::open;
  options.liquid.push_back({.shape = {sim::Sphere{{0.3, 0.25, 0.25}, 0.15}}});
  return options;
}

inline void writePool(const std::filesystem::path& folder, int frames) {
  sim::Solver solver(pool());
  for (int frame = 1; frame <= frames; ++frame)
    caches::writeRecordedFrame(solver.next(), pool().voxelSize(), caches::recordedFrame(folder, frame));
  std::ofstream(folder / caches::kRecordingFile) << caches::recordingText(pool());
}

}  // namespace fluidtex::pipeline
