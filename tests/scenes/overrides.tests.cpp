#include "tests/scenes/scene_file.h"

#include <catch2/catch.hpp>

namespace fluidtex::scenes {

namespace {

Scene sceneOf(const std::string& text, const Overrides& overrides = {}) {
  const SceneFolder folder;
  return loadScene(folder.write("s.toml", text), overrides);
}

Overrides setting(const std::vector<std::string>& set, Quality quality = Quality::standard) {
  Overrides overrides;
  overrides.set = set;
  overrides.quality = quality;
  return overrides;
}

std::vector<std::string> faultsOfSetting(const std::string& assignment) {
  return faultsOf(kGoodScene, setting({assignment}));
}

Overrides only(Quality quality) {
  return setting({}, quality);
}

}  // namespace

TEST_CASE("quality: dotted keys, nested tables and quoted keys say the same", "[scenes]") {
  for (const std::string preview :
       {"[quality.preview]\ndomain.resolution = 40\ntexture.surface.levels = 2",
        "[quality]\npreview.domain.resolution = 40\npreview.texture.surface.levels = 2",
        "[quality.preview]\n'domain.resolution' = 40\n'texture.surface.levels' = 2",
        "[quality.preview.domain]\nresolution = 40\n[quality.preview.texture]\n'surface.levels' = 2",
        "[quality.preview.domain]\nresolution = 40\n[quality.preview.texture.surface]\nlevels = 2"}) {
    INFO(preview);
    const Scene scene = sceneOf(kGoodScene + preview, only(Quality::preview));
    CHECK(scene.sim.resolution == 40);
    CHECK(scene.texture.surface.levels == 2);
    CHECK(scene.sim.size == sim::Vec3d(2, 1, 1));  // the rest of the table stays
    CHECK(sceneOf(kGoodScene + preview, only(Quality::standard)).sim.resolution == 64);
    CHECK(sceneOf(kGoodScene + preview, only(Quality::final)).sim.resolution == 64);
  }
}

TEST_CASE("quality: members of a list by number, or the whole list", "[scenes]") {
  const Scene one =
      sceneOf(kGoodScene + "[quality.final]\nliquid.0.velocity = [1, 2, 3]", only(Quality::final));
  REQUIRE(one.sim.liquid.size() == 1);
  CHECK(one.sim.liquid[0].velocity == sim::Vec3d(1, 2, 3));
  CHECK(std::get<sim::Box>(one.sim.liquid[0].shape.kind).max == sim::Vec3d(1, 1, 0.5));

  const Scene whole = sceneOf(kGoodScene +
                                  "[[quality.final.liquid]]\nsphere = { center = [1, 0, 0], radius = 0.5 }\n"
                                  "[[quality.final.liquid]]\nsphere = { center = [0, 0, 0], radius = 0.5 }",
                              only(Quality::final));
  REQUIRE(whole.sim.liquid.size() == 2);
  CHECK(std::get<sim::Sphere>(whole.sim.liquid[0].shape.kind).radius == 0.5);

  CHECK(faultsOf(kGoodScene + "[quality.final]\nliquid.1.velocity = [1, 2, 3]") ==
        std::vector<std::string>{
            "s.toml:7:8: error: quality.final.liquid.1: no such member; the list's members are liquid.0"});
}

TEST_CASE("quality: checked although another one is asked for", "[scenes]") {
  for (const Quality quality : {Quality::preview, Quality::standard, Quality::final}) {
    CHECK(faultsOf(kGoodScene + "[quality.preview]\nrender.samples = 0\n[quality.final]\nrender.size = 'big'",
                   only(quality)) ==
          std::vector<std::string>{"s.toml:7:8: error: quality.preview.render.samples: 0 is too small; give "
                                   "a whole number from 1 to 65536",
                                   "s.toml:9:8: error: quality.final.render.size: wrong type, a string where "
                                   "a list of 2 whole numbers is wanted; "
                                   "write for example size = [960, 540]"});
  }
}

TEST_CASE("quality: a fault it brings to the rest of the file names it", "[scenes]") {
  CHECK(faultsOf(
            kGoodScene +
            "[[liquid]]\nbox = { min = [1.5, 0, 0], max = [2, 1, 1] }\n[quality.preview]\ndomain.size = [1, "
            "1, 1]") ==
        std::vector<std::string>{
            "s.toml:6:1: error: liquid.1: lies wholly outside the domain; put at least a part of it "
            "between [0, 0, 0] and [1, 1, 1] (in quality preview)"});
}

TEST_CASE("quality: the same key twice in two spellings", "[scenes]") {
  CHECK(
      faultsOf(kGoodScene + "[quality.final]\nframes = 3\nrender.samples = 3\n'render.samples' = 4").size() ==
      1);
}

TEST_CASE("quality: exclusive keys take each other's place", "[scenes]") {
  const std::string text =
      "texture.points = 500\n" + kGoodScene +
      "[quality.preview]\ntexture.spacing = 0.1\nliquid.0.sphere = { center = [0, 0, 0], radius = 1 }";
  const Scene preview = sceneOf(text, only(Quality::preview));
  CHECK(preview.texture.spacing == 0.1);
  CHECK(std::holds_alternative<sim::Sphere>(preview.sim.liquid[0].shape.kind));
  const Scene standard = sceneOf(text);
  CHECK(standard.texture.spacing == 0.0);
  CHECK(standard.texture.points == 500);
}

TEST_CASE("overrides: --set: values as in TOML, bare words as strings", "[scenes]") {
  const Scene scene =
      sceneOf(kGoodScene + "[quality.final]\ndomain.resolution = 100",
              setting({"domain.resolution=32", "fluid.gravity=[0, 0, -1.6]", "texture.method=kwatra07",
                       "name=\"a b\"", "render.tank=false", "texture.surface = { points = 'random' }",
                       "simulation.cfl=2", "liquid.0.velocity=[0,0,-2]", "liquid.0.box.max.2=0.25",
                       "frames=3", "frames=4"},
                      Quality::final));
  CHECK(scene.sim.resolution == 32);  // the command line comes after the quality
  CHECK(scene.sim.gravity == sim::Vec3d(0, 0, -1.6));
  CHECK(scene.texture.synthesis.method == texture::Method::kwatra07);
  CHECK(scene.name == "a b");
  CHECK_FALSE(scene.render.surroundings.tank);
  CHECK(scene.texture.surface.points == texture::Points::random);
  CHECK(scene.sim.cfl == 2.0);
  CHECK(scene.sim.liquid[0].velocity == sim::Vec3d(0, 0, -2));
  CHECK(std::get<sim::Box>(scene.sim.liquid[0].shape.kind).max == sim::Vec3d(1, 1, 0.25));
  CHECK(std::get<sim::Box>(scene.sim.liquid[0].shape.kind).min == sim::Vec3d(0, 0, 0));
  CHECK(scene.frames == 4);  // the later one holds
}

TEST_CASE("overrides: --set: a shape or a spacing displaces what the file says", "[scenes]") {
  const Scene scene = sceneOf(
      "texture.points = 500\n" + kGoodScene,
      setting({"texture.spacing=0.02", "liquid.0.half_space={ point = [0, 0, 0.3], normal = [0, 0, 1] }"}));
  CHECK(scene.texture.spacing == 0.02);
  CHECK(std::get<sim::HalfSpace>(scene.sim.liquid[0].shape.kind).point == sim::Vec3d(0, 0, 0.3));
}

TEST_CASE("overrides: --set: faults are told at the option", "[scenes]") {
  using Faulty = std::vector<std::string>;
  CHECK(
      faultsOfSetting("texture.windwos=3") ==
      Faulty{"--set texture.windwos=3: error: texture.windwos: unknown key; did you mean texture.windows?"});
  const Faulty strange = faultsOfSetting("texture.xylophone=3");
  REQUIRE(strange.size() == 1);
  const std::size_t points = strange[0].find(" points");  // asked for on two ways, told once
  REQUIRE(points != std::string::npos);
  CHECK(strange[0].find(" points", points + 1) == std::string::npos);
  CHECK(faultsOfSetting("frames=many") == Faulty{"--set frames=many: error: frames: wrong type, a string "
                                                 "where a whole number is wanted; write for example "
                                                 "frames = 72"});
  CHECK(faultsOfSetting("frames=0") ==
        Faulty{"--set frames=0: error: frames: 0 is too small; give a whole number from 1 to 9999"});
  CHECK(faultsOfSetting("liquid.3.velocity=[0,0,0]") ==
        Faulty{"--set liquid.3.velocity=[0,0,0]: error: liquid.3: no such member; the list's members are "
               "liquid.0"});
  CHECK(
      faultsOfSetting("liquid.first.from=1") ==
      Faulty{
          "--set liquid.first.from=1: error: liquid.first: no such member; the list's members are liquid.0"});
  CHECK(faultsOfSetting("liquid.0.box.max.1=-1") ==
        Faulty{"s.toml:5:26: error: liquid.0.box.max: y is -1, not above min's 0; give a max that is greater "
               "than min in x, y "
               "and z"});
  CHECK(faultsOfSetting("domain.size.0=-1") ==
        Faulty{"--set domain.size.0=-1: error: domain.size: -1 is negative; give a number above 0"});
  CHECK(faultsOfSetting("frames") == Faulty{"--set frames: error: --set: not of the form KEY=VALUE; write "
                                            "for example --set domain.resolution=64"});
  CHECK(
      faultsOfSetting("=3") ==
      Faulty{
          "--set =3: error: --set: not of the form KEY=VALUE; write for example --set domain.resolution=64"});
  CHECK(faultsOfSetting("domain..size=3") ==
        Faulty{"--set domain..size=3: error: --set: not of the form KEY=VALUE; write for example --set "
               "domain.resolution=64"});
  CHECK(faultsOfSetting("frames=") ==
        Faulty{"--set frames=: error: frames: no value; write KEY=VALUE; an empty string is \"\""});
  CHECK(faultsOfSetting("frames=3\nseed=4") ==
        Faulty{"--set frames=3 seed=4: error: frames: more than one value; give one --set for each key"});
  CHECK(faultsOfSetting("quality.preview.frames=3") ==
        Faulty{"--set quality.preview.frames=3: error: quality: cannot be set from here; set the key itself, "
               "for example "
               "domain.resolution"});
  const Faulty broken = faultsOfSetting("fluid.gravity=[0, 0");
  REQUIRE(broken.size() == 1);
  CHECK_THAT(broken[0], Catch::StartsWith("--set fluid.gravity=[0, 0: error: fluid.gravity: "));
}

TEST_CASE("overrides: --set: a fault of the file that it mends is gone", "[scenes]") {
  CHECK(faultsOf("frames = 0\n" + kGoodScene).size() == 1);
  CHECK(faultsOf("frames = 0\n" + kGoodScene, setting({"frames=1"})).empty());
}

TEST_CASE("overrides: --exemplar: taken instead of the scene's, relative to the current folder", "[scenes]") {
  const SceneFolder folder;
  Overrides overrides;
  overrides.exemplar = folder.path() / "m.obj";
  const Scene scene = loadScene(folder.write("s.toml", kGoodScene), overrides);
  CHECK(scene.texture.exemplar.file == folder.path() / "m.obj");

  // The scene's own is not even looked for.
  std::string missing = kGoodScene;
  missing.replace(missing.find("e.png"), 5, "x.png");
  CHECK(loadScene(folder.write("missing.toml", missing), overrides).texture.exemplar.file ==
        folder.path() / "m.obj");

  // Its relief was of the scene's own too.
  const std::string bumped =
      kGoodScene + "[[texture.map]]\nname = 'height'\nfile = 'e.png'\n[render.bump]\nmap = 'height'\n";
  CHECK(loadScene(folder.write("bumped.toml", bumped)).render.bump.any());
  CHECK_FALSE(loadScene(folder.write("bumped.toml", bumped), overrides).render.bump.any());

  overrides.exemplar = "no_such_folder/none.png";
  CHECK(faultsOf(kGoodScene, overrides) ==
        std::vector<std::string>{
            "--exemplar no_such_folder/none.png: error: texture.exemplar: no such file: "
            "no_such_folder/none.png; give an existing file, relative to the current folder"});
}

}  // namespace fluidtex::scenes
