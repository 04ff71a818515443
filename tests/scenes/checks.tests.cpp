// Every fault that a scene can have as a whole: place, key, what is wrong, what would be right.
#include "scenes/checks.h"

#include "tests/scenes/fault_cases.h"

#include <catch2/catch.hpp>

namespace fluidtex::scenes {

TEST_CASE("scene: the one that the faults are put into has none", "[scenes]") {
  CHECK(faultsOf(kGoodScene).empty());
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
       "s.toml:1:9: error: texture.method: \"magic\" is unknown; give \"coordinates\", \"kwatra07\" or "
       "\"none\""},
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
  const std::string shapes = "box, sphere, cylinder, half_space, mesh, mesh_sequence, height_field, union ";
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
      {"[heat]\nlaw = \"table\"",
       "s.toml:7:1: error: heat.law: \"table\" has fewer than two points; give two [[heat.point]] or more, "
       "each "
       "with a temperature and a viscosity"},
      {"[[heat.point]]\ntemperature = 1\nviscosity = 1",
       "s.toml:6:8: error: heat.point: is of no use here; give it together with law = \"table\""},
      {"[heat]\nlaw = \"table\"\npoint = [{ temperature = 5, viscosity = 1 }, { temperature = 4, viscosity = "
       "2 }]",
       "s.toml:8:48: error: heat.point.1.temperature: 4 K is not above the one before, 5 K; give them by "
       "rising "
       "temperature"},
      {"[texture.scale]\nby = 'height'",
       "s.toml:7:1: error: texture.scale.by: is of no use without a factor; give one [[texture.scale.point]] "
       "or more, each with a value and a factor"},
      {"[texture.scale]\nby = 'distance'\npoint = [{ value = 0, factor = 1 }]",
       "s.toml:7:1: error: texture.scale.by: \"distance\" is from nothing; give a shape or more as "
       "[[texture.scale.from]]"},
      {"[texture.scale]\nby = 'temperature'\npoint = [{ value = 0, factor = 1 }]",
       "s.toml:7:1: error: texture.scale.by: \"temperature\" is not computed; give simulate = true in [heat] "
       "too"},
      {"[texture.renewal]\nby = 'height'",
       "s.toml:7:1: error: texture.renewal.by: is of no use without a factor; give one "
       "[[texture.renewal.point]] or more, each with a value and a factor"},
      {"[texture.renewal]\nby = 'distance'\npoint = [{ value = 0, factor = 1 }]",
       "s.toml:7:1: error: texture.renewal.by: \"distance\" is from nothing; give a shape or more as "
       "[[texture.renewal.from]]"},
      {"[texture.scale]\npoint = [{ value = 2, factor = 1 }, { value = 1, factor = 2 }]",
       "s.toml:7:39: error: texture.scale.point.1.value: 1 is not above the one before, 2; give them by "
       "rising "
       "value"},
      {"[texture.guidance]\nby = 'height'\npoint = [{ value = 0, level = 1 }]",
       "s.toml:6:10: error: texture.guidance.map: missing key; write for example map = "
       "\"exemplars/green_scales.png\""},
      {"[texture.guidance]\nby = 'height'\nmap = 'e.png'",
       "s.toml:7:1: error: texture.guidance.by: is of no use without a level; give one "
       "[[texture.guidance.point]] or more, each with a value and a level"},
      {"[texture.guidance]\nby = 'temperature'\nmap = 'e.png'\npoint = [{ value = 0, level = 1 }]",
       "s.toml:7:1: error: texture.guidance.by: \"temperature\" is not computed; give simulate = true in "
       "[heat] too"},
      {"[texture.guidance]\nby = 'age'\nmap = 'e.png'\npoint = [{ value = 2, level = 1 }, { value = 2, level "
       "= 0 }]",
       "s.toml:9:38: error: texture.guidance.point.1.value: 2 is not above the one before, 2; give them by "
       "rising value"},
      {"[texture.guidance]\nby = 'foam'\nmap = 'e.png'\npoint = [{ value = 0, level = 1 }]\nfoam = { from = "
       "3, full = 3 }",
       "s.toml:10:20: error: texture.guidance.foam.full: 3 is not above from, 3; give a larger one"},
      {"[[texture.map]]\nfile = 'e.png'",
       "s.toml:6:1: error: texture.map.0: has no name; give name = \"height\" or whatever it holds"},
      {"[[texture.map]]\nname = 'a b'\nfile = 'e.png'",
       "s.toml:7:1: error: texture.map.0.name: \"a b\" cannot be the name of a vertex's property; give "
       "letters, digits and _, a letter first"},
      {"[[texture.map]]\nname = 'age'\nfile = 'e.png'",
       "s.toml:7:1: error: texture.map.0.name: \"age\" is the name of a property that vertices have anyway; "
       "give another name"},
      {"[[texture.map]]\nname = 'a'\nfile = 'e.png'\n[[texture.map]]\nname = 'a'\nfile = 'e.png'",
       "s.toml:10:1: error: texture.map.1.name: \"a\" is the name of an earlier map too; give each map a "
       "name of its own"},
      {"[[texture.map]]\nname = 'relief'\nfile = 'e.png'\n[render.bump]\nmap = 'releif'",
       "s.toml:10:1: error: render.bump.map: \"releif\" is no map of this scene; did you mean \"relief\"?"},
      {"[[texture.map]]\nname = 'a'\nfile = 'e.png'\nholds = 'directions'\n[render.bump]\nmap = 'a'",
       "s.toml:11:1: error: render.bump.map: \"a\" holds directions, which make no relief; give a map of "
       "values or "
       "of normals"},
      {"[render.displacement]\nheight = 2",
       "s.toml:7:1: error: render.displacement.height: is of no use without a map; give map = \"height\", or "
       "whatever the [[texture.map]] is named that holds heights"},
      {"[[texture.map]]\nname = 'a'\nfile = 'e.png'\nholds = 'normals'\n[render.displacement]\nmap = 'a'",
       "s.toml:11:1: error: render.displacement.map: \"a\" holds vectors, which move nothing; give a map of "
       "values"},
      {"[render.bump]\nheight = 2",
       "s.toml:7:1: error: render.bump.height: is of no use without a map; give map = \"height\", or "
       "whatever the "
       "[[texture.map]] is named that holds heights or normals"},
      {"[[texture.map]]\nname = 'a'\nfile = 'e.png'\nholds = 'normals'\nweight = 1",
       "s.toml:10:1: error: texture.map.0.weight: vectors turn with the texture and cannot be matched; leave "
       "weight out, or match a map of values, the heights for example"},
      {"[[solid]]\nmesh = { file = 'm.obj' }\nkeyframe = [ { time = 1 }, { time = 1 } ]",
       "s.toml:8:30: error: solid.0.keyframe.1.time: 1 s is not after the one before, at 1 s; give them in "
       "the order of time"},
      {"[[solid]]\nmesh = { file = 'm.obj' }\naxis = [0, 0, 0]",
       "s.toml:8:1: error: solid.0.axis: has no length; give the direction it turns about, for example [0, "
       "0, 1]"},
      {"[[solid]]\ncylinder = { from = [1, 1, 1], to = [1, 1, 1], radius = 1 }",
       "s.toml:7:32: error: solid.0.cylinder.to: is the same point as from; give the middle of the other "
       "end"},
      {"[[solid]]\nheight_field = { file = 'e.png', pixel = 1, low = 2, high = 2 }",
       "s.toml:7:54: error: solid.0.height_field.high: 2 is not above low's 2; give the height of white in "
       "metres, greater than that of black"},
      {"[[solid]]\nmesh_sequence = { files = 'm_%d.obj', first = 5, last = 3 }",
       "s.toml:7:50: error: solid.0.mesh_sequence.last: 3 is before first, which is 5; give the number of "
       "the "
       "last file"},
      {"[[solid]]\nunion = [ { mesh_sequence = { files = 'm_%d.obj', last = 1 } } ]",
       "s.toml:7:13: error: solid.0.union.0.mesh_sequence: only the whole shape of a [[solid]] can change; "
       "give "
       "mesh with one of its files"},
      {"[[liquid]]\nmesh_sequence = { files = 'm_%d.obj', last = 1 }",
       "s.toml:7:1: error: liquid.1.mesh_sequence: only the whole shape of a [[solid]] can change; give mesh "
       "with one of its files"},
      {"[[source]]\nsphere = { center = [3, 3, 3], radius = 1 }",
       "s.toml:6:1: error: source.0: lies wholly outside the domain; put at least a part of it between [0, "
       "0, 0] and [2, 1, 1]"},
      {"[[source]]\nhalf_space = { point = [0, 0, 0.5], normal = [0, 0, 1] }\n[domain.sides]\ny_high = "
       "'unbounded'",
       "s.toml:6:1: error: source.0: has no end on a side of the domain that is unbounded; give a shape that "
       "ends, for example a box, or a side of another kind"},
      {"[[drain]]\nunion = [ { half_space = { point = [0, 0, 0], normal = [1, 0, 0.1] } } ]\n"
       "[domain.sides]\nx_low = 'unbounded'",
       "s.toml:6:1: error: drain.0: has no end on a side of the domain that is unbounded; give a shape that "
       "ends, for example a box, or a side of another kind"},
      {"[motion]\nflow = 'rotation'\n[domain.sides]\nz_low = 'unbounded'",
       "s.toml:8:9: error: domain.sides: a flow in closed form is known inside the domain only; give no side "
       "that is \"unbounded\", or give motion.flow = \"solver\""},
      {"[[source]]\nsphere = { center = [1, 1, 1], radius = 1 }\nfrom = 2\nuntil = 1",
       "s.toml:9:1: error: source.0.until: until 1 s is not after from 2 s; give an until that is greater "
       "than from"},
      {"[[drain]]\ncylinder = { from = [3, 0, 0], to = [3, 1, 0], radius = 0.5 }",
       "s.toml:6:1: error: drain.0: lies wholly outside the domain; put at least a part of it between [0, 0, "
       "0] and [2, 1, 1]"},
      {"[[solid]]\nname = 'a'\nmesh = { file = 'm.obj' }\n[[solid]]\nname = 'a'\nmesh = { file = 'm.obj' }",
       "s.toml:10:1: error: solid.1.name: \"a\" is the name of solid.0 too; give each solid a name of its "
       "own"},
      {"[[wall]]\nslip_length = 1",
       "s.toml:7:1: error: wall.0.slip_length: is of no use here; give it together with wall = \"friction\""},
      {"[[solid]]\nmesh = { file = 'm.obj' }\nwall_velocity = [1, 0, 0]",
       "s.toml:8:1: error: solid.0.wall_velocity: a wall that slips drags nothing along; give it together "
       "with "
       "wall = \"no_slip\" or \"friction\""},
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

TEST_CASE("scene faults: bodies beside a liquid out of files", "[scenes]") {
  const std::string files = "[motion]\nflow = 'files'\n[files]\npath = 'pictures'\n";
  const std::string wrong =
      ": is of no use beside a liquid out of files; leave it out, or give motion.flow = \"solver\"";
  const std::string ball = "sphere = { center = [1, 1, 1], radius = 0.5 }\n";
  checkWholeFiles(
      {{kGoodScene + files, "s.toml:4:3: error: liquid" + wrong},
       {"texture.exemplar = 'e.png'\n" + files + "[[drain]]\n" + ball, "s.toml:6:3: error: drain" + wrong}});
  CHECK(faultsOf("texture.exemplar = 'e.png'\n" + files + "[[solid]]\n" + ball).empty());
  // Of a scene that is simulated elsewhere.
  Overrides overrides;
  overrides.set = {"motion.flow=files", "files.path=cache"};
  CHECK(faultsOf(kGoodScene, overrides).empty());
  const SceneFolder folder;
  folder.write("pictures/cache.json", "");
  CHECK_NOTHROW(loadScene(folder.write("s.toml", kGoodScene + files)));
}

TEST_CASE("scene faults: a flow in closed form and what it knows nothing of", "[scenes]") {
  const std::string ball = "sphere = { center = [1, 1, 1], radius = 0.5 }";
  checkWholeFiles({
      {"motion.flow = 'swirl'\n" + kGoodScene,
       "s.toml:1:8: error: motion.flow: \"swirl\" is unknown; give \"solver\", \"rest\", \"rotation\", "
       "\"vortex\", \"deformation\", \"stretch\", \"source_sink\", \"slot\" or \"files\""},
      {"motion.period = 2\n" + kGoodScene,
       "s.toml:1:8: error: motion.period: is of no use here; give it together with flow = \"vortex\" or "
       "\"deformation\""},
      {"motion = { flow = 'deformation', rate = 2 }\n" + kGoodScene,
       "s.toml:1:34: error: motion.rate: is of no use here; give it together with flow = \"rotation\", "
       "\"vortex\", \"stretch\" or \"source_sink\""},
      {"motion = { flow = 'stretch', strain = 1 }\n" + kGoodScene,
       "s.toml:1:30: error: motion.strain: is of no use here; give it together with flow = \"slot\""},
      {"motion = { flow = 'stretch', rate = 0 }\n" + kGoodScene,
       "s.toml:1:30: error: motion.rate: 0 is too small; give a number above 0"},
  });
  checkCases({
      {"[motion]\nflow = 'rest'\n[[drain]]\n" + ball,
       "s.toml:8:3: error: drain: is of no use with a flow in closed form, which knows of no other bodies; "
       "leave "
       "it out, or give motion.flow = \"solver\""},
      {"[motion]\nflow = 'rest'\n[heat]\nsimulate = true\n",
       "s.toml:9:1: error: heat.simulate: is of no use with a flow in closed form, which knows no "
       "temperature; "
       "leave it out, or give motion.flow = \"solver\""},
      {"[motion]\nflow = 'rest'\n[[liquid]]\n" + ball + "\nfrom = 1",
       "s.toml:10:1: error: liquid.1.from: a flow in closed form moves what is there from the start; leave "
       "it "
       "out"},
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

TEST_CASE("scene faults: the spacing that is recommended is taken, a little less is not", "[scenes]") {
  CHECK(faultsOf("texture.spacing = 0.00045\n" + kGoodScene).empty());
  CHECK(faultsOf("texture.spacing = 0.00044\n" + kGoodScene).size() == 1);
}

TEST_CASE("checks: how the texture lies, and by what", "[scenes]") {
  checkCases({
      {"[texture.orientation]\nsymmetry = 3",
       "s.toml:7:1: error: texture.orientation.symmetry: 3 is no symmetry of square pieces of a picture; "
       "give "
       "1, 2 or 4"},
      {"[texture.orientation]\nalign = 'curvature'",
       "s.toml:7:1: error: texture.orientation.align: the line in which a surface bends has no forward end; "
       "give symmetry = 2 or 4 with it"},
      {"[texture.orientation]\nalign = 'direction'\ndirection = [0, 0, 0]",
       "s.toml:8:1: error: texture.orientation.direction: has no length; give a vector that points "
       "somewhere"},
      {"[texture.orientation]\nkeep_clear = [ { sphere = { center = [0, 0, 0], radius = 1 } }, { box = { min "
       "= "
       "[0, 0, 0], max = [1, 1, 0] } } ]",
       "s.toml:7:92: error: texture.orientation.keep_clear.1.box.max: z is 0, not above min's 0; give a max "
       "that "
       "is greater than min in x, y and z"},
      {"[texture.guidance]\nby = 'attribute'\nmap = 'e.png'\nattribute = 'age'\npoint = [{ value = 0, level "
       "= "
       "1 }]",
       "s.toml:9:1: error: texture.guidance.attribute: the liquid has no \"age\"; give \"temperature\" with "
       "simulate = true in [heat], \"mixture\" where a [[liquid]] or [[source]] has one, or a liquid out of "
       "files"},
      {"[[texture.map]]\nname = '1a'\nfile = 'e.png'",
       "s.toml:7:1: error: texture.map.0.name: \"1a\" cannot be the name of a vertex's property; give "
       "letters, "
       "digits and _, a letter first"},
      // Vectors have a property for each of their parts.
      {"[[texture.map]]\nname = 'n'\nfile = 'e.png'\nholds = 'normals'\n[[texture.map]]\nname = 'n_x'\nfile "
       "= "
       "'e.png'",
       "s.toml:11:1: error: texture.map.1.name: \"n_x\" is the name of an earlier map too; give each map a "
       "name "
       "of its own"},
  });
  CHECK(faultsOf(kGoodScene + "[texture.orientation]\nalign = 'curvature'\nsymmetry = 2").empty());
  CHECK(faultsOf(kGoodScene + "[texture.orientation]\ndirection = [0, 0, 0]").empty());  // of no use here
  CHECK(faultsOf(kGoodScene + "[heat]\nsimulate = true\n[texture.scale]\nby = 'attribute'\nattribute = "
                              "'temperature'\npoint = [{ value = 1, factor = 1 }]")
            .empty());
  checkWholeFiles(
      {{"texture.windows = [9]\ntexture.later_iterations = [3, 2]\n" + kGoodScene,
        "s.toml:2:9: error: texture.later_iterations: a list of 2 for 1 window; give one number for "
        "each of texture.windows"}});
}

TEST_CASE("checks: what flows, and where files are", "[scenes]") {
  checkCases({
      {"[[source]]\nsphere = { center = [1, 1, 1], radius = 1 }\nrate = [ { time = 0, factor = 1 }, { time = "
       "2, "
       "factor = 1 }, { time = 1, factor = 1 } ]",
       "s.toml:8:64: error: source.0.rate.2.time: 1 s is not after the one before, at 2 s; give them in the "
       "order of time"},
      {"[[liquid]]\nsphere = { center = [9, 0, 0], radius = 1 }\n[domain.sides]\ny_high = 'unbounded'",
       "s.toml:6:1: error: liquid.1: lies wholly outside the domain; put at least a part of it between [0, "
       "0, 0] "
       "and [2, 1, 1], or beyond a side that is unbounded"},
      {"[files]\npath = 'pictures'",
       "s.toml:6:2: error: files: is of no use here; give it together with motion.flow = \"files\""},
  });
  CHECK(faultsOf(
            kGoodScene +
            "[[liquid]]\nsphere = { center = [1, 9, 0], radius = 1 }\n[domain.sides]\ny_high = 'unbounded'")
            .empty());
  checkWholeFiles(
      {{"texture.exemplar = 'e.png'\nmotion.flow = 'files'\n",
        "s.toml:1:1: error: files.path: missing key; give the cache of another program: its folder, "
        "or a pattern such as \"water_####.vdb\""}});
}

TEST_CASE("checks: a key that has a fault already is not looked at again", "[scenes]") {
  for (const std::string text :
       {"[camera]\nfrom = [0.5, 0.5]\nat = [0, 0, 0]", "[light]\nsun_direction = [0, 0, nan]",
        "[render]\nsize = [961, 5]", "[[solid]]\nmesh = { file = 'm.obj' }\nfrom = 2\nuntil = -1",
        "[[solid]]\nbox = { min = [1, 1, 'x'], max = [0, 0, 0] }", "[[wall]]\nwall = 'wet'\nslip_length = 1",
        "[motion]\nflow = 'swirl'\nrate = 2",
        "[heat]\nlaw = 'none'\npoint = [ { temperature = 1, viscosity = 1 } ]",
        "[texture.scale]\nby = 'nothing'", "[render.bump]\nmap = 3\nheight = 2"}) {
    INFO(text);
    CHECK(faultsOf(kGoodScene + text).size() == 1);
  }
  CHECK(faultsOf("texture.windows = [8, 'x']\ntexture.first_iterations = [3]\n" + kGoodScene).size() == 1);
}

TEST_CASE("checks: the size is known but for a liquid out of files", "[scenes]") {
  Scene scene;
  CHECK(isSizeKnown(scene));
  scene.sim.size = Vec3d(0.0);
  CHECK_FALSE(isSizeKnown(scene));
}

}  // namespace fluidtex::scenes
