// Every fault a scene can have, one by one: place, key, what is wrong, what would be right.
#include "tests/scenes/scene_file.h"

#include <catch2/catch.hpp>

namespace fluidtex::scenes {

namespace {

struct Case {
  std::string text;   // after the five lines of kGoodScene
  std::string fault;  // the only one
};

void checkCases(const std::vector<Case>& cases) {
  for (const Case& wrong : cases) {
    INFO(wrong.text);
    CHECK(faultsOf(kGoodScene + wrong.text) == std::vector<std::string>{wrong.fault});
  }
}

void checkWholeFiles(const std::vector<Case>& cases) {
  for (const Case& wrong : cases) {
    INFO(wrong.text);
    CHECK(faultsOf(wrong.text) == std::vector<std::string>{wrong.fault});
  }
}

}  // namespace

TEST_CASE("scene: the one that the faults are put into has none", "[scenes]") {
  CHECK(faultsOf(kGoodScene).empty());
}

TEST_CASE("scene faults: wrong type", "[scenes]") {
  checkCases({
      {"[simulation]\ncfl = 'three'",
       "s.toml:7:1: error: simulation.cfl: wrong type, a string where a number is wanted; write for example "
       "cfl = 3"},
      {"[render]\nsamples = 4.0",
       "s.toml:7:1: error: render.samples: wrong type, a decimal number where a whole number is wanted; "
       "write for example "
       "samples = 16"},
      {"[render]\nsamples = true",
       "s.toml:7:1: error: render.samples: wrong type, true where a whole number is wanted; write for "
       "example samples = 16"},
      {"[render]\nground = 1",
       "s.toml:7:1: error: render.ground: wrong type, a whole number where true or false is wanted; write "
       "for example "
       "ground = true"},
      {"[render]\nsize = 960",
       "s.toml:7:1: error: render.size: wrong type, a whole number where a list of 2 whole numbers is "
       "wanted; write for "
       "example size = [960, 540]"},
      {"[render]\nsize = [960]",
       "s.toml:7:1: error: render.size: a list of 1 where width and height are wanted; write for example "
       "size = [960, 540]"},
      {"[render]\nsize = [960, 'x']",
       "s.toml:7:1: error: render.size: wrong type, a string where a whole number is wanted; write for "
       "example size = "
       "[960, 540]"},
      {"[fluid]\ngravity = -9.81",
       "s.toml:7:1: error: fluid.gravity: wrong type, a decimal number where a list of 3 numbers is wanted; "
       "write for "
       "example gravity = [0, 0, -9.81]"},
      {"[fluid]\ngravity = [0, 0]",
       "s.toml:7:1: error: fluid.gravity: a list of 2 where 3 numbers are wanted; write for example gravity "
       "= [0, 0, "
       "-9.81]"},
      {"[fluid]\ngravity = [0, 0, '-9.81']",
       "s.toml:7:1: error: fluid.gravity: wrong type, a string where a number is wanted; write for example "
       "gravity = [0, "
       "0, -9.81]"},
      {"[fluid]\ndensity = 2001-01-01",
       "s.toml:7:1: error: fluid.density: wrong type, a date or time where a number is wanted; write for "
       "example density "
       "= 1000"},
      {"[light]\nsun_size = [3]",
       "s.toml:7:1: error: light.sun_size: wrong type, a list where a number is wanted; write for example "
       "sun_size = 4"},
      {"[[solid]]\nname = 5\nbox = { min = [0, 0, 0], max = [1, 1, 1] }",
       "s.toml:7:1: error: solid.0.name: wrong type, a whole number where a string is wanted; write for "
       "example name = "
       "\"gate\""},
      {"[[solid]]\nbox = { min = [0, 0, 0], max = [1, 1, 1] }\nvisible = 'no'",
       "s.toml:8:1: error: solid.0.visible: wrong type, a string where true or false is wanted; write for "
       "example visible "
       "= true"},
      {"[[liquid]]\nbox = [0, 0, 0]",
       "s.toml:7:1: error: liquid.1.box: wrong type, a list where a table is wanted; write for example box = "
       "{ ... }"},
      {"[[liquid]]\nunion = { box = { min = [0, 0, 0], max = [1, 1, 1] } }",
       "s.toml:7:1: error: liquid.1.union: wrong type, a table where a list of tables is wanted; write for "
       "example union = "
       "[ { ... }, { ... } ]"},
      {"[[liquid]]\nunion = [ { sphere = { center = [1, 1, 1], radius = 1 } }, 3 ]",
       "s.toml:7:60: error: liquid.1.union.1: wrong type, a whole number where a table is wanted; write for "
       "example { box = "
       "{ min = [0, 0, 0], max = [1, 1, 1] } }"},
      {"[[liquid]]\nmesh = { file = 3 }",
       "s.toml:7:10: error: liquid.1.mesh.file: wrong type, a whole number where a file's name is wanted; "
       "write for example "
       "file = \"rock.obj\""},
      {"[solid]\nname = 'a'",
       "s.toml:6:2: error: solid: wrong type, a table where a list of tables is wanted; head each member "
       "with [[solid]]"},
      {"[quality]\npreview = 3",
       "s.toml:7:1: error: quality.preview: wrong type, a whole number where a table is wanted; head it with "
       "[quality.preview]"},
  });
  checkWholeFiles({
      {"camera = 3\n" + kGoodScene,
       "s.toml:1:1: error: camera: wrong type, a whole number where a table is wanted; head it with "
       "[camera]"},
      {"quality = 'final'\n" + kGoodScene,
       "s.toml:1:1: error: quality: wrong type, a string where a table is wanted; head it with "
       "[quality.preview] or "
       "[quality.final]"},
      {"frames = '72'\n" + kGoodScene,
       "s.toml:1:1: error: frames: wrong type, a string where a whole number is wanted; write for example "
       "frames = 72"},
      {"seed = 1.5\n" + kGoodScene,
       "s.toml:1:1: error: seed: wrong type, a decimal number where a whole number is wanted; write for "
       "example seed = 1"},
      {"texture.windows = 33\n" + kGoodScene,
       "s.toml:1:9: error: texture.windows: wrong type, a whole number where a list of whole numbers is "
       "wanted; write for "
       "example windows = [33, 17, 9]"},
      {"texture.windows = [33.0]\n" + kGoodScene,
       "s.toml:1:9: error: texture.windows: wrong type, a decimal number where a whole number is wanted; "
       "write for example "
       "windows = [33, 17, 9]"},
      {"texture.method = 7\n" + kGoodScene,
       "s.toml:1:9: error: texture.method: wrong type, a whole number where a string is wanted; write for "
       "example method = "
       "\"coordinates\""},
  });
}

TEST_CASE("scene faults: unknown key", "[scenes]") {
  checkCases({
      // A misspelt key: the nearest one of its table.
      {"[render]\nsampels = 3",
       "s.toml:7:1: error: render.sampels: unknown key; did you mean render.samples?"},
      {"[camara]\nfov = 3", "s.toml:6:2: error: camara: unknown key; did you mean camera?"},
      {"[[soild]]\nname = 'a'", "s.toml:6:3: error: soild: unknown key; did you mean solid?"},
      // The right word in the wrong table.
      {"[render]\nresolution = 3",
       "s.toml:7:1: error: render.resolution: unknown key; did you mean domain.resolution?"},
      {"[simulation]\nseed = 3", "s.toml:7:1: error: simulation.seed: unknown key; did you mean seed?"},
      // A key of the whole that stands below the head of a table belongs to that table.
      {"domain.resolution = '64'", "s.toml:6:1: error: liquid.0.domain: unknown key; did you mean domain?"},
      // Nothing like it anywhere.
      {"[simulation]\nxylophone = 3",
       "s.toml:7:1: error: simulation.xylophone: unknown key; known here: cfl"},
      // Deep inside.
      {"[[liquid]]\nsphere = { centre = [1, 1, 1], center = [1, 1, 1], radius = 1 }",
       "s.toml:7:12: error: liquid.1.sphere.centre: unknown key; did you mean liquid.1.sphere.center?"},
      {"[quality.preview]\nrender.sampels = 3",
       "s.toml:7:8: error: quality.preview.render.sampels: unknown key; did you mean "
       "quality.preview.render.samples?"},
      {"[quality.final]\n'render.sampels' = 3",
       "s.toml:7:1: error: quality.final.render.sampels: unknown key; did you mean "
       "quality.final.render.samples?"},
      {"[quality.finale]\nrender.samples = 3",
       "s.toml:6:10: error: quality.finale: unknown key; did you mean quality.final?"},
      {"[quality.high]\nrender.samples = 3",
       "s.toml:6:10: error: quality.high: unknown key; known here: preview and final; what is outside of "
       "them is the "
       "default"},
      {"[quality.final.quality.preview]\nframes = 3",
       "s.toml:6:16: error: quality.final.quality: cannot be set from here; set the key itself, for example "
       "domain.resolution"},
  });
  checkWholeFiles({
      {"texture.exemplar = 'e.png'\n\n\n\n\n\n\n\n\n\n\n\n\ntexture.windwos = [9]\ndomain.size = [1, 1, "
       "1]\n[[liquid]]\n"
       "sphere = { center = [0, 0, 0], radius = 1 }",
       "s.toml:14:9: error: texture.windwos: unknown key; did you mean texture.windows?"},
      {"frame_rat = 3\n" + kGoodScene, "s.toml:1:1: error: frame_rat: unknown key; did you mean frame_rate?"},
      {"qualty.preview.frames = 3\n" + kGoodScene,
       "s.toml:1:1: error: qualty: unknown key; did you mean quality?"},
      {"points = 300\n" + kGoodScene,
       "s.toml:1:1: error: points: unknown key; did you mean texture.points or texture.surface.points?"},
  });
}

TEST_CASE("scene faults: a number out of its range", "[scenes]") {
  checkWholeFiles({
      {"domain.resolution = 4\n" + kGoodScene,
       "s.toml:1:8: error: domain.resolution: 4 is too small; give a whole number from 8 to 4096"},
      {"domain.resolution = 5000\n" + kGoodScene,
       "s.toml:1:8: error: domain.resolution: 5000 is too large; give a whole number from 8 to 4096"},
      {"frames = 0\n" + kGoodScene,
       "s.toml:1:1: error: frames: 0 is too small; give a whole number from 1 to 9999"},
      {"frames = 9000000000000\n" + kGoodScene,
       "s.toml:1:1: error: frames: 9000000000000 is too large; give a whole number from 1 to 9999"},
      {"frame_rate = 0\n" + kGoodScene,
       "s.toml:1:1: error: frame_rate: 0 is too small; give a number from 1 to 1000"},
      {"seed = -1\n" + kGoodScene, "s.toml:1:1: error: seed: -1 is too small; give a whole number 0 or more"},
      {"texture.points = 10\n" + kGoodScene,
       "s.toml:1:9: error: texture.points: 10 is too small; give a whole number from 100 to 50000000"},
      {"texture.spacing = 0\n" + kGoodScene,
       "s.toml:1:9: error: texture.spacing: 0 is too small; give a number above 0"},
      {"texture.spacing = 1.0\n" + kGoodScene,
       "s.toml:1:9: error: texture.spacing: 1 m is as long as the domain's shortest side or longer; give "
       "less than 1 m"},
      {"texture.robust_exponent = 2.5\n" + kGoodScene,
       "s.toml:1:9: error: texture.robust_exponent: 2.5 is too large; give a number above 0 and up to 2"},
      {"texture.soft_constraint = -1\n" + kGoodScene,
       "s.toml:1:9: error: texture.soft_constraint: -1 is negative; give a number 0 or more"},
      {"texture.keep_stretch = 0.5\n" + kGoodScene,
       "s.toml:1:9: error: texture.keep_stretch: 0.5 is too small; give a number 1 or more"},
      {"texture.surface.levels = 0\n" + kGoodScene,
       "s.toml:1:17: error: texture.surface.levels: 0 is too small; give a whole number from 1 to 8"},
      {"texture.later_iterations = [1, -1, 1]\n" + kGoodScene,
       "s.toml:1:9: error: texture.later_iterations: -1 is too small; give a whole number from 0 to 1000"},
  });
  checkCases({
      {"[fluid]\ndensity = 0", "s.toml:7:1: error: fluid.density: 0 is too small; give a number above 0"},
      {"[fluid]\nviscosity = -0.1",
       "s.toml:7:1: error: fluid.viscosity: -0.1 is negative; give a number 0 or more"},
      {"[simulation]\ncfl = 0",
       "s.toml:7:1: error: simulation.cfl: 0 is too small; give a number from 0.1 to 20"},
      {"[[liquid]]\nsphere = { center = [1, 1, 1], radius = -1 }",
       "s.toml:7:32: error: liquid.1.sphere.radius: -1 is negative; give a number above 0"},
      {"[[liquid]]\nsphere = { center = [1, 1, 1], radius = 1 }\nfrom = -1",
       "s.toml:8:1: error: liquid.1.from: -1 is negative; give a number 0 or more"},
      {"[[solid]]\nmesh = { file = 'm.obj', scale = 0 }",
       "s.toml:7:26: error: solid.0.mesh.scale: 0 is too small; give a number above 0"},
      {"[[solid]]\nmesh = { file = 'm.obj' }\ncolor = [0, 2, 0]",
       "s.toml:8:1: error: solid.0.color: 2 is too large; give a number from 0 to 1"},
      {"[camera]\nfov = 180", "s.toml:7:1: error: camera.fov: 180 is too large; give a number from 1 to 170"},
      {"[render]\nsamples = 0",
       "s.toml:7:1: error: render.samples: 0 is too small; give a whole number from 1 to 65536"},
      {"[render]\ngloss = 1.5",
       "s.toml:7:1: error: render.gloss: 1.5 is too large; give a number from 0 to 1"},
      {"[render]\nsize = [8, 540]",
       "s.toml:7:1: error: render.size: 8 is too small; give a whole number from 16 to 16384"},
      {"[light]\nsun_color = [1, -1, 1]",
       "s.toml:7:1: error: light.sun_color: -1 is negative; give a number 0 or more"},
  });
}

TEST_CASE("scene faults: a number that is not finite", "[scenes]") {
  checkCases({
      {"[fluid]\ngravity = [0, 0, nan]",
       "s.toml:7:1: error: fluid.gravity: nan is not a finite number; give a number"},
      {"[fluid]\ndensity = inf",
       "s.toml:7:1: error: fluid.density: inf is not a finite number; give a number above 0"},
      {"[camera]\nat = [0, -inf, 0]",
       "s.toml:7:1: error: camera.at: -inf is not a finite number; give a number"},
      {"[[solid]]\nmesh = { file = 'm.obj' }\nuntil = nan",
       "s.toml:8:1: error: solid.0.until: nan is not a finite number; give a number above 0"},
      {"[[solid]]\nmesh = { file = 'm.obj' }\nfrom = inf",
       "s.toml:8:1: error: solid.0.from: inf is not a finite number; give a number 0 or more"},
  });
}

TEST_CASE("scene faults: settings that do not go together", "[scenes]") {
  checkWholeFiles({
      {"texture.windows = [33, 16, 9]\n" + kGoodScene,
       "s.toml:1:9: error: texture.windows: 16 is even; give odd widths, for example 17"},
      {"texture.windows = [9, 17, 5]\n" + kGoodScene,
       "s.toml:1:9: error: texture.windows: 17 after 9 does not fall; give widths from large to small, for "
       "example [33, 17, "
       "9]"},
      {"texture.windows = [9, 9]\n" + kGoodScene,
       "s.toml:1:9: error: texture.windows: 9 after 9 does not fall; give widths from large to small, for "
       "example [33, 17, "
       "9]"},
      {"texture.windows = []\n" + kGoodScene,
       "s.toml:1:9: error: texture.windows: an empty list; write for example windows = [33, 17, 9]"},
      {"texture.first_iterations = [3, 2]\n" + kGoodScene,
       "s.toml:1:9: error: texture.first_iterations: a list of 2 for 3 windows; give one number for each of "
       "texture.windows"},
      {"texture.points = 3000\ntexture.spacing = 0.1\n" + kGoodScene,
       "s.toml:2:9: error: texture.spacing: given besides points; give only one of points and spacing"},
      {"texture.method = 'magic'\n" + kGoodScene,
       "s.toml:1:9: error: texture.method: \"magic\" is unknown; give \"coordinates\" or \"kwatra07\""},
      {"texture.surface.points = 'random '\n" + kGoodScene,
       "s.toml:1:17: error: texture.surface.points: \"random \" is unknown; give \"seeds\" or \"random\""},
      {"domain.resolution = 8\n" + kGoodScene + "[quality.preview]\ndomain.size = [2, 0.5, 1]",
       "s.toml:8:8: error: quality.preview.domain.size: y is only 2 cells long; give a longer side or a "
       "higher "
       "domain.resolution, so that it is 4 or more"},
      {"name = 'a/b'\n" + kGoodScene,
       "s.toml:1:1: error: name: \"a/b\" holds a slash; give a name that can be a file's"},
      {"name = '..'\n" + kGoodScene,
       "s.toml:1:1: error: name: \"..\" is a folder; give a name that can be a file's"},
      {"name = ''\n" + kGoodScene,
       "s.toml:1:1: error: name: an empty string; give a name or leave the key out"},
  });
  const std::string shapes = "box, sphere, half_space, mesh, union ";
  checkCases({
      {"[[liquid]]\nfrom = 1",
       "s.toml:6:1: error: liquid.1: no shape; give one of " + shapes + "or difference"},
      {"[[liquid]]\nsphere = { center = [1, 1, 1], radius = 1 }\nmesh = { file = 'm.obj' }",
       "s.toml:8:1: error: liquid.1.mesh: given besides sphere; give only one of " + shapes +
           "and difference"},
      {"[[liquid]]\nunion = [ {} ]",
       "s.toml:7:11: error: liquid.1.union.0: no shape; give one of " + shapes + "or difference"},
      {"[[liquid]]\nunion = []",
       "s.toml:7:1: error: liquid.1.union: an empty list; write for example union = [ { ... }, { ... } ]"},
      {"[[liquid]]\ndifference = [ { sphere = { center = [1, 1, 1], radius = 1 } } ]",
       "s.toml:7:1: error: liquid.1.difference: has one part only; give the shape and, after it, what is "
       "taken away from "
       "it"},
      {"[[liquid]]\nbox = { min = [0, 0, 0.5], max = [1, 1, 0.5] }",
       "s.toml:7:28: error: liquid.1.box.max: z is 0.5, not above min's 0.5; give a max that is greater than "
       "min in x, y "
       "and z"},
      {"[[solid]]\nunion = [ { box = { min = [0, 2, 0], max = [1, 1, 1] } } ]",
       "s.toml:7:38: error: solid.0.union.0.box.max: y is 1, not above min's 2; give a max that is greater "
       "than min in x, y "
       "and z"},
      {"[[solid]]\nhalf_space = { point = [0, 0, 0], normal = [0, 0, 0] }",
       "s.toml:7:35: error: solid.0.half_space.normal: has no length; give the direction out of the shape, "
       "for example [0, "
       "0, 1]"},
      {"[[solid]]\nmesh = { file = 'm.obj' }\nfrom = 1\nuntil = 1",
       "s.toml:9:1: error: solid.0.until: until 1 s is not after from 1 s; give an until that is greater "
       "than from"},
      {"[[solid]]\nname = 'a'\nmesh = { file = 'm.obj' }\n[[solid]]\nname = 'a'\nmesh = { file = 'm.obj' }",
       "s.toml:10:1: error: solid.1.name: \"a\" is the name of solid.0 too; give each solid a name of its "
       "own"},
      {"[camera]\nfrom = [1, 2, 3]\nat = [1, 2, 3]",
       "s.toml:7:1: error: camera.from: the camera stands at the point it looks at; give camera.from and "
       "camera.at different "
       "places"},
      {"[light]\nsun_direction = [0, 0, 0]",
       "s.toml:7:1: error: light.sun_direction: has no length; give the direction towards the sun, for "
       "example [-0.5, -0.4, "
       "0.8]"},
      {"[render]\nsize = [961, 540]",
       "s.toml:7:1: error: render.size: 961 is odd; give even numbers, as the video needs, for example 962"},
  });
}

TEST_CASE("scene faults: liquid wholly outside the domain", "[scenes]") {
  const std::string fault =
      "s.toml:6:1: error: liquid.1: lies wholly outside the domain; put at least a part of it between [0, 0, "
      "0] and [2, 1, "
      "1]";
  for (const std::string shape :
       {"box = { min = [2, 0, 0], max = [3, 1, 1] }", "sphere = { center = [2.8, 1.8, 0.5], radius = 1.1 }",
        "half_space = { point = [0, 0, 0], normal = [0, 0, 1] }",
        "half_space = { point = [2, 1, 1], normal = [-1, -1, -1] }",
        "union = [ { box = { min = [-1, 0, 0], max = [0, 1, 1] } }, { sphere = { center = [0, 0, 3], radius "
        "= 1 } } ]",
        "difference = [ { box = { min = [0, 0, 1], max = [1, 1, 2] } }, { sphere = { center = [1, 0.5, 0.5], "
        "radius = 1 } } "
        "]"}) {
    INFO(shape);
    CHECK(faultsOf(kGoodScene + "[[liquid]]\n" + shape) == std::vector<std::string>{fault});
  }
  for (const std::string shape :
       {"box = { min = [1.9, 0, 0], max = [3, 1, 1] }", "sphere = { center = [2.8, 1.8, 0.5], radius = 1.2 }",
        "half_space = { point = [0, 0, 0.1], normal = [0, 0, 1] }",
        "mesh = { file = 'm.obj', translate = [9, 9, 9] }",
        "union = [ { box = { min = [-1, 0, 0], max = [0, 1, 1] } }, { sphere = { center = [0, 0, 0], radius "
        "= 1 } } ]"}) {
    INFO(shape);
    CHECK(faultsOf(kGoodScene + "[[liquid]]\n" + shape).empty());
  }
}

TEST_CASE("scene faults: what must be given and is not", "[scenes]") {
  const std::string size = "domain.size: missing key; write for example size = [1, 1, 1]";
  const std::string exemplar =
      "texture.exemplar: missing key; write for example exemplar = \"exemplars/green_scales.png\"";
  const std::string liquid = "liquid: missing key; give at least one [[liquid]]";
  CHECK(faultsOf("") == std::vector<std::string>{"s.toml:1:1: error: " + size, "s.toml:1:1: error: " + liquid,
                                                 "s.toml:1:1: error: " + exemplar});
  CHECK(faultsOf("liquid = [ { sphere = { center = [0, 0, 0], radius = 1 } } ]\n[domain]\nresolution = "
                 "32\n[texture]\n") ==
        std::vector<std::string>{"s.toml:2:2: error: " + size, "s.toml:4:2: error: " + exemplar});
  checkWholeFiles({
      {"texture.exemplar = 'e.png'\ndomain.size = [1, 1, 1]\nliquid = []",
       "s.toml:3:1: error: liquid: an empty list; head each member with [[liquid]]"},
  });
  checkCases({
      {"[[solid]]\nbox = { min = [0, 0, 0] }",
       "s.toml:7:1: error: solid.0.box.max: missing key; write for example max = [1, 1, 1]"},
      {"[[solid]]\nbox = { max = [1, 1, 1] }",
       "s.toml:7:1: error: solid.0.box.min: missing key; write for example min = [0, 0, 0]"},
      {"[[solid]]\nsphere = { radius = 1 }",
       "s.toml:7:1: error: solid.0.sphere.center: missing key; write for example center = [0, 0, 0]"},
      {"[[solid]]\nsphere = { center = [1, 1, 1] }",
       "s.toml:7:1: error: solid.0.sphere.radius: missing key; write for example radius = 1"},
      {"[[solid]]\nhalf_space = { point = [1, 1, 1] }",
       "s.toml:7:1: error: solid.0.half_space.normal: missing key; write for example normal = [0, 0, 1]"},
      {"[[solid]]\nmesh = { scale = 2 }",
       "s.toml:7:1: error: solid.0.mesh.file: missing key; write for example file = \"rock.obj\""},
  });
}

TEST_CASE("scene faults: files that are not there", "[scenes]") {
  const std::string rest =
      "domain.size = [2, 1, 1]\n[[liquid]]\nsphere = { center = [1, 1, 1], radius = 1 }\n";
  checkWholeFiles({
      {"texture.exemplar = 'pictures/none.png'\n" + rest,
       "s.toml:1:9: error: texture.exemplar: no such file: pictures/none.png; give an existing file, "
       "relative to the scene "
       "file's folder"},
      {"texture.exemplar = 'pictures'\n" + rest,
       "s.toml:1:9: error: texture.exemplar: pictures is a folder; give a file in it"},
      {"texture.exemplar = ''\n" + rest,
       "s.toml:1:9: error: texture.exemplar: an empty file name; write for example exemplar = "
       "\"exemplars/green_scales.png\""},
  });
  checkCases({
      {"[[solid]]\nmesh = { file = 'none.obj' }",
       "s.toml:7:10: error: solid.0.mesh.file: no such file: none.obj; give an existing file, relative to "
       "the scene file's "
       "folder"},
      {"[[solid]]\nmesh = { file = 'e.png' }",
       "s.toml:7:10: error: solid.0.mesh.file: e.png is of no known kind; give a file that ends in .obj, "
       ".ply or .stl"},
  });
}

TEST_CASE("scene faults: no TOML", "[scenes]") {
  const auto startsWith = [](const std::string& text, const std::string& start) {
    const std::vector<std::string> faults = faultsOf(text);
    INFO(text);
    REQUIRE(faults.size() == 1);
    CHECK_THAT(faults[0],
               Catch::StartsWith(start) && Catch::EndsWith("; write it as in https://toml.io/en/v1.0.0"));
  };
  startsWith("frames = 3\ndomain = [1, 2\n", "s.toml:2:16: error: syntax: ");
  startsWith("frames = \n", "s.toml:1:10: error: syntax: ");
  startsWith("frames 3\n", "s.toml:1:8: error: syntax: ");
  startsWith("frames = 3\nframes = 4\n", "s.toml:2:");
  startsWith("name = 'a\n", "s.toml:1:10: error: syntax: ");
  startsWith(std::string("name = '\xff\xfe'\n"), "s.toml:1:");
  startsWith("seed = 99999999999999999999\n", "s.toml:1:");
}

TEST_CASE("scene faults: every shorter version of a file is refused or read", "[scenes]") {
  const std::string text = kGoodScene + "[quality.preview]\n'domain.resolution' = 40\n";
  int refused = 0;
  for (std::size_t length = 0; length < text.size(); ++length) {
    const std::vector<std::string> faults = faultsOf(text.substr(0, length));
    refused += faults.empty() ? 0 : 1;
    for (const std::string& fault : faults)
      CHECK_THAT(fault, Catch::StartsWith("s.toml:") && Catch::Contains(": error: "));
  }
  CHECK(refused > int(kGoodScene.size()) - 3);
}

TEST_CASE("scene faults: the scene file itself", "[scenes]") {
  const SceneFolder folder;
  const auto faultOf = [&](const std::filesystem::path& file) {
    try {
      loadScene(file);
    } catch (const SceneError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  const std::string right = "; give a scene file, for example scenes/dam_break.toml";
  const std::string base = folder.path().string();
  CHECK(faultOf(folder.path() / "none.toml") == base + "/none.toml:1:1: error: file: no such file" + right);
  CHECK(faultOf(folder.path()) == base + ":1:1: error: file: is a folder" + right);
  CHECK(faultOf(folder.path() / "e.png" / "s.toml") ==
        base + "/e.png/s.toml:1:1: error: file: cannot be read: Not a directory" + right);
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
