#include "scenes/scene.h"

#include "tests/scenes/full_scene.h"

#include <catch2/catch.hpp>

namespace fluidtex::scenes {

TEST_CASE("scene: what is left out has the defaults of the options", "[scenes]") {
  const Scene scene = sceneOf(kGoodScene);
  CHECK(scene.name == "s");
  CHECK(scene.frames == 72);
  CHECK(scene.seed == 1);
  const sim::Options sim;
  CHECK(scene.sim.resolution == sim.resolution);
  CHECK(scene.sim.gravity == sim.gravity);
  CHECK(scene.sim.density == sim.density);
  CHECK(scene.sim.viscosity == sim.viscosity);
  CHECK(scene.sim.cfl == sim.cfl);
  CHECK(scene.sim.frameRate == sim.frameRate);
  CHECK(scene.sim.solids.empty());
  const texture::Options texture;
  CHECK(scene.texture.spacing == texture.spacing);
  CHECK(scene.texture.points == texture.points);
  CHECK(scene.texture.synthesis.windows == texture.synthesis.windows);
  CHECK(scene.texture.synthesis.firstIterations == texture.synthesis.firstIterations);
  CHECK(scene.texture.synthesis.laterIterations == texture.synthesis.laterIterations);
  CHECK(scene.texture.synthesis.method == texture.synthesis.method);
  CHECK(scene.texture.synthesis.softConstraint == texture.synthesis.softConstraint);
  CHECK(scene.texture.surface.levels == texture.surface.levels);
  const render::Options render;
  CHECK(scene.render.width == render.width);
  CHECK(scene.render.height == render.height);
  CHECK(scene.render.samples == render.samples);
  CHECK(scene.render.camera.fov == render.camera.fov);
}

TEST_CASE("scene: every key arrives where it belongs", "[scenes]") {
  const SceneFolder folder;
  const Scene scene = loadScene(folder.write("s.toml", kFullScene));
  CHECK(scene.name == "all of it");
  CHECK(scene.file == folder.path() / "s.toml");
  CHECK(scene.frames == 5);
  CHECK(scene.seed == 99);
  const sim::Options& sim = scene.sim;
  CHECK(sim.frameRate == 30.0);
  CHECK(sim.size == sim::Vec3d(3, 2, 1.5));
  CHECK(sim.resolution == 48);
  CHECK(sim.density == 900.0);
  CHECK(sim.viscosity == 0.5);
  CHECK(sim.surfaceTension == 0.07);
  CHECK(sim.gravity == sim::Vec3d(1, 0, -3));
  CHECK(sim.cfl == 1.5);
  CHECK(sim.wallOf(0).kind == sim::WallKind::noSlip);
  CHECK(sim.wallOf(0).velocity == sim::Vec3d(0, 1, 2));
  CHECK(sim.wallOf(1).kind == sim::WallKind::friction);
  CHECK(sim.wallOf(1).slipLength == 0.5);
  REQUIRE(sim.liquid.size() == 2);
  CHECK(std::get<sim::Box>(sim.liquid[0].shape.kind).min == sim::Vec3d(0, 0.5, 0));
  CHECK(std::get<sim::Box>(sim.liquid[0].shape.kind).max == sim::Vec3d(1, 1, 0.5));
  CHECK(sim.liquid[0].velocity == sim::Vec3d(1, 2, 3));
  CHECK(sim.liquid[0].from == 0.25);
  CHECK(sim.liquid[0].temperature == 1500.0);
  CHECK(sim.heat.simulated);
  CHECK(sim.heat.capacity == 1000.0);
  CHECK(sim.heat.conductivity == 2.0);
  CHECK(sim.heat.emissivity == 0.5);
  CHECK(sim.heat.ambient == 300.0);
  CHECK(sim.heat.wallTransfer == 10.0);
  CHECK(sim.heat.wallTemperature == 400.0);
  CHECK(sim.heat.law.kind == sim::ViscosityLaw::Kind::table);
  REQUIRE(sim.heat.law.points.size() == 2);
  CHECK(sim.heat.law.points[0].viscosity == 1e5);
  CHECK(sim.heat.law.points[1].temperature == 1400.0);
  CHECK(sim.heat.law.reference == 1300.0);
  CHECK(sim.heat.law.slope == 0.1);
  CHECK(sim.heat.law.activationEnergy == 150000.0);
  CHECK(sim.heat.law.solidus == 900.0);
  CHECK(sim.heat.law.solidViscosity == 5e5);
  const auto& both = std::get<sim::Union>(sim.liquid[1].shape.kind);
  REQUIRE(both.parts.size() == 2);
  CHECK(std::get<sim::Sphere>(both.parts[0].kind).radius == 0.5);
  const auto& rest = std::get<sim::Difference>(both.parts[1].kind);
  REQUIRE(rest.parts.size() == 2);
  CHECK(std::get<sim::HalfSpace>(rest.parts[0].kind).normal == sim::Vec3d(0, 0, 2));
  const auto& mesh = std::get<sim::MeshShape>(rest.parts[1].kind);
  CHECK(mesh.file == folder.path() / "m.obj");
  CHECK(mesh.place.up == sim::UpAxis::y);
  CHECK(mesh.place.rotate == sim::Vec3d(0, 0, 45));
  CHECK(mesh.place.scale == 2.0);
  CHECK(mesh.place.translate == sim::Vec3d(3, 2, 1));
  REQUIRE(sim.solids.size() == 3);
  CHECK(sim.solids[0].name == "gate");
  CHECK(sim.solids[0].from == 0.5);
  CHECK(sim.solids[0].until == 0.75);
  CHECK(sim.solids[0].wall.kind == sim::WallKind::friction);
  CHECK(sim.solids[0].wall.slipLength == 0.25);
  CHECK(sim.solids[0].wall.velocity == sim::Vec3d(1, 0, 0));
  CHECK_FALSE(sim.solids[0].visible);
  CHECK(sim.solids[0].color == sim::Vec3d(1, 0.25, 0));
  CHECK(sim.solids[1].until == sim::kForever);
  CHECK(sim.solids[1].pivot == sim::Vec3d(1, 2, 3));
  CHECK(sim.solids[1].axis == sim::Vec3d(1, 0, 0));
  REQUIRE(sim.solids[1].keyframes.size() == 2);
  CHECK(sim.solids[1].keyframes[0].time == 0.5);
  CHECK(sim.solids[1].keyframes[1].move == sim::Vec3d(0, 0, 1));
  CHECK(sim.solids[1].keyframes[1].turn == 720.0);
  const auto& sequence = std::get<sim::MeshSequence>(sim.solids[2].shape.kind);
  CHECK(sequence.fileOf(1) == folder.path() / "m_1.obj");
  CHECK(sequence.count() == 3);
  CHECK(sequence.frameRate == 12.0);
  CHECK(sequence.start == 0.5);
  CHECK(sequence.place.scale == 3.0);
  CHECK(sequence.place.translate == sim::Vec3d(1, 0, 2));
  using sim::Side;
  CHECK(sim.sides ==
        std::array<Side, 6>{Side::stream, Side::open, Side::open, Side::stream, Side::open, Side::stream});
  REQUIRE(sim.sources.size() == 1);
  const auto& cylinder = std::get<sim::Cylinder>(sim.sources[0].shape.kind);
  CHECK(cylinder.from == sim::Vec3d(0, 0, 1));
  CHECK(cylinder.to == sim::Vec3d(1, 0, 1));
  CHECK(cylinder.radius == 0.25);
  CHECK(sim.sources[0].velocity == sim::Vec3d(1, 0, 0));
  CHECK(sim.sources[0].temperature == 1400.0);
  CHECK(sim.sources[0].from == 0.5);
  CHECK(sim.sources[0].until == 8.0);
  REQUIRE(sim.sources[0].rate.size() == 2);
  CHECK(sim.sources[0].rate[1].time == 2.0);
  CHECK(sim.sources[0].rate[1].factor == 1.5);
  REQUIRE(sim.drains.size() == 1);
  const auto& ground = std::get<sim::HeightField>(sim.drains[0].shape.kind);
  CHECK(ground.file == folder.path() / "e.png");
  CHECK(ground.pixel == 0.5);
  CHECK(ground.low == -1.0);
  CHECK(ground.high == 2.0);
  CHECK(ground.translate == sim::Vec3d(0, 1, 2));
  CHECK(sim.drains[0].from == 1.0);
  CHECK(sim.drains[0].until == 2.0);
  const texture::Options& texture = scene.texture;
  CHECK(texture.exemplar.file == folder.path() / "e.png");
  CHECK(texture.exemplar.toroidal);
  CHECK(texture.points == 1234);
  CHECK(texture.spacing == 0.0);
  CHECK(texture.synthesis.method == texture::Method::kwatra07);
  CHECK(texture.synthesis.windows == std::vector<int>{21, 11});
  CHECK(texture.synthesis.firstIterations == std::vector<int>{7, 8});
  CHECK(texture.synthesis.laterIterations == std::vector<int>{0, 2});
  CHECK(texture.synthesis.robustExponent == 1.5);
  CHECK(texture.synthesis.softConstraint == 0.7);
  CHECK(texture.synthesis.histogram == 1.0);
  CHECK(texture.synthesis.usage == 2.0);
  CHECK(texture.synthesis.core == 0.9);
  CHECK(texture.synthesis.featureWeight == 0.4);
  CHECK(texture.synthesis.gradientWeight == 0.6);
  CHECK(texture.synthesis.keepStretch == 2.0);
  CHECK(texture.synthesis.renewalRadius == 20.0);
  CHECK(texture.synthesis.renewalRate == 5.0);
  CHECK(texture.synthesis.lookAhead == 0.125);
  CHECK(texture.synthesis.fade == 0.25);
  CHECK(texture.synthesis.seed == 99);
  CHECK(texture.surface.seed == 99);
  CHECK(texture.surface.points == texture::Points::random);
  CHECK(texture.surface.levels == 4);
  CHECK(texture.surface.repulsionSweeps == 12);
  CHECK(texture.laterFrames == texture::LaterFrames::advect);
  CHECK(scene.transport.method == transport::Method::grid);
  CHECK(scene.transport.orientation == transport::Turning::scalars);
  const texture::FactorOptions& renewal = scene.texture.renewal;
  CHECK(renewal.by == texture::FactorBy::distance);
  REQUIRE(renewal.points.size() == 2);
  CHECK((renewal.points[1].value == 0.5 && renewal.points[1].result == 4.0));
  CHECK(scene.renewalFrom.size() == 1);
  CHECK(scene.start.mesh.file == folder.path() / "m.obj");
  const sim::MeshPlace& start = scene.start.mesh.place;
  CHECK(start.up == sim::UpAxis::y);
  CHECK(start.rotate == Vec3d(4, 5, 6));
  CHECK(start.scale == 0.5);
  CHECK(start.translate == Vec3d(3, 2, 1));
  CHECK(scene.texture.restFrames == 12);
  CHECK_FALSE(scene.start.renew);
  CHECK(scene.onto.files.filename() == "t_%d.obj");
  CHECK(scene.onto.first == 0);
  CHECK(scene.onto.last == 4);
  CHECK(scene.onto.place.scale == 2.0);
  CHECK(scene.onto.place.translate == sim::Vec3d(1, 2, 3));
  const render::Options& render = scene.render;
  CHECK(render.camera.from == sim::Vec3d(9, 8, 7));
  CHECK(render.camera.at == sim::Vec3d(1, 2, 3));
  CHECK(render.camera.fov == 50.0);
  CHECK(render.camera.turn == -90.0);
  CHECK(render.camera.aperture == 0.01);
  CHECK(render.camera.focus == 2.0);
  CHECK(render.camera.shutter == 0.5);
  CHECK(render.light.sunDirection == sim::Vec3d(0, 0, 1));
  CHECK(render.light.sunColor == sim::Vec3d(1, 2, 3));
  CHECK(render.light.sunSize == 1.0);
  CHECK(render.light.skyColor == sim::Vec3d(0.1, 0.2, 0.3));
  CHECK(render.light.horizonColor == sim::Vec3d(0.4, 0.5, 0.6));
  CHECK(render.width == 320);
  CHECK(render.height == 180);
  CHECK(render.samples == 2);
  CHECK(render.noise == 0.01);
  CHECK_FALSE(render.smooth);
  CHECK(render.bounces == 1);
  CHECK(render.gloss == 0.5);
  CHECK(render.roughness == 0.25);
  CHECK(render.material.kind == render::MaterialKind::lava);
  CHECK(render.material.index == 1.4);
  CHECK(render.material.absorption == sim::Vec3d(3, 2, 1));
  CHECK(render.material.cover == 0.5);
  CHECK(render.material.heat == "bumps");
  CHECK(render.material.coldest == 700.0);
  CHECK(render.material.hottest == 1500.0);
  CHECK(render.material.glow == 2.0);
  CHECK(render.displacement.map == "bumps");
  CHECK(render.displacement.height == 1.5);
  CHECK(render.bump.map == "bumps");
  CHECK(render.bump.height == 2.5);
  CHECK(render.exposure == 1.25);
  CHECK_FALSE(render.surroundings.ground);
  CHECK(render.surroundings.groundColor == sim::Vec3d(0.1));
  CHECK_FALSE(render.surroundings.tank);
  CHECK(render.surroundings.tankColor == sim::Vec3d(0.2));
}

TEST_CASE("scene: files are found from the scene's folder, wherever it is read from", "[scenes]") {
  const SceneFolder folder;
  folder.write("pictures/p.png", "");
  std::string text = kGoodScene;
  text.replace(text.find("e.png"), 5, "../pictures/p.png");
  std::filesystem::create_directories(folder.path() / "scenes");
  const std::filesystem::path file = folder.write("scenes/s.toml", text);
  const std::filesystem::path before = std::filesystem::current_path();
  CHECK(loadScene(file).texture.exemplar.file == folder.path() / "pictures" / "p.png");
  std::filesystem::current_path(folder.path());
  const Scene fromAbove = loadScene("scenes/s.toml");
  std::filesystem::current_path(folder.path() / "scenes");
  const Scene fromBeside = loadScene("s.toml");
  std::filesystem::current_path(before);
  CHECK(fromAbove.texture.exemplar.file == "pictures/p.png");
  CHECK(fromBeside.texture.exemplar.file == "../pictures/p.png");

  text.replace(text.find("../pictures/p.png"), 17, (folder.path() / "e.png").string());
  CHECK(loadScene(folder.write("absolute.toml", text)).texture.exemplar.file == folder.path() / "e.png");
}

TEST_CASE("scene: another exemplar is not taken to wrap because the scene's own does", "[scenes]") {
  const SceneFolder folder;
  const std::filesystem::path file = folder.write("s.toml", kFullScene);
  Overrides overrides;
  overrides.exemplar = folder.path() / "e.png";
  CHECK(loadScene(file).texture.exemplar.toroidal);
  CHECK_FALSE(loadScene(file, overrides).texture.exemplar.toroidal);
  overrides.set = {"texture.toroidal=true"};
  CHECK(loadScene(file, overrides).texture.exemplar.toroidal);
}

TEST_CASE("scene: another exemplar is guided if it is given a map of its own", "[scenes]") {
  const SceneFolder folder;
  const std::filesystem::path file = folder.write("s.toml", kFullScene);
  Overrides overrides;
  REQUIRE(loadScene(file).texture.guidance.by != texture::GuidanceBy::none);
  overrides.exemplar = folder.path() / "e.png";
  CHECK(loadScene(file, overrides).texture.guidance.by == texture::GuidanceBy::none);
  overrides.set = {"texture.guidance.map=" + (folder.path() / "e.png").string()};
  const Scene guided = loadScene(file, overrides);
  CHECK(guided.texture.guidance.by == loadScene(file).texture.guidance.by);
  CHECK(guided.texture.exemplar.guidance == folder.path() / "e.png");
}

TEST_CASE("scene: Windows line ends and a byte order mark do not matter", "[scenes]") {
  std::string text = "\xef\xbb\xbf";
  for (const char letter : kGoodScene) text += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
  CHECK(faultsOf(text).empty());
}

TEST_CASE("scene faults: all of a file, in the order of its lines", "[scenes]") {
  const std::string text =
      "frames = 0\n"
      "[texture]\n"
      "exemplar = 'none.png'\n"
      "windows = [8, 9]\n"
      "[render]\n"
      "sampels = 3\n"
      "samples = 'x'\n"
      "[[liquid]]\n"
      "velocity = [1, 2]\n"
      "[[liquid]]\n"
      "box = { min = [0, 0, 0], max = [1, 1, 0] }\n"
      "[quality.final]\n"
      "domain.resolution = 1\n"
      "[domain]\n"
      "size = [1, -1, 1]\n";
  Overrides overrides;
  overrides.set = {"camera.fov=0"};
  const std::vector<std::string> starts = {
      "s.toml:1:1: error: frames: ",
      "s.toml:3:1: error: texture.exemplar: ",
      "s.toml:4:1: error: texture.windows: 8 is even",
      "s.toml:4:1: error: texture.windows: 9 after 8",
      "s.toml:6:1: error: render.sampels: ",
      "s.toml:7:1: error: render.samples: ",
      "s.toml:8:1: error: liquid.0: no shape",
      "s.toml:9:1: error: liquid.0.velocity: ",
      "s.toml:11:26: error: liquid.1.box.max: ",
      "s.toml:13:8: error: quality.final.domain.resolution: ",
      "s.toml:15:1: error: domain.size: ",
      "--set camera.fov=0: error: camera.fov: ",
  };
  const std::vector<std::string> faults = faultsOf(text, overrides);
  REQUIRE(faults.size() == starts.size());
  for (std::size_t i = 0; i < starts.size(); ++i) CHECK_THAT(faults[i], Catch::StartsWith(starts[i]));
}

}  // namespace fluidtex::scenes
