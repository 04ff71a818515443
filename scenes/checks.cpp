#include "scenes/checks.h"

#include "scenes/format.h"
#include "scenes/schema.h"
#include "texture/vector_maps.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace fluidtex::scenes {

namespace {

// A grid needs some cells across to tell liquid, surface and wall apart.
constexpr double kFewestCells = 4.0;

// As many as texture.points may be.
constexpr double kMostPoints = 50e6;

const char* const kAxes[] = {"x", "y", "z"};

// As many iterations as there are windows: the defaults, the last one repeated.
std::vector<int> fitted(std::vector<int> iterations, std::size_t windows) {
  const int last = iterations.back();
  iterations.resize(windows, last);
  return iterations;
}

// What coherence says of keys that are not given. Half of it leaves their defaults; towards 1 what is kept
// may be stretched more and more (log), less is renewed in a second, and it fades slower; towards 0 all of
// that less. None of it: each frame alone.
void followCoherence(texture::Options& texture, const Reader& reader) {
  constexpr double kMostStretch = 8.0, kLongestFade = 2.0;  // torn; s
  texture::SynthesisOptions& synthesis = texture.synthesis;
  const double coherence = texture.coherence;
  if (coherence == 0.5) return;
  if (coherence == 0.0 && !reader.given("texture.later_frames"))
    texture.laterFrames = texture::LaterFrames::alone;
  const double more = std::max(coherence, 1e-3) / std::max(1.0 - coherence, 1e-3);
  if (!reader.given("texture.keep_stretch"))
    synthesis.keepStretch = std::min(std::pow(synthesis.keepStretch, more), kMostStretch);
  if (!reader.given("texture.renewal_rate")) synthesis.renewalRate /= more;
  if (!reader.given("texture.fade")) synthesis.fade = std::min(synthesis.fade * more, kLongestFade);
}

// To two digits, as a length that can be recommended.
double roundedUp(double length) {
  const double step = std::pow(10.0, std::floor(std::log10(length)) - 1.0);
  return std::ceil(length / step) * step;
}

void checkDomain(const Scene& scene, Reader& reader) {
  if (!reader.clean("domain")) return;
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = scene.sim.size[axis] / scene.sim.voxelSize();
    if (cells >= kFewestCells) continue;
    reader.fault("domain.size", std::string(kAxes[axis]) + " is only " + written(cells) + " cells long",
                 "give a longer side or a higher domain.resolution, so that it is " + written(kFewestCells) +
                     " or more");
  }
}

void checkSequence(const sim::MeshSequence& sequence, const std::string& path, Reader& reader) {
  if (!reader.clean(path)) return;
  if (sequence.last < sequence.first) {
    reader.fault(path + ".last",
                 written(sequence.last) + " is before first, which is " + written(sequence.first),
                 "give the number of the last file");
    return;
  }
  for (int n = 0; n < sequence.count(); ++n) {
    const std::filesystem::path file = sequence.fileOf(n);
    std::error_code error;
    if (std::filesystem::is_regular_file(file, error)) continue;
    reader.fault(path + ".files", "no such file: " + file.string(),
                 "give all from number " + written(sequence.first) + " to " + written(sequence.last));
    return;
  }
}

void checkShape(const sim::Shape& shape, const std::string& path, Reader& reader) {
  const auto checkParts = [&](const std::vector<sim::Shape>& parts, const std::string& key) {
    for (std::size_t i = 0; i < parts.size(); ++i)
      checkShape(parts[i], path + "." + key + "." + std::to_string(i), reader);
  };
  if (const auto* box = std::get_if<sim::Box>(&shape.kind)) {
    if (!reader.clean(path + ".box")) return;
    for (int axis = 0; axis < 3; ++axis) {
      if (box->min[axis] < box->max[axis]) continue;
      reader.fault(path + ".box.max",
                   std::string(kAxes[axis]) + " is " + written(box->max[axis]) + ", not above min's " +
                       written(box->min[axis]),
                   "give a max that is greater than min in x, y and z");
    }
  } else if (const auto* cylinder = std::get_if<sim::Cylinder>(&shape.kind)) {
    if (reader.clean(path + ".cylinder") && cylinder->from == cylinder->to)
      reader.fault(path + ".cylinder.to", "is the same point as from", "give the middle of the other end");
  } else if (const auto* ground = std::get_if<sim::HeightField>(&shape.kind)) {
    if (reader.clean(path + ".height_field") && !(ground->low < ground->high))
      reader.fault(path + ".height_field.high",
                   written(ground->high) + " is not above low's " + written(ground->low),
                   "give the height of white in metres, greater than that of black");
  } else if (std::holds_alternative<sim::MeshSequence>(shape.kind)) {
    reader.fault(path + ".mesh_sequence", "only the whole shape of a [[solid]] can change",
                 "give mesh with one of its files");
  } else if (const auto* space = std::get_if<sim::HalfSpace>(&shape.kind)) {
    if (reader.clean(path + ".half_space") && space->normal.length() == 0.0)
      reader.fault(path + ".half_space.normal", "has no length",
                   "give the direction out of the shape, for example [0, 0, 1]");
  } else if (const auto* both = std::get_if<sim::Union>(&shape.kind)) {
    checkParts(both->parts, "union");
  } else if (const auto* rest = std::get_if<sim::Difference>(&shape.kind)) {
    checkParts(rest->parts, "difference");
    if (reader.clean(path + ".difference") && rest->parts.size() == 1)
      reader.fault(path + ".difference", "has one part only",
                   "give the shape and, after it, what is taken away from it");
  }
}

void checkTimes(double from, double until, const std::string& path, Reader& reader) {
  if (!reader.clean(path + ".from") || !reader.clean(path + ".until") || from < until) return;
  reader.fault(path + (reader.given(path + ".until") ? ".until" : ".from"),
               "until " + written(until) + " s is not after from " + written(from) + " s",
               "give an until that is greater than from");
}

// Keyframes and the points of a rate follow each other in time.
template <class Point>
void checkOrder(const std::vector<Point>& points, const std::string& path, Reader& reader) {
  for (std::size_t i = 1; reader.clean(path) && i < points.size(); ++i) {
    if (points[i - 1].time < points[i].time) continue;
    reader.fault(
        path + "." + std::to_string(i) + ".time",
        written(points[i].time) + " s is not after the one before, at " + written(points[i - 1].time) + " s",
        "give them in the order of time");
  }
}

void checkMotion(const sim::Solid& solid, const std::string& path, Reader& reader) {
  checkOrder(solid.keyframes, path + ".keyframe", reader);
  if (reader.clean(path + ".axis") && solid.axis.length() == 0.0)
    reader.fault(path + ".axis", "has no length", "give the direction it turns about, for example [0, 0, 1]");
}

void checkHeat(const sim::ViscosityLaw& law, Reader& reader) {
  if (!reader.clean("heat.law") || !reader.clean("heat.point")) return;
  const bool table = law.kind == sim::ViscosityLaw::Kind::table;
  if (table && law.points.size() < 2)
    reader.fault("heat.law", "\"table\" has fewer than two points",
                 "give two [[heat.point]] or more, each with a temperature and a viscosity");
  if (!table && !law.points.empty())
    reader.fault("heat.point", "is of no use here", "give it together with law = \"table\"");
  for (std::size_t i = 1; i < law.points.size(); ++i) {
    if (law.points[i - 1].temperature < law.points[i].temperature) continue;
    reader.fault("heat.point." + std::to_string(i) + ".temperature",
                 written(law.points[i].temperature) + " K is not above the one before, " +
                     written(law.points[i - 1].temperature) + " K",
                 "give them by rising temperature");
  }
}

void checkFlows(const Scene& scene, Reader& reader) {
  const auto checkPlace = [&](const sim::Shape& shape, const std::string& path) {
    checkShape(shape, path, reader);
    if (reader.clean(path) && reader.clean("domain.size") && !reachesDomain(shape, scene.sim.size)) {
      reader.fault(path, "lies wholly outside the domain",
                   "put at least a part of it between [0, 0, 0] and " + written(scene.sim.size));
    }
  };
  for (std::size_t i = 0; i < scene.sim.sources.size(); ++i) {
    const std::string path = "source." + std::to_string(i);
    checkPlace(scene.sim.sources[i].shape, path);
    checkTimes(scene.sim.sources[i].from, scene.sim.sources[i].until, path, reader);
    checkOrder(scene.sim.sources[i].rate, path + ".rate", reader);
  }
  for (std::size_t i = 0; i < scene.sim.drains.size(); ++i) {
    const std::string path = "drain." + std::to_string(i);
    checkPlace(scene.sim.drains[i].shape, path);
    checkTimes(scene.sim.drains[i].from, scene.sim.drains[i].until, path, reader);
  }
}

void checkWall(const sim::Wall& wall, const std::string& path, Reader& reader) {
  if (!reader.clean(path + ".wall")) return;
  if (wall.kind != sim::WallKind::friction && reader.given(path + ".slip_length"))
    reader.fault(path + ".slip_length", "is of no use here", "give it together with wall = \"friction\"");
  if (wall.kind == sim::WallKind::slip && reader.given(path + ".wall_velocity"))
    reader.fault(path + ".wall_velocity", "a wall that slips drags nothing along",
                 "give it together with wall = \"no_slip\" or \"friction\"");
}

void checkVolume(const Scene& scene, Reader& reader) {
  const auto& sides = scene.sim.sides;
  const bool closed =
      scene.sim.sources.empty() && scene.sim.drains.empty() &&
      std::all_of(sides.begin(), sides.end(), [](sim::Side side) { return side == sim::Side::wall; });
  if (scene.sim.keepVolume && !closed && reader.clean("simulation.keep_volume")) {
    reader.fault(
        "simulation.keep_volume",
        "is for scenes where no liquid comes or goes, and this one has a source, a drain or an open side",
        "leave it out");
  }
}

// A flow in closed form moves what is there from the start, and knows nothing else.
void checkKnownFlow(const Scene& scene, Reader& reader) {
  using sim::MotionKind;
  const MotionKind flow = scene.motion.flow;
  const auto ofUse = [&](const char* key, std::initializer_list<MotionKind> to, const char* names) {
    const std::string path = std::string("motion.") + key;
    if (!reader.given(path) || !reader.clean("motion.flow")) return;
    if (std::find(to.begin(), to.end(), flow) == to.end())
      reader.fault(path, "is of no use here", std::string("give it together with flow = ") + names);
  };
  ofUse("period", {MotionKind::vortex, MotionKind::deformation}, "\"vortex\" or \"deformation\"");
  ofUse("rate", {MotionKind::rotation, MotionKind::vortex, MotionKind::stretch, MotionKind::sourceSink},
        "\"rotation\", \"vortex\", \"stretch\" or \"source_sink\"");
  if (flow == MotionKind::solver || !reader.clean("motion.flow")) return;
  for (const char* key : {"solid", "source", "drain"})
    if (reader.given(key))
      reader.fault(key, "is of no use with a flow in closed form, which knows of no other bodies",
                   "leave it out, or give motion.flow = \"solver\"");
  for (std::size_t i = 0; i < scene.sim.liquid.size(); ++i) {
    const std::string path = "liquid." + std::to_string(i) + ".from";
    if (reader.clean(path) && scene.sim.liquid[i].from > 0.0)
      reader.fault(path, "a flow in closed form moves what is there from the start", "leave it out");
  }
}

void checkBodies(const Scene& scene, Reader& reader) {
  if (scene.sim.liquid.empty() && scene.sim.sources.empty() && reader.clean("liquid") &&
      reader.clean("source"))
    reader.fault("liquid", reader.given("liquid") ? "an empty list" : "missing key",
                 "give at least one [[liquid]] or one [[source]]");
  for (std::size_t i = 0; i < scene.sim.liquid.size(); ++i) {
    const std::string path = "liquid." + std::to_string(i);
    checkShape(scene.sim.liquid[i].shape, path, reader);
    if (reader.clean(path) && reader.clean("domain.size") &&
        !reachesDomain(scene.sim.liquid[i].shape, scene.sim.size)) {
      reader.fault(path, "lies wholly outside the domain",
                   "put at least a part of it between [0, 0, 0] and " + written(scene.sim.size));
    }
  }
  for (std::size_t i = 0; i < scene.sim.walls.size(); ++i)
    checkWall(scene.sim.walls[i].wall, "wall." + std::to_string(i), reader);
  std::map<std::string, std::string> firstOfName;
  for (std::size_t i = 0; i < scene.sim.solids.size(); ++i) {
    const sim::Solid& solid = scene.sim.solids[i];
    const std::string path = "solid." + std::to_string(i);
    if (const auto* sequence = std::get_if<sim::MeshSequence>(&solid.shape.kind))
      checkSequence(*sequence, path + ".mesh_sequence", reader);
    else
      checkShape(solid.shape, path, reader);
    checkTimes(solid.from, solid.until, path, reader);
    checkWall(solid.wall, path, reader);
    checkMotion(solid, path, reader);
    if (!reader.clean(path + ".name")) continue;
    const auto [first, isNew] = firstOfName.emplace(solid.name, path);
    if (!isNew)
      reader.fault(path + ".name", "\"" + solid.name + "\" is the name of " + first->second + " too",
                   "give each solid a name of its own");
  }
}

void checkOrientation(const Scene& scene, Reader& reader) {
  const texture::OrientationOptions& orientation = scene.texture.orientation;
  const std::string path = "texture.orientation";
  if (reader.clean(path + ".symmetry") && orientation.symmetry == 3)
    reader.fault(path + ".symmetry", "3 is no symmetry of square pieces of a picture", "give 1, 2 or 4");
  if (reader.clean(path + ".align") && orientation.align == texture::Align::curvature &&
      orientation.symmetry == 1)
    reader.fault(path + ".align", "the line in which a surface bends has no forward end",
                 "give symmetry = 2 or 4 with it");
  if (reader.clean(path + ".direction") && orientation.align == texture::Align::direction &&
      orientation.direction.length() == 0.0)
    reader.fault(path + ".direction", "has no length", "give a vector that points somewhere");
  for (std::size_t i = 0; i < scene.keepClear.size(); ++i)
    checkShape(scene.keepClear[i], path + ".keep_clear." + std::to_string(i), reader);
}

void checkCurve(const std::vector<texture::CurvePoint>& points, const std::string& path, Reader& reader) {
  for (std::size_t i = 1; reader.clean(path) && i < points.size(); ++i) {
    if (points[i - 1].value < points[i].value) continue;
    reader.fault(path + "." + std::to_string(i) + ".value",
                 written(points[i].value) + " is not above the one before, " + written(points[i - 1].value),
                 "give them by rising value");
  }
}

void checkScale(const Scene& scene, Reader& reader) {
  const texture::ScaleOptions& scale = scene.texture.scale;
  const std::string path = "texture.scale", by = path + ".by";
  for (std::size_t i = 0; i < scene.scaleFrom.size(); ++i)
    checkShape(scene.scaleFrom[i], path + ".from." + std::to_string(i), reader);
  checkCurve(scale.points, path + ".point", reader);
  if (!reader.clean(by) || scale.by == texture::ScaleBy::none) return;
  if (scale.points.empty())
    reader.fault(by, "is of no use without a factor",
                 "give one [[texture.scale.point]] or more, each with a value and a factor");
  if (scale.by == texture::ScaleBy::distance && scene.scaleFrom.empty())
    reader.fault(by, "\"distance\" is from nothing", "give a shape or more as [[texture.scale.from]]");
  if (scale.by == texture::ScaleBy::temperature && !scene.sim.heat.simulated)
    reader.fault(by, "\"temperature\" is not computed", "give simulate = true in [heat] too");
}

void checkGuidance(const Scene& scene, Reader& reader) {
  const texture::GuidanceOptions& guidance = scene.texture.guidance;
  const std::string path = "texture.guidance", by = path + ".by";
  checkCurve(guidance.points, path + ".point", reader);
  if (!reader.clean(by) || guidance.by == texture::GuidanceBy::none) return;
  if (guidance.points.empty())
    reader.fault(by, "is of no use without a level",
                 "give two [[texture.guidance.point]] or more, each with a value and a level");
  if (guidance.by == texture::GuidanceBy::temperature && !scene.sim.heat.simulated)
    reader.fault(by, "\"temperature\" is not computed", "give simulate = true in [heat] too");
}

// Names that the vertices of a PLY have anyway.
const std::set<std::string> kVertexNames = {
    "x",  "y",     "z",   "nx",      "ny",       "nz",     "red",    "green", "blue", "alpha",
    "s",  "t",     "dx",  "dy",      "dz",       "bx",     "by",     "bz",    "vx",   "vy",
    "vz", "trust", "age", "contact", "guidance", "fade_s", "fade_t", "fade", "scale"};

// Of all properties that the maps before have; a map of vectors has three.
void checkMapName(const texture::MapOptions& map, std::set<std::string>& names, Reader& reader,
                  const std::string& key) {
  std::vector<std::string> own{map.name};
  if (map.holds != texture::MapHolds::values) {
    for (const std::string& part : texture::vectorNames(map.name)) own.push_back(part);
  }
  bool free = true;
  for (const std::string& name : own) free &= names.insert(name).second;
  if (!free)
    reader.fault(key, "\"" + map.name + "\" is the name of an earlier map too",
                 "give each map a name of its own");
}

void checkMaps(const Scene& scene, Reader& reader) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < scene.texture.exemplar.maps.size(); ++i) {
    const texture::MapOptions& map = scene.texture.exemplar.maps[i];
    const std::string& name = map.name;
    const std::string path = "texture.map." + std::to_string(i), key = path + ".name";
    if (!reader.clean(key)) continue;
    const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    if (!reader.given(key))
      reader.fault(path, "has no name", "give name = \"height\" or whatever it holds");
    else if (!std::all_of(name.begin(), name.end(), fits) ||
             std::isdigit(static_cast<unsigned char>(name.front())))
      reader.fault(key, "\"" + name + "\" cannot be the name of a vertex's property",
                   "give letters, digits and _, a letter first");
    else if (kVertexNames.contains(name))
      reader.fault(key, "\"" + name + "\" is what every vertex has anyway", "give another name");
    else
      checkMapName(map, names, reader, key);
  }
}

void checkTexture(const Scene& scene, Reader& reader) {
  checkScale(scene, reader);
  checkGuidance(scene, reader);
  checkMaps(scene, reader);
  checkOrientation(scene, reader);
  if (!scene.onto.files.empty() && reader.clean("frames")) checkSequence(scene.onto, "texture.onto", reader);
  const texture::SynthesisOptions& synthesis = scene.texture.synthesis;
  const std::vector<int>& windows = synthesis.windows;
  if (reader.clean("texture.windows")) {
    const auto even =
        std::find_if(windows.begin(), windows.end(), [](int window) { return window % 2 == 0; });
    if (even != windows.end()) {
      reader.fault("texture.windows", std::to_string(*even) + " is even",
                   "give odd widths, for example " + std::to_string(*even + 1));
    }
    const auto notFalling = std::adjacent_find(windows.begin(), windows.end(), std::less_equal<>());
    if (notFalling != windows.end()) {
      reader.fault(
          "texture.windows",
          std::to_string(*(notFalling + 1)) + " after " + std::to_string(*notFalling) + " does not fall",
          "give widths from large to small, for example [33, 17, 9]");
    }
    const auto checkCount = [&](const std::string& path, const std::vector<int>& iterations) {
      if (!reader.clean(path) || iterations.size() == windows.size()) return;
      reader.fault(path,
                   "a list of " + std::to_string(iterations.size()) + " for " +
                       std::to_string(windows.size()) + (windows.size() == 1 ? " window" : " windows"),
                   "give one number for each of texture.windows");
    };
    checkCount("texture.first_iterations", synthesis.firstIterations);
    checkCount("texture.later_iterations", synthesis.laterIterations);
  }
  if (!reader.clean("texture.spacing") || !reader.clean("domain.size")) return;
  const Vec3d& size = scene.sim.size;
  const double spacing = scene.texture.spacing, shortest = std::min({size[0], size[1], size[2]});
  if (spacing >= shortest) {
    reader.fault("texture.spacing",
                 written(spacing) + " m is as long as the domain's shortest side or longer",
                 "give less than " + written(shortest) + " m");
  }
  const double faces = 2.0 * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]);
  if (spacing > 0.0 && faces / spacing / spacing > kMostPoints) {
    reader.fault("texture.spacing",
                 written(spacing) + " m would put more than " + written(kMostPoints) +
                     " points on the domain's six faces",
                 "give " + written(roundedUp(std::sqrt(faces / kMostPoints))) + " m or more");
  }
}

void checkPicture(const Scene& scene, Reader& reader) {
  const render::Options& render = scene.render;
  if (reader.clean("camera.from") && reader.clean("camera.at") && render.camera.from == render.camera.at) {
    reader.fault(reader.given("camera.from") ? "camera.from" : "camera.at",
                 "the camera stands at the point it looks at",
                 "give camera.from and camera.at different places");
  }
  if (reader.clean("light.sun_direction") && render.light.sunDirection.length() == 0.0)
    reader.fault("light.sun_direction", "has no length",
                 "give the direction towards the sun, for example [-0.5, -0.4, 0.8]");
  for (int side : {render.width, render.height}) {
    if (reader.clean("render.size") && side % 2 != 0) {
      reader.fault("render.size", std::to_string(side) + " is odd",
                   "give even numbers, as the video needs, for example " + std::to_string(side + 1));
    }
  }
}

}  // namespace

void complete(Scene& scene, const Reader& reader) {
  if (scene.name.empty()) scene.name = scene.file.stem().string();
  scene.texture.surface.seed = scene.texture.synthesis.seed = scene.seed;
  scene.onto.last = scene.onto.first + scene.frames - 1;

  for (std::size_t i = 0; i < scene.sim.solids.size(); ++i) {
    std::string& name = scene.sim.solids[i].name;
    if (name.empty()) name = "solid " + std::to_string(i);
    auto* sequence = std::get_if<sim::MeshSequence>(&scene.sim.solids[i].shape.kind);
    if (sequence && !reader.given("solid." + std::to_string(i) + ".mesh_sequence.frame_rate"))
      sequence->frameRate = scene.sim.frameRate;
  }

  texture::SynthesisOptions& synthesis = scene.texture.synthesis;
  followCoherence(scene.texture, reader);
  if (!reader.given("texture.first_iterations"))
    synthesis.firstIterations = fitted(synthesis.firstIterations, synthesis.windows.size());
  if (!reader.given("texture.later_iterations"))
    synthesis.laterIterations = fitted(synthesis.laterIterations, synthesis.windows.size());

  // The default view frames a domain of one metre; it grows with the domain.
  const render::Camera view;
  render::Camera& camera = scene.render.camera;
  const Vec3d& size = scene.sim.size;
  if (!reader.given("camera.at")) camera.at = view.at * size;
  if (!reader.given("camera.from"))
    camera.from = camera.at + (view.from - view.at) * std::max({size[0], size[1], size[2]});
}

void check(const Scene& scene, Reader& reader) {
  if (reader.clean("name") && scene.name.find_first_of("/\\") != std::string::npos)
    reader.fault("name", "\"" + scene.name + "\" holds a slash", "give a name that can be a file's");
  if (reader.clean("name") && (scene.name == "." || scene.name == ".."))
    reader.fault("name", "\"" + scene.name + "\" is a folder", "give a name that can be a file's");
  checkDomain(scene, reader);
  checkBodies(scene, reader);
  checkKnownFlow(scene, reader);
  checkHeat(scene.sim.heat.law, reader);
  checkFlows(scene, reader);
  checkVolume(scene, reader);
  checkTexture(scene, reader);
  checkPicture(scene, reader);
}

}  // namespace fluidtex::scenes
