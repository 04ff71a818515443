// Every fault that one key can have: place, key, what is wrong, what would be right.
#include "scenes/reader.h"

#include "tests/scenes/fault_cases.h"

#include <catch2/catch.hpp>

namespace fluidtex::scenes {

TEST_CASE("scene faults: wrong type", "[scenes]") {
  checkCases({
      {"[simulation]\ncfl = 'three'",
       "s.toml:7:1: error: simulation.cfl: wrong type, a string where a number is wanted; write for example "
       "cfl = 3"},
      {"[render]\nsamples = 4.0",
       "s.toml:7:1: error: render.samples: wrong type, a decimal number where a whole number is wanted; "
       "write for example "
       "samples = 32"},
      {"[render]\nsamples = true",
       "s.toml:7:1: error: render.samples: wrong type, true where a whole number is wanted; write for "
       "example samples = 32"},
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
       "with [[solid]], or write solid = [ { ... } ]"},
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
      {"texture.later_frames = 'never'\n" + kGoodScene,
       "s.toml:1:9: error: texture.later_frames: \"never\" is unknown; give \"synthesize\", \"advect\", "
       "\"alone\", \"birth\" or \"dual_rest\""},
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
      {"texture.spacing = 1e-9\n" + kGoodScene,
       "s.toml:1:9: error: texture.spacing: 1e-09 m would put more than 50000000 points on the domain's six "
       "faces; give "
       "0.00045 m or more"},
      {"texture.robust_exponent = 2.5\n" + kGoodScene,
       "s.toml:1:9: error: texture.robust_exponent: 2.5 is too large; give a number above 0 and up to 2"},
      {"texture.soft_constraint = -1\n" + kGoodScene,
       "s.toml:1:9: error: texture.soft_constraint: -1 is negative; give a number 0 or more"},
      {"texture.renewal_radius = 2\n" + kGoodScene,
       "s.toml:1:9: error: texture.renewal_radius: 2 is too small; give a number from 4 to 1000"},
      {"texture.fade = -1\n" + kGoodScene,
       "s.toml:1:9: error: texture.fade: -1 is negative; give a number 0 or more"},
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
       "s.toml:7:1: error: simulation.cfl: 0 is too small; give a number from 0.1 to 4"},
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

TEST_CASE("scene faults: what must be given and is not", "[scenes]") {
  const std::string size = "domain.size: missing key; write for example size = [1, 1, 1]";
  const std::string exemplar =
      "texture.exemplar: missing key; write for example exemplar = \"exemplars/green_scales.png\"";
  const std::string liquid = "liquid: missing key; give at least one [[liquid]] or one [[source]]";
  CHECK(faultsOf("") == std::vector<std::string>{"s.toml:1:1: error: " + size,
                                                 "s.toml:1:1: error: " + exemplar,
                                                 "s.toml:1:1: error: " + liquid});
  CHECK(faultsOf("liquid = [ { sphere = { center = [0, 0, 0], radius = 1 } } ]\n[domain]\nresolution = "
                 "32\n[texture]\n") ==
        std::vector<std::string>{"s.toml:2:2: error: " + size, "s.toml:4:2: error: " + exemplar});
  checkWholeFiles({
      {"texture.exemplar = 'e.png'\ndomain.size = [1, 1, 1]\nliquid = []",
       "s.toml:3:1: error: liquid: an empty list; give at least one [[liquid]] or one [[source]]"},
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
      {"[[solid]]\nmesh_sequence = { files = 'm_%d.obj' }",
       "s.toml:7:1: error: solid.0.mesh_sequence.last: missing key; write for example last = 1"},
      {"[[solid]]\nmesh_sequence = { last = 2 }",
       "s.toml:7:1: error: solid.0.mesh_sequence.files: missing key; write for example files = "
       "\"rock_%04d.obj\""},
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
      {"[[solid]]\nmesh_sequence = { files = 'm_%d.obj', last = 4 }",
       "s.toml:7:19: error: solid.0.mesh_sequence.files: no such file: m_3.obj; give all from number 1 to 4"},
      {"[texture.onto]\nfiles = 't_%d.obj'\nfirst = 1",
       "s.toml:7:1: error: texture.onto.files: no such file: t_5.obj; give all from number 1 to 72"},
      {"[texture.scale]\nby = 'attribute'\npoint = [{ value = 1, factor = 1 }]",
       "s.toml:6:10: error: texture.scale: names no attribute; give attribute = \"NAME\", one that `fluidtex "
       "check` lists"},
      {"[texture.orientation]\nalign = 'attribute'\nattribute = 'wind'",
       "s.toml:8:1: error: texture.orientation.attribute: the liquid has no \"wind\"; give \"temperature\" "
       "with "
       "simulate = true in [heat], \"mixture\" where a [[liquid]] or [[source]] has one, or a liquid out of "
       "files"},
      {"[texture.onto]\nfirst = 1",
       "s.toml:6:10: error: texture.onto.files: missing key; write for example files = \"rock_%04d.obj\""},
      {"[texture.transport]\nmethod = 'magic'",
       "s.toml:7:1: error: texture.transport.method: \"magic\" is unknown; give \"trace\" or \"grid\""},
      {"[texture.transport]\norientation = 'none'",
       "s.toml:7:1: error: texture.transport.orientation: \"none\" is unknown; give \"vector\" or "
       "\"scalars\""},
      {"[[solid]]\nmesh_sequence = { files = 'm.obj', last = 4 }",
       "s.toml:7:19: error: solid.0.mesh_sequence.files: m.obj has no place for a number; write %d for it, "
       "or "
       "%04d where it has four digits, for example \"rock_%04d.obj\""},
      {"[[solid]]\nmesh_sequence = { files = 'm_%d_%d.obj', last = 4 }",
       "s.toml:7:19: error: solid.0.mesh_sequence.files: m_%d_%d.obj does not say in one place where the "
       "number "
       "is; write %d for it, or %04d where it has four digits, for example \"rock_%04d.obj\""},
      {"[[solid]]\nmesh_sequence = { files = 'm_%4d.obj', last = 4 }",
       "s.toml:7:19: error: solid.0.mesh_sequence.files: m_%4d.obj does not say in one place where the "
       "number "
       "is; write %d for it, or %04d where it has four digits, for example \"rock_%04d.obj\""},
      {"[[solid]]\nmesh_sequence = { files = '', last = 4 }",
       "s.toml:7:19: error: solid.0.mesh_sequence.files: an empty file name; write for example files = "
       "\"rock_%04d.obj\""},
      {"[[solid]]\nmesh_sequence = { files = 'e_%d.png', last = 4 }",
       "s.toml:7:19: error: solid.0.mesh_sequence.files: e_%d.png is of no known kind; give a file that ends "
       "in "
       ".obj, .ply or .stl"},
      {"[[solid]]\nmesh = { file = 'e.png' }",
       "s.toml:7:10: error: solid.0.mesh.file: e.png is of no known kind; give a file that ends in .obj, "
       ".ply or .stl"},
  });
}

}  // namespace fluidtex::scenes
