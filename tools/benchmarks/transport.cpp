// Transport of one frame: the trace, a vertex and substep; closest point and pick-up, a vertex; and closest
// points alone beside Embree and CGAL. A sphere in LeVeque's deformation, one cell a vertex; processor time
// of one thread.
#include "texture/loops/parallel.h"
#include "tools/benchmarks/measure.h"
#include "tools/benchmarks/peers/closest_points.h"
#include "tools/benchmarks/transport_problem.h"
#include "transport/backtrace.h"
#include "transport/carry.h"
#include "transport/closest_point.h"

#include <tbb/global_control.h>

#include <memory>

namespace fluidtex::benchmarks {
namespace {

using texture::Vec3f;

// The last one is kept for the rows that follow.
std::shared_ptr<const TransportProblem> problem(int points) {
  static int made = 0;
  static std::shared_ptr<const TransportProblem> last;
  if (made == points) return last;
  last.reset();
  last = std::make_shared<const TransportProblem>(transportProblem(points));
  made = points;
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
    count(state, seconds, double(p->next.positions.size()), kTransportSubsteps);
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

std::vector<Vec3f> landingPlaces(const TransportProblem& p) {
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
