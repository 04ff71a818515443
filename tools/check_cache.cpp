#include "tools/check_cache.h"

#include "caches/layouts/layout.h"
#include "caches/liquid/bulk.h"
#include "caches/liquid/explained.h"
#include "caches/liquid/face_sampler.h"
#include "caches/liquid/read_frame.h"
#include "caches/liquid/velocity_grids.h"
#include "caches/recorded/recording.h"
#include "pipeline/take_cache.h"
#include "sim/grid/mac_grid.h"
#include "tools/base/atomic_file.h"
#include "tools/base/console.h"
#include "tools/base/two_digits.h"
#include "tools/common_options.h"

#include <fmt/core.h>
#include <openvdb/tools/Interpolation.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace fluidtex::tools {
namespace {

using Json = nlohmann::ordered_json;
using openvdb::Vec3d;

// Factors on velocities that are worth a word.
constexpr double kWrongBelow = 0.75, kWrongAbove = 1.33;
// Of the motion: with more left no factor says anything.
constexpr double kTellsNothing = 0.9;
// Times the first surface's area: less is the same number of points, as it is printed.
constexpr double kLarger = 1.05;
// Of the surface, before those away from the bulk are left out.
constexpr std::size_t kBulkPoints = 20000;
constexpr std::size_t kSpeedPoints = 2000;

// Where the distance left is smallest, as far as it is telling: less than half of that at rest.
bool isTelling(const caches::VelocityFactor& factor) {
  return factor.residual < 0.5 * factor.residualAtRest && factor.residual < 0.8 * factor.residualAsIs &&
         (factor.factor < kWrongBelow || factor.factor > kWrongAbove);
}

// Up to `pairs` frames before `last`, evenly taken from `first` on.
std::vector<int> beginsOf(int first, int last, int pairs) {
  std::vector<int> begins;
  const int count = std::min(pairs, last - first);
  begins.reserve(std::size_t(std::max(count, 0)));
  for (int n = 0; n < count; ++n)
    begins.push_back(count == 1 ? first : first + int(std::int64_t(last - 1 - first) * n / (count - 1)));
  return begins;
}

// Mean over a mesh of its distance from the level set phi = 0, in cells. Requires: some triangles.
double offsetOf(const caches::SurfaceTriangles& mesh, const openvdb::FloatGrid& phi) {
  const openvdb::tools::GridSampler<openvdb::FloatGrid, openvdb::tools::BoxSampler> distance(phi);
  double sum = 0.0, area = 0.0;
  for (const openvdb::Vec3I& triangle : mesh.triangles) {
    const Vec3d a = mesh.points[triangle[0]], b = mesh.points[triangle[1]], c = mesh.points[triangle[2]];
    const double weight = (b - a).cross(c - a).length();
    sum += weight * std::abs(double(distance.wsSample((a + b + c) / 3.0)));
    area += weight;
  }
  return area > 0.0 ? sum / area / phi.voxelSize()[0] : 0.0;
}

// Of a frame's surface alone.
ComparedFrames surfaceOf(const caches::LiquidFrame& frame, bool isMesh) {
  ComparedFrames result;
  result.area = caches::areaOf(frame.surface);
  if (isMesh) result.offset = offsetOf(frame.surface, *frame.phi);
  const openvdb::BBoxd bounds = caches::boundsOf(frame.surface);
  result.low = bounds.min();
  result.high = bounds.max();
  const std::size_t count = std::min<std::size_t>(frame.surface.points.size(), 3);
  result.first.assign(frame.surface.points.begin(), frame.surface.points.begin() + std::ptrdiff_t(count));
  return result;
}

// Leaves out the points that are near something thin, where they are or where they go.
std::vector<Vec3d> ofBulk(const std::vector<Vec3d>& points, const std::vector<Vec3d>& displacement,
                          const openvdb::FloatGrid& before, const openvdb::FloatGrid& after) {
  std::vector<Vec3d> moved(points);
  for (std::size_t n = 0; n < points.size(); ++n) moved[n] += displacement[n];
  const std::vector<bool> inBulk = caches::isInBulk(before, points),
                          staysThere = caches::isInBulk(after, moved);
  std::vector<Vec3d> result;
  for (std::size_t n = 0; n < points.size(); ++n)
    if (inBulk[n] && staysThere[n]) result.push_back(points[n]);
  return result;
}

std::optional<double> explainedOfBulk(const caches::LiquidFrame& begin, const caches::LiquidFrame& end,
                                      double meanWeight, double seconds) {
  const auto displaced = [&](const std::vector<Vec3d>& points) {
    return caches::displacements(points, begin.velocity, end.velocity, meanWeight, seconds);
  };
  const std::vector<Vec3d> all = caches::surfacePoints(*begin.phi, kBulkPoints);
  const std::vector<Vec3d> points = ofBulk(all, displaced(all), *begin.phi, *end.phi);
  return caches::explainedShare(points, displaced(points), *end.phi);
}

// Mean speed on the surface, m/s; 0 where none is known.
double meanSpeed(const caches::LiquidFrame& frame) {
  const caches::FaceSampler velocity(frame.velocity);
  double sum = 0.0;
  int count = 0;
  for (const Vec3d& x : caches::surfacePoints(*frame.phi, kSpeedPoints)) {
    Vec3d u;
    if (!velocity.at(x, u)) continue;
    sum += u.length();
    ++count;
  }
  return count > 0 ? sum / count : 0.0;
}

ComparedFrames compared(const caches::LiquidFrame& begin, const caches::LiquidFrame& end, bool isMesh,
                        double seconds, std::optional<caches::VelocityFactor>& factor) {
  ComparedFrames pair = surfaceOf(begin, isMesh);
  pair.fastest = sim::maxAbs(begin.velocity);
  pair.speed = meanSpeed(begin);
  const caches::FrameMotion motion =
      caches::bestMotion(*begin.phi, *end.phi, begin.velocity, end.velocity, seconds);
  factor = caches::bestFactor(*begin.phi, *end.phi, begin.velocity, end.velocity, motion.meanWeight, seconds);
  if (!motion.explained || !factor) return pair;
  pair.explained = motion.explained;
  pair.bulk = explainedOfBulk(begin, end, motion.meanWeight, seconds);
  pair.moved = factor->residualAtRest;
  pair.left = factor->residualAsIs;
  if (factor->residual < kTellsNothing * factor->residualAtRest) pair.ratio = factor->factor;
  return pair;
}

void printPair(const ComparedFrames& pair) {
  print("motion    {} to {}: speeds up to {:#.3g} m/s; ", pair.from, pair.to, pair.fastest);
  if (!pair.explained) {
    print("the surface moves too little to tell more\n");
    return;
  }
  print("the surface moves {:#.2g} cells; velocities explain {:.0f}% of it", *pair.moved,
        100.0 * *pair.explained);
  if (pair.bulk) print(", {:.0f}% away from thin parts", 100.0 * *pair.bulk);
  print(", {:#.2g} cells are left", *pair.left);
  if (pair.ratio) print("; displacement over velocity {:#.3g}", *pair.ratio);
  print("\n");
}

// Distance of this many points on a surface, m.
double spacingFor(double area, double points) {
  return std::sqrt(area / points);
}

template <class Triple>
Json tripleOf(const Triple& x) {
  return Json::array({x[0], x[1], x[2]});
}

Json firstOf(const ComparedFrames& pair) {
  Json points = Json::array();
  for (const openvdb::Vec3f& x : pair.first) points.push_back(tripleOf(x));
  return points;
}

void writeJson(const std::filesystem::path& file, const scenes::Scene& scene,
               const std::vector<ComparedFrames>& pairs) {
  const auto orNull = [](const std::optional<double>& value) { return value ? Json(*value) : Json(); };
  Json rows = Json::array();
  for (const ComparedFrames& pair : pairs)
    rows.push_back({{"from", pair.from},
                    {"to", pair.to},
                    {"fastest", pair.fastest},
                    {"speed", pair.speed},
                    {"area", pair.area},
                    {"offset", orNull(pair.offset)},
                    {"low", tripleOf(pair.low)},
                    {"high", tripleOf(pair.high)},
                    {"first", firstOf(pair)},
                    {"moved", orNull(pair.moved)},
                    {"left", orNull(pair.left)},
                    {"explained", orNull(pair.explained)},
                    {"bulk", orNull(pair.bulk)},
                    {"ratio", orNull(pair.ratio)}});
  const Json all = {{"cache", scene.files.path.generic_string()},
                    {"frames", scene.frames},
                    {"frame_rate", scene.sim.frameRate},
                    {"cell", scene.files.voxel},
                    {"pairs", rows}};
  writeTextAtomically(file, all.dump(1) + "\n");
}

}  // namespace

std::vector<ComparedFrames> compareFrames(const scenes::Scene& scene, int first, int last,
                                          const CheckCacheWishes& wishes) {
  std::vector<ComparedFrames> result;
  if (caches::isRecording(scene.files.path)) {
    if (!wishes.json.empty()) writeJson(wishes.json, scene, result);
    return result;
  }
  const caches::Cache cache{scene.files, caches::recognize(scene.files), scene.files.voxel,
                            scene.sim.frameRate};
  if (cache.layout.velocityKind == caches::VelocityKind::none) {
    if (!scene.files.fit)
      say("warning: no velocities were found; texture cannot follow the liquid without them, unless they are "
          "fitted to its surfaces, files.fit=true\n");
    else
      print("motion    fitted to the surfaces, since there are no velocities\n");
    if (!wishes.json.empty()) writeJson(wishes.json, scene, result);
    return result;
  }
  const bool isMesh = cache.layout.surfaceKind == caches::SurfaceKind::mesh;
  const std::vector<int> begins = beginsOf(first, last, wishes.pairs);
  std::vector<double> factors;
  std::pair<int, caches::LiquidFrame> read{-1, {}};  // the end of one pair may be the begin of the next
  for (const int frame : begins) {
    const int number = cache.layout.first + frame - 1;
    const caches::LiquidFrame begin =
        read.first == number ? std::move(read.second) : caches::readFrame(cache, number);
    read = {number + 1, caches::readFrame(cache, number + 1)};
    const caches::LiquidFrame& end = read.second;
    if (caches::isUnknown(begin.velocity) || caches::isUnknown(end.velocity) ||
        begin.surface.triangles.empty()) {
      print("motion    {} to {}: no surface, or no velocity\n", number, number + 1);
      continue;
    }
    std::optional<caches::VelocityFactor> factor;
    ComparedFrames pair = compared(begin, end, isMesh, 1.0 / scene.sim.frameRate, factor);
    pair.from = number;
    pair.to = number + 1;
    printPair(pair);
    result.push_back(pair);
    if (factor && isTelling(*factor)) factors.push_back(factor->factor);
  }
  if (!wishes.json.empty()) writeJson(wishes.json, scene, result);
  if (2 * factors.size() <= begins.size()) return result;
  std::sort(factors.begin(), factors.end());
  say("warning: surface and velocities would fit with velocities {:.3g} times as fast; "
      "files.velocity_scale={:.3g} "
      "makes them so\n",
      factors[factors.size() / 2], factors[factors.size() / 2] * scene.files.velocityScale);
  return result;
}

double printPoints(const scenes::Scene& scene, const std::vector<ComparedFrames>& compared) {
  if (compared.empty() || compared.front().area == 0.0) return 0.0;
  const double spacing = scene.texture.spacing > 0.0
                             ? scene.texture.spacing
                             : spacingFor(compared.front().area, scene.texture.points);
  const auto pointsOn = [&](const ComparedFrames& pair) { return pair.area / (spacing * spacing); };
  const auto less = [](const ComparedFrames& a, const ComparedFrames& b) { return a.area < b.area; };
  const ComparedFrames& largest = *std::max_element(compared.begin(), compared.end(), less);
  print("points    one every {:.2g} m: about {} in frame {}", spacing, twoDigits(pointsOn(compared.front())),
        compared.front().from);
  if (largest.area > kLarger * compared.front().area)
    print(", and the most, {}, in frame {} of those above", twoDigits(pointsOn(largest)), largest.from);
  print("\n");
  return pointsOn(largest);
}

void checkCache(const CommonOptions& options, const CheckCacheWishes& wishes) {
  scenes::Scene scene = scenes::sceneOfCache(options.scene, overridesOf(options, true));
  const std::vector<std::string> found = pipeline::takeCache(scene);
  int first = 1, last = 0;
  parseFrames(options.frames, scene, first, last);
  if (options.quiet && wishes.json.empty()) return;
  for (const std::string& line : found) print("{}\n", line);
  printPoints(scene, compareFrames(scene, first, last, wishes));
}

}  // namespace fluidtex::tools
