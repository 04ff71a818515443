// Surface preparation: points, mesh and orientation of one frame, from the last frame's points and from
// random ones, beside CGAL's isotropic remeshing.
#include "texture/levelset/isosurface.h"
#include "texture/mesh/mesh_stats.h"
#include "texture/mesh/prepare.h"
#include "texture/orientation/orient.h"
#include "tools/benchmarks/measure.h"
#include "tools/benchmarks/moving_surfaces.h"
#include "tools/benchmarks/peers/cgal_remeshing.h"

#include <tbb/global_control.h>

#include <malloc.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <memory>

namespace fluidtex::benchmarks {
namespace {

constexpr const char* kAsk = "--measure-surface-memory";

enum class Start { seeds, random, first };

struct Problem {
  MovingSurface surface;
  texture::Seeds seeds;
};

// The last one made is kept: its rows follow each other.
std::shared_ptr<const Problem> problem(const std::string& shape, int points) {
  static std::string key;
  static std::shared_ptr<const Problem> last;
  const std::string wanted = shape + std::to_string(points);
  if (key == wanted) return last;
  last.reset();
  auto made = std::make_shared<Problem>();
  made->surface = movingSurface(shape, points);
  const texture::Surface before =
      texture::prepareSurface(*made->surface.before, made->surface.spacing, texture::Seeds{}, 1, {});
  const texture::SurfaceMesh& mesh = before.levels[0];
  made->seeds = {made->surface.moved(mesh.positions), mesh.positions, mesh.triangles, {}};
  key = wanted;
  last = made;
  return last;
}

// Points, mesh and orientation: a first frame's with its hierarchy, or a later one's, to which an orientation
// was carried.
texture::Surface prepared(const Problem& p, Start start) {
  texture::Surface surface = texture::prepareSurface(
      *p.surface.now, p.surface.spacing, start == Start::seeds ? p.seeds : texture::Seeds{},
      start == Start::first ? texture::SurfaceOptions{}.levels : 1, {});
  texture::Carried carried;
  if (start != Start::first) {
    const std::size_t count = surface.levels[0].positions.size();
    carried.orientation.assign(count, texture::Vec3f(1.0f, 0.0f, 0.0f));
    carried.trust.assign(count, 1.0f);
    carried.previousPosition = surface.levels[0].positions;
  }
  texture::orient(surface, carried);
  return surface;
}

void ours(benchmark::State& state, const std::string& row, const std::string& shape, int points,
          Start start) {
  const std::shared_ptr<const Problem> p = problem(shape, points);
  const int rounds = points > 500000 ? 1 : points > 50000 ? 3 : 7;
  for ([[maybe_unused]] auto _ : state) {
    std::vector<double> processor, wall;
    texture::Surface surface;
    for (int round = 0; round < rounds; ++round) {
      {
        const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
        const double from = processorSeconds();
        surface = prepared(*p, start);
        processor.push_back(processorSeconds() - from);
      }
      const tbb::global_control twoThreads(tbb::global_control::max_allowed_parallelism, 2);
      const double from = wallSeconds();
      surface = prepared(*p, start);
      wall.push_back(wallSeconds() - from);
    }
    const texture::SurfaceMesh& mesh = surface.levels[0];
    const auto count = static_cast<double>(mesh.positions.size());
    state.SetIterationTime(median(processor));
    state.counters["cpu_us_per_point"] = 1e6 * median(processor) / count;
    state.counters["wall_us_per_point"] = 1e6 * median(wall) / count;
    state.counters["wall_s"] = median(wall);
    state.counters["edge_cv"] = texture::meshStats(mesh.positions, mesh.triangles).edgeCv;
    state.counters["points"] = count;
    keep(row, "wall s", median(wall));
  }
}

void cgal(benchmark::State& state, const std::vector<std::string>& rows, const std::string& shape,
          int points) {
  const std::shared_ptr<const Problem> p = problem(shape, points);
  const texture::IsoSurface iso = texture::isoSurface(texture::LevelSet(*p->surface.now));
  for ([[maybe_unused]] auto _ : state) {
    const Remeshed result = cgalIsotropicRemeshing(iso.positions, iso.triangles, 3);
    const auto count = static_cast<double>(result.positions.size());
    state.SetIterationTime(result.seconds);
    state.counters["wall_us_per_point"] = 1e6 * result.seconds / count;
    state.counters["wall_s"] = result.seconds;
    state.counters["edge_cv"] = texture::meshStats(result.positions, result.triangles).edgeCv;
    state.counters["points"] = count;
    for (const std::string& row : rows) keep(row + "/peer:cgal", "wall s", result.seconds);
  }
}

void memory(benchmark::State& state, const std::string& shape, int points, Start start) {
  for ([[maybe_unused]] auto _ : state) {
    measureMemory(
        state,
        std::string(kAsk) + " " + shape + " " + std::to_string(points) + " " + std::to_string(int(start)),
        "point");
  }
}

// Bytes that this process holds, from /proc/self/status: VmRSS now, VmHWM at most.
double heldBytes(const char* what) {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.rfind(what, 0) == 0) return 1024.0 * std::stod(line.substr(std::strlen(what) + 1));
  }
  return 0.0;
}

}  // namespace

bool answerSurface(int argc, char** argv) {
  if (argc != 5 || std::strcmp(argv[1], kAsk) != 0) return false;
  const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
  const std::shared_ptr<const Problem> p = problem(argv[2], std::atoi(argv[3]));
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";  // the peak is counted from here
  const double before = heldBytes("VmRSS:"), start = processorSeconds();
  const texture::Surface surface = prepared(*p, Start(std::atoi(argv[4])));
  std::printf("{\"bytes\": %.0f, \"points\": %zu, \"seconds\": %g}\n", heldBytes("VmHWM:") - before,
              surface.levels[0].positions.size(), processorSeconds() - start);
  return true;
}

void registerSurface() {
  struct Case {
    const char* shape;
    int points;
    bool peer;
  };
  for (const Case c : {Case{"sphere", 20000, false},
                       {"sphere", 200000, true},
                       {"sphere", 2000000, false},
                       {"torus", 200000, true},
                       {"stretched", 200000, true},
                       {"drops_apart", 20000, false},
                       {"drops_merged", 20000, false},
                       {"river", 200000, false},
                       {"dam_break", 12000, true}}) {
    const std::string shape = c.shape, size = shape + "/" + std::to_string(c.points);
    const int points = c.points;
    const std::string seeds = "surface_seeds/" + size, random = "surface_random/" + size,
                      first = "surface_first/" + size;
    addRow(seeds, [=](benchmark::State& s) { ours(s, seeds, shape, points, Start::seeds); });
    addRow(random, [=](benchmark::State& s) { ours(s, random, shape, points, Start::random); });
    if (c.peer) {
      addRow(first, [=](benchmark::State& s) { ours(s, first, shape, points, Start::first); });
      addRow(random + "/peer:cgal", [=](benchmark::State& s) { cgal(s, {seeds, random}, shape, points); });
    }
  }
  for (const int points : {200000, 1000000}) {
    for (const Start start : {Start::seeds, Start::random}) {
      addRow(std::string("surface_memory/") + (start == Start::seeds ? "seeds/" : "random/") +
                 std::to_string(points),
             [=](benchmark::State& s) { memory(s, "sphere", points, start); });
    }
  }
}

}  // namespace fluidtex::benchmarks
