#include "pipeline/texture_frame.h"

#include "sim/motion/motion.h"
#include "tests/texture/exemplar/test_images.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>

using namespace fluidtex;

namespace {

constexpr int kPoints = 3000;

// A ball that turns about the middle of a cube of 1 m.
scenes::Scene turningBall() {
  scenes::Scene scene;
  scene.sim.resolution = 32;
  scene.sim.liquid.push_back({{sim::Sphere{{0.5, 0.5, 0.5}, 0.3}}});
  scene.motion.flow = sim::MotionKind::rotation;
  scene.texture.points = kPoints;
  scene.texture.synthesis.windows = {9, 5};
  return scene;
}

pipeline::Texturing texturing(const scenes::Scene& scene) {
  return pipeline::makeTexturing(
      scene, texture::makeExemplar(testing::blobImage(64, 64, 4, 12.0, 1), true, scene.texture.synthesis,
                                   scene.texture.surface.levels));
}

std::vector<pipeline::TexturedFrame> framesOf(const scenes::Scene& scene, int count) {
  pipeline::Texturing made = texturing(scene);
  sim::Motion motion = sim::makeMotion(scene.sim, scene.motion);
  texture::TexturedSurface last;
  std::vector<pipeline::TexturedFrame> frames;
  for (int i = 0; i < count; ++i) {
    frames.push_back(pipeline::textureFrame(made, last, sim::nextFrame(motion)));
    last = frames.back().surface;
  }
  return frames;
}

}  // namespace

TEST_CASE("texture_frame: a turning ball keeps its texture", "[pipeline]") {
  const auto frames = framesOf(turningBall(), 3);
  const texture::TexturedSurface& first = frames[0].surface;
  CHECK(frames[0].synthesis.renewed == 1.0);
  CHECK(double(first.positions.size()) == Approx(kPoints).epsilon(0.1));
  CHECK(first.previousPosition == first.positions);
  for (const pipeline::TexturedFrame& frame : {frames[1], frames[2]}) {
    const texture::TexturedSurface& surface = frame.surface;
    CHECK(surface.spacing == first.spacing);
    CHECK(frame.synthesis.renewed < 0.02);
    REQUIRE(frame.singularities);
    double turns = 0.0;
    for (const texture::Singularity& singularity : *frame.singularities) turns += singularity.turns;
    CHECK(turns == 2.0);  // the Euler characteristic of a sphere
    REQUIRE(surface.velocity.size() == surface.positions.size());
    const auto fastest =
        std::max_element(surface.velocity.begin(), surface.velocity.end(),
                         [](const auto& a, const auto& b) { return a.length() < b.length(); });
    CHECK(fastest->length() == Approx(0.3).epsilon(0.02));  // one radian a second at the equator
    // Each point came from where it was a frame ago, a 24th of a radian behind.
    for (std::size_t v = 0; v < surface.positions.size(); v += 97) {
      const openvdb::Vec3f moved = surface.positions[v] - surface.previousPosition[v];
      CHECK(moved.length() == Approx(surface.velocity[v].length() / 24.0).margin(0.1 * surface.spacing));
    }
  }
}

TEST_CASE("texture_frame: the same bytes on any number of threads", "[pipeline]") {
  const auto bytes = [](int threads) {
    return onThreads(threads, [] { return framesOf(turningBall(), 2).back().surface; });
  };
  const texture::TexturedSurface one = bytes(1), three = bytes(3);
  CHECK(one.positions == three.positions);
  CHECK(one.coordinate == three.coordinate);
  CHECK(one.color == three.color);
  CHECK(one.orientation == three.orientation);
}

TEST_CASE("texture_frame: tells its stages in order, and times them by the clock it is given", "[pipeline]") {
  const scenes::Scene scene = turningBall();
  pipeline::Texturing made = texturing(scene);
  sim::Motion motion = sim::makeMotion(scene.sim, scene.motion);
  std::vector<pipeline::Stage> stages;
  int asked = 0;
  pipeline::Watch watch;
  watch.progress = [&](pipeline::Stage stage, double) {
    if (stages.empty() || stages.back() != stage) stages.push_back(stage);
  };
  watch.seconds = [&] { return double(asked++); };
  const pipeline::TexturedFrame frame = pipeline::textureFrame(made, {}, sim::nextFrame(motion), watch);
  CHECK(stages == std::vector<pipeline::Stage>{pipeline::Stage::prepare, pipeline::Stage::transport,
                                               pipeline::Stage::synthesize});
  CHECK(frame.seconds.prepare == 2.0);
  CHECK(frame.seconds.transport == 2.0);
  CHECK(frame.seconds.synthesize == 1.0);
}

TEST_CASE("texture_frame: without a surface there is nothing to texture, and the spacing is kept",
          "[pipeline]") {
  scenes::Scene scene = turningBall();
  pipeline::Texturing made = texturing(scene);
  sim::Frame dry;
  dry.surfacePhi = openvdb::FloatGrid::create(0.1f);
  texture::TexturedSurface last;
  CHECK(pipeline::textureFrame(made, last, dry).surface.spacing == 0.0);
  last.spacing = 0.02;
  const pipeline::TexturedFrame frame = pipeline::textureFrame(made, last, dry);
  CHECK(frame.surface.empty());
  CHECK(frame.surface.spacing == 0.02);
  CHECK_FALSE(frame.singularities);
}

TEST_CASE("texture_frame: texture that is advected only is never renewed", "[pipeline]") {
  scenes::Scene scene = turningBall();
  scene.texture.laterFrames = texture::LaterFrames::advect;
  const auto frames = framesOf(scene, 2);
  CHECK(frames[0].synthesis.renewed == 1.0);
  CHECK(frames[1].synthesis.renewed == 0.0);
  CHECK(frames[1].surface.exemplarWidth == 64);
  CHECK(*std::min_element(frames[1].surface.age.begin(), frames[1].surface.age.end()) == Approx(1.0 / 24.0));
}
