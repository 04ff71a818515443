#include "scenes/checks.h"
#include "scenes/schema.h"
#include "scenes/value_text.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <system_error>

namespace fluidtex::scenes {
namespace {

// A grid needs some cells across to tell liquid, surface and wall apart.
constexpr double kFewestCells = 4.0;

void checkDomain(const Scene& scene, Reader& reader) {
  if (!reader.clean("domain") || !isSizeKnown(scene)) return;
  for (int axis = 0; axis < 3; ++axis) {
    const double cells = scene.sim.size[axis] / scene.sim.voxelSize();
    if (cells >= kFewestCells) continue;
    reader.fault("domain.size", std::string(kAxes[axis]) + " is only " + written(cells) + " cells long",
                 "give a longer side or a higher domain.resolution, so that it is " + written(kFewestCells) +
                     " or more");
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

bool isBounded(const sim::Box& box) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(box.min[axis]) || !std::isfinite(box.max[axis])) return false;
  }
  return true;
}

void checkPlace(const sim::Shape& shape, const std::string& path, const Scene& scene, Reader& reader) {
  checkShape(shape, path, reader);
  if (!reader.clean(path) || !reader.clean("domain")) return;
  const sim::Box domain = domainOf(scene.sim);
  if (!reachesDomain(shape, domain)) {
    reader.fault(path, "lies wholly outside the domain",
                 "put at least a part of it between [0, 0, 0] and " + written(scene.sim.size) +
                     (isBounded(domain) ? "" : ", or beyond a side that is unbounded"));
  } else if (!endsInDomain(shape, domain)) {
    reader.fault(path, "has no end on a side of the domain that is unbounded",
                 "give a shape that ends, for example a box, or a side of another kind");
  }
}

void checkFlows(const Scene& scene, Reader& reader) {
  for (std::size_t i = 0; i < scene.sim.sources.size(); ++i) {
    const std::string path = "source." + std::to_string(i);
    checkPlace(scene.sim.sources[i].shape, path, scene, reader);
    checkTimes(scene.sim.sources[i].from, scene.sim.sources[i].until, path, reader);
    checkOrder(scene.sim.sources[i].rate, path + ".rate", reader);
  }
  for (std::size_t i = 0; i < scene.sim.drains.size(); ++i) {
    const std::string path = "drain." + std::to_string(i);
    checkPlace(scene.sim.drains[i].shape, path, scene, reader);
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

void checkFiles(const Scene& scene, Reader& reader) {
  if (!reader.clean("motion.flow") || !reader.clean("files")) return;
  const bool used = scene.motion.flow == sim::MotionKind::files;
  if (used && scene.files.path.empty())
    reader.fault("files.path", "missing key",
                 "give the cache of another program: its folder, or a pattern such as \"water_####.vdb\"");
  if (!used && reader.given("files"))
    reader.fault("files", "is of no use here", "give it together with motion.flow = \"files\"");
  // A scene of a simulation may get its flow from the command line; and to the program's own frames belongs
  // the scene that they are of, since the texture goes by what flows in.
  std::error_code unknown;
  if (!used || reader.originOf("motion.flow").commandLine() ||
      std::filesystem::exists(scene.files.path / caches::kRecordingFile, unknown))
    return;
  for (const char* key : {"liquid", "source", "drain"})
    if (reader.given(key))
      reader.fault(key, "is of no use beside a liquid out of files",
                   "leave it out, or give motion.flow = \"solver\"");
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
  for (const char* key : {"speed", "strain", "widening"}) ofUse(key, {MotionKind::slot}, "\"slot\"");
  checkFiles(scene, reader);
  if (flow == MotionKind::solver || flow == MotionKind::files || !reader.clean("motion.flow")) return;
  if (reader.clean("domain") && !isBounded(domainOf(scene.sim)))
    reader.fault("domain.sides", "a flow in closed form is known inside the domain only",
                 "give no side that is \"unbounded\", or give motion.flow = \"solver\"");
  for (const char* key : {"solid", "source", "drain"})
    if (reader.given(key))
      reader.fault(key, "is of no use with a flow in closed form, which knows of no other bodies",
                   "leave it out, or give motion.flow = \"solver\"");
  if (scene.sim.heat.simulated)
    reader.fault("heat.simulate", "is of no use with a flow in closed form, which knows no temperature",
                 "leave it out, or give motion.flow = \"solver\"");
  for (std::size_t i = 0; i < scene.sim.liquid.size(); ++i) {
    const std::string path = "liquid." + std::to_string(i) + ".from";
    if (reader.clean(path) && scene.sim.liquid[i].from > 0.0)
      reader.fault(path, "a flow in closed form moves what is there from the start", "leave it out");
  }
}

void checkBodies(const Scene& scene, Reader& reader) {
  if (scene.motion.flow != sim::MotionKind::files && scene.sim.liquid.empty() && scene.sim.sources.empty() &&
      reader.clean("liquid") && reader.clean("source"))
    reader.fault("liquid", reader.given("liquid") ? "an empty list" : "missing key",
                 "give at least one [[liquid]] or one [[source]]");
  for (std::size_t i = 0; i < scene.sim.liquid.size(); ++i)
    checkPlace(scene.sim.liquid[i].shape, "liquid." + std::to_string(i), scene, reader);
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

}  // namespace

void checkLiquid(const Scene& scene, Reader& reader) {
  checkDomain(scene, reader);
  checkBodies(scene, reader);
  checkKnownFlow(scene, reader);
  checkHeat(scene.sim.heat.law, reader);
  checkFlows(scene, reader);
}

}  // namespace fluidtex::scenes
