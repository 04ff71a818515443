// Transport of one frame: the trace, a vertex and substep; closest point and pick-up, a vertex; and closest
// points alone beside Embree and CGAL. A sphere in LeVeque's deformation, one cell a vertex; processor time
// of one thread.
#include "numerics/random.h"
#include "texture/loops/parallel.h"
#include "texture/mesh/prepare.h"
#include "texture/orientation/tangent.h"
#include "tools/benchmarks/deformed_shapes.h"
#include "tools/benchmarks/measure.h"
#include "tools/benchmarks/moving_surfaces.h"
#include "tools/benchmarks/peers/closest_points.h"
#include "transport/backtrace.h"
#include "transport/carry.h"
#include "transport/closest_point.h"

#include <openvdb/tools/Morphology.h>
#include <tbb/global_control.h>

#include <memory>

namespace fluidtex::benchmarks {
namespace {

using texture::Vec3f;

constexpr int kSubsteps = 4;
constexpr double kFastest = 2.0;  // m/s, of the deformation
constexpr float kOff = 0.3f;      // how far off the moved points the new ones lie, spacings

struct Problem {
  texture::TexturedSurface previous;
  sim::Frame frame;
  texture::SurfaceMesh next;
};

sim::FloatGrid::Ptr component(const sim::MaskTree& band, double h, int axis, double t) {
  auto grid = sim::FloatGrid::create(0.0f);
  auto transform = openvdb::math::Transform::createLinearTransform(h);
  openvdb::Vec3d shift(0.5 * h);
  shift[axis] = 0.0;
  transform->postTranslate(shift);
  grid->setTransform(transform);
  grid->tree().topologyUnion(band);
  for (auto value = grid->beginValueOn(); value; ++value)
    value.setValue(float(deformationVelocity(grid->indexToWorld(value.getCoord()), t)[axis]));
  return grid;
}

// The velocity of each substep in the cells around the surface, each in grids of its own. The fastest points
// move by a cell a substep.
sim::Frame frameAround(const std::vector<Vec3f>& positions, double h) {
  constexpr int kBand = kSubsteps + 4;  // cells
  const double dt = h / kFastest;
  sim::MaskTree band;
  openvdb::tree::ValueAccessor<sim::MaskTree> mark(band);
  for (const Vec3f& x : positions) mark.setValueOn(openvdb::Coord::floor(openvdb::Vec3d(x) / h));
  openvdb::tools::dilateActiveValues(band, kBand, openvdb::tools::NN_FACE, openvdb::tools::IGNORE_TILES);
  sim::Frame frame;
  frame.index = 2;
  frame.time = kSubsteps * dt;
  for (int s = 0; s < kSubsteps; ++s) {
    const double t = (s + 0.5) * dt;
    frame.substeps.push_back(
        {dt, component(band, h, 0, t), component(band, h, 1, t), component(band, h, 2, t)});
  }
  return frame;
}

std::shared_ptr<const Problem> problem(int points) {
  static int made = 0;
  static std::shared_ptr<const Problem> last;
  if (made == points) return last;
  last.reset();
  const MovingSurface moving = movingSurface("sphere", points);
  texture::SurfaceMesh mesh =
      std::move(texture::prepareSurface(*moving.before, moving.spacing, texture::Seeds{}, 1, {}).levels[0]);
  auto p = std::make_shared<Problem>();
  p->frame = frameAround(mesh.positions, moving.spacing);
  p->next = mesh;
  p->next.positions = transport::moved(mesh.positions, p->frame);
  const std::vector<Vec3f> along = texture::referenceVectors(mesh.normals);
  for (std::size_t v = 0; v < along.size(); ++v) {
    const auto angle = float(6.283185307 * randomUnit(3, v));
    const Vec3f across = mesh.normals[v].cross(along[v]);
    p->next.positions[v] +=
        (along[v] * std::cos(angle) + across * std::sin(angle)) * float(kOff * moving.spacing);
  }
  const std::size_t count = mesh.positions.size();
  p->previous.spacing = mesh.spacing;
  p->previous.orientation = along;
  p->previous.color.assign(count, texture::Vec4f(0.5f, 0.5f, 0.5f, 1.0f));
  p->previous.coordinate.assign(count, texture::Vec2f(1.0f, 2.0f));
  p->previous.gradient.resize(count);
  p->previous.fading = texture::noFading(count);
  p->previous.age.assign(count, 1.0f);
  p->previous.trust.assign(count, 1.0f);
  p->previous.positions = std::move(mesh.positions);
  p->previous.normals = std::move(mesh.normals);
  p->previous.triangles = std::move(mesh.triangles);
  made = points;
  last = p;
  return last;
}

// Of more rounds where each is short.
template <typename Work>
double medianSeconds(int points, const Work& work) {
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  const int rounds = std::clamp(400000 / points, 3, 15);
  std::vector<double> seconds;
  for (int round = 0; round < rounds; ++round) {
    const double from = processorSeconds();
    work();
    seconds.push_back(processorSeconds() - from);
  }
  return median(seconds);
}

void count(benchmark::State& state, double seconds, double vertices, double parts = 1.0) {
  state.SetIterationTime(seconds);
  state.counters["per_vertex_ns"] = 1e9 * seconds / vertices / parts;
  state.counters["vertices"] = vertices;
}

// A vertex and substep.
void trace(benchmark::State& state, int points) {
  const auto p = problem(points);
  for ([[maybe_unused]] auto _ : state) {
    const double seconds = medianSeconds(
        points, [&] { benchmark::DoNotOptimize(transport::traceBack(p->next.positions, p->frame)); });
    count(state, seconds, double(p->next.positions.size()), kSubsteps);
  }
}

// All that carry() does besides the trace.
void pickUp(benchmark::State& state, int points) {
  const auto p = problem(points);
  for ([[maybe_unused]] auto _ : state) {
    const double tracing = medianSeconds(
        points, [&] { benchmark::DoNotOptimize(transport::traceBack(p->next.positions, p->frame)); });
    const double whole = medianSeconds(
        points, [&] { benchmark::DoNotOptimize(transport::carry(p->previous, p->frame, p->next)); });
    count(state, whole - tracing, double(p->next.positions.size()));
  }
}

std::vector<Vec3f> landingPlaces(const Problem& p) {
  std::vector<Vec3f> places;
  for (const auto& x : transport::traceBack(p.next.positions, p.frame).origin) places.emplace_back(x);
  return places;
}

void closest(benchmark::State& state, const std::string& row, int points) {
  const auto p = problem(points);
  const std::vector<Vec3f> queries = landingPlaces(*p);
  for ([[maybe_unused]] auto _ : state) {
    double sum = 0.0, build = 0.0;
    const double seconds = medianSeconds(points, [&] {
      const double from = processorSeconds();
      const transport::ClosestPoint tree(p->previous.positions, p->previous.triangles);
      build = processorSeconds() - from;
      sum = 0.0;
      for (std::size_t v = 0; v < queries.size(); ++v)
        sum += tree.nearest(openvdb::Vec3d(queries[v]), p->next.normals[v], p->next.spacing).distance;
    });
    count(state, seconds, double(queries.size()));
    state.counters["build_ns"] = 1e9 * build / double(queries.size());
    state.counters["mean_distance"] = sum / double(queries.size());
    keep(row, "cpu s", seconds);
  }
}

using Peer = ClosestRun (*)(const std::vector<Vec3f>&, const std::vector<texture::Vec3I>&,
                            const std::vector<Vec3f>&);

void closestPeer(benchmark::State& state, const std::string& row, int points, Peer peer) {
  const auto p = problem(points);
  const std::vector<Vec3f> queries = landingPlaces(*p);
  for ([[maybe_unused]] auto _ : state) {
    const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
    const ClosestRun run = peer(p->previous.positions, p->previous.triangles, queries);
    count(state, run.build + run.query, double(queries.size()));
    state.counters["build_ns"] = 1e9 * run.build / double(queries.size());
    state.counters["mean_distance"] = run.sum / double(queries.size());
    keep(row, "cpu s", run.build + run.query);
  }
}

}  // namespace

void registerTransport() {
  for (const int points : {20000, 200000, 2000000}) {
    const std::string size = "/" + std::to_string(points), row = "transport_closest" + size;
    addRow("transport_trace" + size, [=](benchmark::State& s) { trace(s, points); });
    addRow("transport_pick_up" + size, [=](benchmark::State& s) { pickUp(s, points); });
    addRow(row, [=](benchmark::State& s) { closest(s, row, points); });
    for (const auto& [name, peer] :
         {std::pair<const char*, Peer>{"embree", embreeClosest}, {"cgal", cgalClosest}}) {
      const std::string peerRow = row + "/peer:" + name;
      addRow(peerRow, [=, peer = peer](benchmark::State& s) { closestPeer(s, peerRow, points, peer); });
    }
  }
}

}  // namespace fluidtex::benchmarks
