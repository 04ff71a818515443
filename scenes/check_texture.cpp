#include "scenes/checks.h"
#include "scenes/schema.h"
#include "scenes/value_text.h"
#include "texture/map_names.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <set>

namespace fluidtex::scenes {
namespace {

// Files may hold one, which is seen when they are read.
bool hasTemperature(const Scene& scene) {
  return scene.sim.heat.simulated || scene.motion.flow == sim::MotionKind::files;
}

bool hasMixture(const Scene& scene) {
  return scene.sim.mixes() || scene.motion.flow == sim::MotionKind::files;
}

// The solver's own liquid has a temperature and a mixture at most; what files hold is seen when they are
// read.
void checkAttribute(const Scene& scene, const std::string& path, const std::string& attribute,
                    Reader& reader) {
  const std::string key = path + ".attribute";
  if (!reader.clean(key)) return;
  if (attribute.empty())
    reader.fault(path, "names no attribute", "give attribute = \"NAME\", one that `fluidtex check` lists");
  else if (scene.motion.flow != sim::MotionKind::files &&
           !(attribute == "temperature" && hasTemperature(scene)) &&
           !(attribute == "mixture" && hasMixture(scene)))
    reader.fault(key, "the liquid has no \"" + attribute + "\"",
                 "give \"temperature\" with simulate = true in [heat], \"mixture\" where a [[liquid]] or "
                 "[[source]] has one, or a liquid out of files");
}

// To two digits, as a length that can be recommended.
double roundedUp(double length) {
  const double step = std::pow(10.0, std::floor(std::log10(length)) - 1.0);
  return std::ceil(length / step) * step;
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
  if (reader.clean(path + ".align") && orientation.align == texture::Align::attribute)
    checkAttribute(scene, path, orientation.attribute, reader);
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

// path: of the factor's table.
void checkFactor(const Scene& scene, const texture::FactorOptions& factor,
                 const std::vector<sim::Shape>& from, const std::string& path, Reader& reader) {
  const std::string by = path + ".by";
  for (std::size_t i = 0; i < from.size(); ++i)
    checkShape(from[i], path + ".from." + std::to_string(i), reader);
  checkCurve(factor.points, path + ".point", reader);
  if (!reader.clean(by) || factor.by == texture::FactorBy::none) return;
  if (factor.points.empty())
    reader.fault(by, "is of no use without a factor",
                 "give one [[" + path + ".point]] or more, each with a value and a factor");
  if (factor.by == texture::FactorBy::distance && from.empty())
    reader.fault(by, "\"distance\" is from nothing", "give a shape or more as [[" + path + ".from]]");
  if (factor.by == texture::FactorBy::temperature && !hasTemperature(scene))
    reader.fault(by, "\"temperature\" is not computed", "give simulate = true in [heat] too");
  if (factor.by == texture::FactorBy::attribute) checkAttribute(scene, path, factor.attribute, reader);
}

void checkGuidance(const Scene& scene, Reader& reader) {
  const texture::GuidanceOptions& guidance = scene.texture.guidance;
  const std::string path = "texture.guidance", by = path + ".by";
  checkCurve(guidance.points, path + ".point", reader);
  if (!reader.clean(by) || guidance.by == texture::GuidanceBy::none) return;
  if (guidance.points.empty())
    reader.fault(by, "is of no use without a level",
                 "give one [[texture.guidance.point]] or more, each with a value and a level");
  if (guidance.by == texture::GuidanceBy::temperature && !hasTemperature(scene))
    reader.fault(by, "\"temperature\" is not computed", "give simulate = true in [heat] too");
  if (guidance.by == texture::GuidanceBy::mixture && !hasMixture(scene))
    reader.fault(by, "\"mixture\" is the same everywhere", "give a [[liquid]] or [[source]] mixture = 1");
  if (guidance.by == texture::GuidanceBy::attribute) checkAttribute(scene, path, guidance.attribute, reader);
  const std::string full = path + ".foam.full";
  if (reader.clean(full) && !(guidance.foam.full > guidance.foam.from))
    reader.fault(full, written(guidance.foam.full) + " is not above from, " + written(guidance.foam.from),
                 "give a larger one");
}

void checkStart(const Scene& scene, Reader& reader) {
  const std::string file = "texture.start.file";
  if (scene.start.mesh.file.empty() || !reader.clean(file)) return;
  if (!scene.texture.exemplar.animation.pattern.empty())
    reader.fault(file, "the mesh has one picture, and the exemplar is a sequence",
                 "give its picture as texture.exemplar");
}

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
    if (reader.clean(path + ".weight") && map.weight > 0.0 && map.holds != texture::MapHolds::values)
      reader.fault(path + ".weight", "vectors turn with the texture and cannot be matched",
                   "leave weight out, or match a map of values, the heights for example");
    if (!reader.clean(key)) continue;
    const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
    if (!reader.given(key))
      reader.fault(path, "has no name", "give name = \"height\" or whatever it holds");
    else if (!std::all_of(name.begin(), name.end(), fits) ||
             std::isdigit(static_cast<unsigned char>(name.front())))
      reader.fault(key, "\"" + name + "\" cannot be the name of a vertex's property",
                   "give letters, digits and _, a letter first");
    else if (texture::isReservedName(name))
      reader.fault(key, "\"" + name + "\" is the name of a property that vertices have anyway",
                   "give another name");
    else
      checkMapName(map, names, reader, key);
  }
}

void checkWindows(const Scene& scene, Reader& reader) {
  const texture::SynthesisOptions& synthesis = scene.texture.synthesis;
  const std::vector<int>& windows = synthesis.windows;
  if (!reader.clean("texture.windows")) return;
  const auto even = std::find_if(windows.begin(), windows.end(), [](int window) { return window % 2 == 0; });
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
                 "a list of " + std::to_string(iterations.size()) + " for " + std::to_string(windows.size()) +
                     (windows.size() == 1 ? " window" : " windows"),
                 "give one number for each of texture.windows");
  };
  checkCount("texture.first_iterations", synthesis.firstIterations);
  checkCount("texture.later_iterations", synthesis.laterIterations);
}

void checkSpacing(const Scene& scene, Reader& reader) {
  if (!reader.clean("texture.spacing") || !reader.clean("domain.size") || !isSizeKnown(scene)) return;
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

void checkAnimation(const Scene& scene, Reader& reader) {
  const texture::AnimationOptions& animation = scene.texture.exemplar.animation;
  const std::string path = "texture.animation", by = path + ".by";
  const bool moves = !animation.pattern.empty();
  if (!moves) {
    // Another picture than the scene's own may be given instead of a sequence.
    const bool own = reader.clean("texture.exemplar") && !reader.originOf("texture.exemplar").commandLine();
    if (own && reader.given(path))
      reader.fault(path, "the exemplar is one picture",
                   "give a sequence of them, for example exemplar = \"lava_%04d.png\"");
    return;
  }
  if (reader.clean("texture.between") && scene.texture.exemplar.between == texture::Between::file)
    reader.fault("texture.between", "\"file\" is one picture, and the exemplar a sequence",
                 "give \"points\" or \"exemplar\"");
  if (!reader.clean(by) || animation.by != texture::ShowBy::guidance) return;
  const std::string map = "texture.guidance.map";
  if (reader.given(map))
    reader.fault(map, "is of no use: guidance chooses pictures of the sequence, not places in them",
                 "leave it out, or give texture.animation.by = \"time\"");
  if (scene.texture.guidance.by == texture::GuidanceBy::none)
    reader.fault(by, "there is no guidance to choose the picture",
                 "give [texture.guidance] with by and [[texture.guidance.point]], or by = \"time\"");
  if (reader.clean("texture.between") && scene.texture.exemplar.between == texture::Between::exemplar)
    reader.fault("texture.between",
                 "\"exemplar\" is one picture for all places, and by = \"guidance\" shows many",
                 "give \"points\"");
}

}  // namespace

void checkTexture(const Scene& scene, Reader& reader) {
  checkFactor(scene, scene.texture.scale, scene.scaleFrom, "texture.scale", reader);
  checkFactor(scene, scene.texture.renewal, scene.renewalFrom, "texture.renewal", reader);
  checkStart(scene, reader);
  checkGuidance(scene, reader);
  checkAnimation(scene, reader);
  checkMaps(scene, reader);
  checkOrientation(scene, reader);
  if (!scene.onto.files.empty() && reader.clean("frames")) checkSequence(scene.onto, "texture.onto", reader);
  checkWindows(scene, reader);
  checkSpacing(scene, reader);
}

}  // namespace fluidtex::scenes
