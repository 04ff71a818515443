#include "scenes/complete.h"

#include "tests/scenes/full_scene.h"

#include <catch2/catch.hpp>

#include <cmath>

namespace fluidtex::scenes {

TEST_CASE("scene: defaults that follow from other keys", "[scenes]") {
  const Scene scene = sceneOf("seed = 7\ntexture.windows = [9]\n" + kGoodScene +
                              "[[solid]]\nmesh = { file = 'm.obj' }\n[[solid]]\nmesh = { file = 'm.obj' }");
  CHECK(scene.sim.seed == 7);
  CHECK(scene.texture.surface.seed == 7);
  CHECK(scene.texture.synthesis.seed == 7);
  CHECK(scene.texture.synthesis.firstIterations == std::vector<int>{4});
  CHECK(scene.texture.synthesis.laterIterations == std::vector<int>{3});
  CHECK(scene.sim.solids[0].name == "solid 0");
  CHECK(scene.sim.solids[1].name == "solid 1");
  CHECK(scene.sim.solids[1].until == sim::kForever);
  const render::Camera view;  // of a domain of 1 m; this one is 2 x 1 x 1 m
  CHECK(scene.render.camera.at == view.at * sim::Vec3d(2, 1, 1));
  CHECK(scene.render.camera.from == scene.render.camera.at + 2.0 * (view.from - view.at));

  const Scene more = sceneOf("texture.windows = [33, 17, 9, 5]\n" + kGoodScene);
  CHECK(more.texture.synthesis.firstIterations == std::vector<int>{4, 4, 5, 5});
}

TEST_CASE("complete: coherence sets what is kept, renewed and faded, where that is not given", "[scenes]") {
  const texture::SynthesisOptions usual;
  const auto with = [](const std::string& texture) { return sceneOf(texture + kGoodScene).texture; };
  const texture::Options half = with("texture.coherence = 0.5\n");
  CHECK(half.synthesis.keepStretch == usual.keepStretch);
  CHECK(half.synthesis.renewalRate == usual.renewalRate);
  CHECK(half.synthesis.fade == usual.fade);
  CHECK(half.laterFrames == texture::Options{}.laterFrames);
  // Three times as much, and a third.
  const texture::Options more = with("texture.coherence = 0.75\n"), less = with("texture.coherence = 0.25\n");
  CHECK(more.synthesis.keepStretch == Approx(std::pow(usual.keepStretch, 3.0)));
  CHECK(more.synthesis.renewalRate == Approx(usual.renewalRate / 3.0));
  CHECK(more.synthesis.fade == 2.0);  // the longest
  CHECK(less.synthesis.keepStretch == Approx(std::cbrt(usual.keepStretch)));
  CHECK(less.synthesis.renewalRate == Approx(usual.renewalRate * 3.0));
  CHECK(less.synthesis.fade == Approx(usual.fade / 3.0));
  CHECK(less.laterFrames == texture::Options{}.laterFrames);
  // All of it keeps until it is torn; none is each frame alone.
  const texture::Options all = with("texture.coherence = 1\n"), none = with("texture.coherence = 0\n");
  CHECK(all.synthesis.keepStretch == 8.0);
  CHECK(all.synthesis.fade == 2.0);
  CHECK(none.laterFrames == texture::LaterFrames::alone);
  const texture::Options given = with(
      "texture.coherence = 0\ntexture.keep_stretch = 3\ntexture.renewal_rate = 4\ntexture.fade = 5\n"
      "texture.later_frames = 'advect'\n");
  CHECK(given.synthesis.keepStretch == 3.0);
  CHECK(given.synthesis.renewalRate == 4.0);
  CHECK(given.synthesis.fade == 5.0);
  CHECK(given.laterFrames == texture::LaterFrames::advect);
}

TEST_CASE("complete: iterations that are given are as many as they are", "[scenes]") {
  const Scene scene = sceneOf("texture.windows = [9]\ntexture.first_iterations = [8]\n" + kGoodScene);
  CHECK(scene.texture.synthesis.firstIterations == std::vector<int>{8});
  CHECK(scene.texture.synthesis.laterIterations == std::vector<int>{3});
}

TEST_CASE("complete: files of a mesh follow each other as frames do, unless they have a rate", "[scenes]") {
  const auto rateOf = [](const std::string& rate) {
    const Scene scene = sceneOf("frame_rate = 30\nframes = 5\n" + kGoodScene +
                                "[[solid]]\nmesh_sequence = { files = 'm_%d.obj', last = 2" + rate +
                                " }\n[texture.onto]\nfiles = 't_%d.obj'\nfirst = 0\n");
    CHECK(scene.onto.first == 0);
    CHECK(scene.onto.last == 4);  // one a frame
    return std::get<sim::MeshSequence>(scene.sim.solids[0].shape.kind).frameRate;
  };
  CHECK(rateOf("") == 30.0);
  CHECK(rateOf(", frame_rate = 24") == 24.0);
}

TEST_CASE("complete: no ground is below an unbounded domain, and no rim around it", "[scenes]") {
  const auto around = [](const std::string& text) { return sceneOf(kGoodScene + text).render.surroundings; };
  CHECK(around("").ground);
  CHECK(around("").tank);
  for (const char* side : {"x_low", "x_high", "y_low", "y_high", "z_low", "z_high"}) {
    const std::string sides = "[domain.sides]\n" + std::string(side) + " = 'unbounded'\n";
    CHECK(around(sides).ground == (std::string(side) != "z_low"));
    CHECK_FALSE(around(sides).tank);
    CHECK(around(sides + "[render]\nground = true\ntank = true").ground);
    CHECK(around(sides + "[render]\nground = true\ntank = true").tank);
  }
  CHECK(around("[domain.sides]\nz_low = 'open'\n").tank);
}

TEST_CASE("complete: the view keeps what is given of it", "[scenes]") {
  const render::Camera view;
  const auto cameraOf = [](const std::string& camera) {
    return sceneOf(kGoodScene + "[camera]\n" + camera).render.camera;
  };
  // From where it stands by default, seen from the place that it looks at.
  const render::Camera at = cameraOf("at = [5, 6, 7]"), from = cameraOf("from = [5, 6, 7]");
  CHECK(at.at == sim::Vec3d(5, 6, 7));
  CHECK(at.from == sim::Vec3d(5, 6, 7) + 2.0 * (view.from - view.at));
  CHECK(from.from == sim::Vec3d(5, 6, 7));
  CHECK(from.at == view.at * sim::Vec3d(2, 1, 1));
}

TEST_CASE("complete: what files say is left open, unless it is given", "[scenes]") {
  Overrides overrides;
  overrides.liquidOnly = true;
  const Scene open = sceneOfCache("/nowhere/water_####.vdb", overrides);
  CHECK(open.frames == 0);
  CHECK(open.sim.size == sim::Vec3d(0.0));
  for (const sim::Side side : open.sim.sides) CHECK(side == sim::Side::unbounded);
  for (int axis = 0; axis < 3; ++axis) {
    CHECK(std::isnan(open.render.camera.at[axis]));
    CHECK(std::isnan(open.render.camera.from[axis]));
  }
  CHECK(open.render.surroundings.ground);

  overrides.set = {"frames=5", "domain.size=[4, 2, 2]", "domain.sides.x_low=open", "camera.at=[1, 2, 3]"};
  const Scene given = sceneOfCache("/nowhere/water_####.vdb", overrides);
  CHECK(given.frames == 5);
  CHECK(given.sim.size == sim::Vec3d(4, 2, 2));
  CHECK(given.sim.sides[0] == sim::Side::open);
  CHECK(given.sim.sides[1] == sim::Side::wall);
  const render::Camera view;
  CHECK(given.render.camera.at == sim::Vec3d(1, 2, 3));
  CHECK(given.render.camera.from == sim::Vec3d(1, 2, 3) + 4.0 * (view.from - view.at));
}

}  // namespace fluidtex::scenes
