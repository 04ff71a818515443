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
  CHECK(render.light.sunDirection == sim::Vec3d(0, 0, 1));
  CHECK(render.light.sunColor == sim::Vec3d(1, 2, 3));
  CHECK(render.light.sunSize == 1.0);
  CHECK(render.light.skyColor == sim::Vec3d(0.1, 0.2, 0.3));
  CHECK(render.light.horizonColor == sim::Vec3d(0.4, 0.5, 0.6));
  CHECK(render.width == 320);
  CHECK(render.height == 180);
  CHECK(render.samples == 2);
  CHECK(render.bounces == 1);
  CHECK(render.gloss == 0.5);
  CHECK(render.roughness == 0.25);
  CHECK(render.bump.map == "bumps");
  CHECK(render.bump.height == 2.5);
  CHECK(render.exposure == 1.25);
  CHECK_FALSE(render.surroundings.ground);
  CHECK(render.surroundings.groundColor == sim::Vec3d(0.1));
  CHECK_FALSE(render.surroundings.tank);
  CHECK(render.surroundings.tankColor == sim::Vec3d(0.2));
}

TEST_CASE("scene: the resolved scene has every key, given or not", "[scenes]") {
  const std::string ball = "sphere = { center = [1, 1, 1], radius = 0.5 }\n";
  const std::string oneEach =
      "[heat]\nlaw = 'table'\npoint = [ { temperature = 1, viscosity = 1 }, { temperature = 2, viscosity = 1 "
      "} "
      "]\n"
      "[[solid]]\nmesh = { file = 'm.obj' }\nkeyframe = [ { time = 1 } ]\n[[solid]]\nmesh_sequence = { files "
      "= "
      "'m_%d.obj', last = 2 }\n[[source]]\n" +
      ball + "rate = [ { time = 0, factor = 1 } ]\n[[drain]]\n" + ball +
      "[[wall]]\n[texture.scale]\npoint = [ { value = 0, factor = 1 } ]\n"
      "[texture.guidance]\npoint = [ { value = 0, level = 1 } ]\n"
      "[[texture.map]]\nname = 'height'\nfile = 'e.png'\n";
  std::set<std::string> whole, defaults;
  collectKeys(Json::parse(sceneOf(kFullScene).resolved), "", whole);
  collectKeys(Json::parse(sceneOf(kGoodScene + oneEach).resolved), "", defaults);
  CHECK(whole.size() > 60);
  for (const std::string& key : whole) {
    INFO(key);
    const bool shape = key.find("union") != std::string::npos || key.find("sphere") != std::string::npos ||
                       key.find("cylinder") != std::string::npos ||
                       key.find("height_field") != std::string::npos;
    CHECK((shape || defaults.contains(key)));
  }
  for (const std::string& key : defaults) {
    INFO(key);
    CHECK((whole.contains(key) || key.find("sphere") != std::string::npos));
  }
}

TEST_CASE("scene: the resolved scene holds the values that are used", "[scenes]") {
  const Json full = Json::parse(sceneOf(kFullScene).resolved);
  CHECK(full["quality"] == "default");
  CHECK(full["domain"]["resolution"] == 48);
  CHECK(full["fluid"]["gravity"] == Json::array({1.0, 0.0, -3.0}));
  CHECK(full["liquid"][1]["union"][1]["difference"][1]["mesh"]["scale"] == 2.0);
  CHECK(full["solid"][0]["until"] == 0.75);
  CHECK(full["solid"][1]["until"].is_null());
  CHECK(full["texture"]["method"] == "kwatra07");
  CHECK(full["texture"]["points"] == 1234);
  CHECK(full["texture"]["spacing"].is_null());
  CHECK(full["render"]["size"] == Json::array({320, 180}));

  const Json spaced = Json::parse(sceneOf("texture.spacing = 0.1\n" + kGoodScene).resolved);
  CHECK(spaced["texture"]["spacing"] == 0.1);
  CHECK(spaced["texture"]["points"].is_null());
}

TEST_CASE("scene: the resolved scene says the same when it is read twice", "[scenes]") {
  const SceneFolder folder;
  const std::filesystem::path file = folder.write("s.toml", kFullScene);
  CHECK(loadScene(file).resolved == loadScene(file).resolved);
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

TEST_CASE("scene: the resolved scene is the same wherever the file is named from", "[scenes]") {
  const SceneFolder folder;
  const std::filesystem::path file = folder.write("s.toml", kFullScene),
                              before = std::filesystem::current_path();
  const std::string resolved = loadScene(file).resolved;
  std::filesystem::current_path(folder.path() / "pictures");
  Overrides exemplar;
  exemplar.exemplar = "../e.png";
  // Guidance, maps and their relief are of the scene's own exemplar, and left out with another.
  exemplar.set = {"texture.toroidal=true",
                  "texture.between=file",
                  "texture.between_file=../e.png",
                  "texture.guidance.by=field",
                  "texture.map=[{ name = 'height', file = '../e.png', holds = 'normals' }, "
                  "{ name = 'bumps', file = '../e.png', weight = 0.5 }]",
                  "render.bump.height=2.5"};
  const std::string relative = loadScene("../s.toml").resolved,
                    chosen = loadScene("../s.toml", exemplar).resolved;
  std::filesystem::current_path(before);
  CHECK(relative == resolved);
  CHECK(chosen == resolved);
}

TEST_CASE("scene: Windows line ends and a byte order mark do not matter", "[scenes]") {
  std::string text = "\xef\xbb\xbf";
  for (const char letter : kGoodScene) text += letter == '\n' ? std::string("\r\n") : std::string(1, letter);
  CHECK(faultsOf(text).empty());
}

}  // namespace fluidtex::scenes
