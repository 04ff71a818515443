#include "tools/stress_scenes/check_scene.h"

#include "scenes/scene.h"
#include "sim/grid/leaf_table.h"
#include "sim/solids/domain.h"
#include "sim/step/solver.h"
#include "sim/step/state_io.h"
#include "sim/surface/level_set.h"
#include "tools/stress_scenes/budget.h"
#include "tools/stress_scenes/closing_gap.h"
#include "tools/stress_scenes/impact.h"
#include "tools/stress_scenes/measures.h"
#include "tools/stress_scenes/surroundings.h"

#include <fmt/core.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace fluidtex::stress {
namespace {

// Of the liquid's volume, in each of so many frames. An impact takes more (6% of the dam break's at a cfl of
// 3, scenes/README.md), which the liquid beside it gives back within a frame or two.
constexpr double kMostDeficit = 0.02;
constexpr int kDeficitFrames = 4;
// And in any frame.
constexpr double kMostDeficitAtOnce = 0.1;
// Besides, of a cell for each cell's face of the surface: by so much phi knows where it is. It counts for
// spray, and where little more than cells at the surface moves.
constexpr double kDeficitOfSurface = 0.03;
// And a drop of a cell's radius, in cells: no grid sees one.
constexpr double kDrop = 4.2;
// Of what sheets and threads of a cell or two show so much may be wrong: no grid knows how thick they are.
constexpr double kDeficitOfThin = 0.5;
// Cells: surface over less liquid than that is that of films.
constexpr double kFilmThickness = 0.6;
// Liquid that meets a wall within a step goes into it until the step ends, by `cfl` cells at most. So much of
// that may be volume deficit at once, times the surface's area.
constexpr double kImpact = 0.1;
// Times the speed that a fall from the highest place to the lowest gives. The front of a dam break alone has
// 1.4 times that (Ritter), and where fronts meet or close, jets are faster still.
constexpr double kJets = 3.0;
// Of the energy of motion and place: what the surface's volume, read off phi, is not exact by.
constexpr double kEnergyTolerance = 0.01;
// Cells that volume deficit may move until it is surface again.
constexpr double kGivenBack = 8.0;
// Of the energy of the surface: of films thinner than two cells only half is seen, and all of it is set free.
constexpr double kFilms = 0.1;
// Of the speed at which a ripple of a cell's height falls, which is sqrt(g h): what is left at rest is less.
constexpr double kStill = 0.05;
// Cells of a gap that solids close, below which the liquid in it may be deficit.
constexpr double kNarrow = 2.0;
// In a frame. Liquid of the greatest speed that is allowed takes less.
constexpr int kMostSteps = 500;

template <class F>
auto onThreads(int threads, const F& f) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  return arena.execute(f);
}

struct TooManySteps : std::runtime_error {
  using std::runtime_error::runtime_error;
};

sim::Frame nextFrame(sim::Solver& solver) {
  int steps = 0;
  return solver.next([&](double) {
    if (++steps > kMostSteps) throw TooManySteps(fmt::format("more than {} steps to a frame", kMostSteps));
  });
}

// Solids that the solver warns of: liquid may pass through them.
std::vector<std::size_t> leaking(const sim::Solver& solver, const sim::Options& options) {
  std::vector<std::size_t> found;
  for (std::size_t n = 0; n < options.solids.size(); ++n) {
    const std::string name = "\"" + options.solids[n].name + "\"";
    for (const std::string& warning : solver.warnings()) {
      if (warning.find(name) == std::string::npos) continue;
      found.push_back(n);
      break;
    }
  }
  return found;
}

// The greatest speed that liquid is given, m/s: that of bodies, sources, solids and walls.
double givenSpeed(const sim::Options& options) {
  double speed = 0.0;
  for (const sim::LiquidBody& body : options.liquid) speed = std::max(speed, body.velocity.length());
  for (const sim::DomainWall& wall : options.walls) speed = std::max(speed, wall.wall.velocity.length());
  for (const sim::Source& source : options.sources) {
    double factor = source.rate.empty() ? 1.0 : 0.0;
    for (const sim::RatePoint& point : source.rate) factor = std::max(factor, point.factor);
    speed = std::max(speed, factor * source.velocity.length());
  }
  for (const sim::Solid& solid : options.solids) {
    speed = std::max(speed, solid.wall.velocity.length());
    for (std::size_t n = 1; n < solid.keyframes.size(); ++n) {
      const sim::Keyframe &a = solid.keyframes[n - 1], &b = solid.keyframes[n];
      const double time = b.time - a.time, turn = std::abs(b.turn - a.turn) * M_PI / 180.0 / time;
      speed = std::max(speed, (b.move - a.move).length() / time + turn * options.size.length());
    }
  }
  return speed;
}

// Whether something does work on the liquid.
bool isDriven(const sim::Options& options) {
  const auto runs = [](const sim::Wall& wall) { return wall.velocity != Vec3d(0.0); };
  return !options.sources.empty() ||
         std::any_of(
             options.solids.begin(), options.solids.end(),
             [&](const sim::Solid& solid) { return solid.keyframes.size() > 1 || runs(solid.wall); }) ||
         std::any_of(options.walls.begin(), options.walls.end(),
                     [&](const sim::DomainWall& wall) { return runs(wall.wall); }) ||
         std::find(options.sides.begin(), options.sides.end(), sim::Side::stream) != options.sides.end();
}

bool anyMoves(const sim::Options& options) {
  return std::any_of(options.solids.begin(), options.solids.end(),
                     [](const sim::Solid& solid) { return solid.keyframes.size() > 1; });
}

// Whether liquid is poured, or a solid comes or goes.
bool isEvent(const sim::Options& options, double from, double to) {
  const auto now = [&](double time) { return happens(time, from, to, options.frameRate); };
  return std::any_of(options.liquid.begin(), options.liquid.end(),
                     [&](const auto& body) { return now(body.from); }) ||
         std::any_of(options.solids.begin(), options.solids.end(),
                     [&](const auto& solid) { return now(solid.from) || now(solid.until); });
}

class Checks {
 public:
  Checks(const sim::Options& options, const sim::Solver& solver)
      : m_options(options),
        m_solids(options),
        m_surroundings(options, leaking(solver, options)),
        m_budget(options, m_surroundings),
        m_impact(impactSpeed(options)) {}

  void frame(const sim::Solver& solver, const sim::Frame& frame) {
    m_frame = frame.index;
    if (const std::string grid = notFinite(solver.state()); !grid.empty()) return fail("finite", grid);
    const auto solid = m_solids.around({solver.state().phi.get()}, frame.time, m_solids.active(frame.time));
    const Measures now = measure(solver.state(), *solid, m_options);
    m_gap = std::min(m_gap, closingGap(m_options, frame.time));
    volume(frame, now);
    outside(solver.state(), frame);
    energy(solver.state(), frame, now);
    speed(now, frame.time);
    m_time = frame.time;
  }

  void fail(const std::string& invariant, const std::string& what) {
    for (const Failure& failure : m_failures)
      if (failure.invariant == invariant) return;
    m_failures.push_back({invariant, m_frame, what});
  }

  bool failed(const std::string& invariant) const {
    return std::any_of(m_failures.begin(), m_failures.end(),
                       [&](const Failure& failure) { return failure.invariant == invariant; });
  }

  std::vector<Failure> take() { return std::move(m_failures); }
  int atFrame() const { return m_frame; }

 private:
  void volume(const sim::Frame& frame, const Measures& now) {
    const double sum = frame.stats.volume + frame.stats.deficit;
    const double outside = m_frame == 1 ? m_budget.start(sum) : m_budget.advance(m_time, frame.time, sum);
    const double whole = m_budget.most();
    if (outside != 0.0)
      fail(m_frame == 1 ? "poured" : "volume",
           fmt::format("{:+.3g} m3, {:+.1f}% of {:.4g} m3", outside, 100.0 * outside / whole, whole));
    const double h = m_options.voxelSize(), deficit = std::abs(frame.stats.deficit);
    const double always = kDeficitOfSurface * h * now.area + kDrop * h * h * h + kDeficitOfThin * now.thin;
    const double atOnce = kMostDeficitAtOnce * whole + kImpact * m_options.cfl * h * now.area;
    // What is seen is films, little more than half a cell thick on the mean: beside them are those that
    // nobody sees.
    const bool films =
        frame.stats.deficit > 0.0 && now.mass / m_options.density < kFilmThickness * h * now.area;
    m_owing = !films && deficit > kMostDeficit * whole + always ? m_owing + 1 : 0;
    // Nor is what a closing gap holds that is little wider than a cell.
    if (films || m_gap < kNarrow * h) return;
    if (m_owing >= kDeficitFrames || deficit > atOnce + always)
      fail("deficit", fmt::format("{:+.3g} m3, {:+.1f}% of {:.4g} m3, most of it ({:+.3g} of a cell) at {}",
                                  frame.stats.deficit, 100.0 * frame.stats.deficit / whole, whole,
                                  now.deficit.value, written(now.deficit.place)));
  }

  void outside(const sim::State& state, const sim::Frame& frame) {
    const double h = m_options.voxelSize();
    const openvdb::tree::ValueAccessor<const sim::FloatTree> solid(frame.solidPhi->constTree());
    int cells = 0;
    Coord first;
    const sim::CoordBBox domain = sim::domainCells(m_options);
    for (const Coord& origin : sim::wetLeaves(*state.phi, domain)) {
      for (int i = 0; i < sim::kLeafSize; ++i) {
        const Coord cell = origin.offsetBy(i >> 6, (i >> 3) & 7, i & 7);
        if (!domain.isInside(cell) || state.phi->constTree().getValue(cell) >= 0.0f) continue;
        if (solid.getValue(cell) <= 0.0f || m_surroundings.reached(cell)) continue;
        if (cells++ == 0) first = cell;
      }
    }
    if (cells > 0)
      fail("outside",
           fmt::format("{} cells of liquid, one at {}", cells, written((first.asVec3d() + Vec3d(0.5)) * h)));
  }

  // Potential energy and surface are those of the frame, the velocity is later by the leapfrog offset. Until
  // then the energy of place falls by what gravity does meanwhile: exactly, but for a part of second order,
  // of which free fall has the most, m (g offset)^2 / 2. What is seen without being there (a negative
  // deficit) has no energy of motion. A deficit may have been lost at another height than where it is, and
  // given back some cells from where it was, and of a drop that no grid sees a cell is the least that can be
  // known.
  void energy(const sim::State& state, const sim::Frame& frame, const Measures& now) {
    const double h = m_options.voxelSize(), deficit = std::abs(frame.stats.deficit);
    const bool event = m_frame == 1 || isEvent(m_options, m_time, frame.time);
    m_mostDeficit = event ? deficit : std::max(m_mostDeficit, deficit);
    if (event) m_energy = INFINITY;
    m_energy += laidOpen(frame);
    // Of liquid that nobody sees nothing is known.
    if (isDriven(m_options) || !std::isfinite(now.lowest)) return;
    const double weight = m_options.gravity.length(), fall = weight * state.leapfrogOffset;
    const double sum = now.kinetic + std::min(0.0, now.deficitMotion) + now.potential + now.surface -
                       now.falling * state.leapfrogOffset;
    const double height = m_surroundings.highest(frame.time) - now.lowest;
    const double lifted =
        m_options.density *
        (deficit * height + (m_mostDeficit - deficit) * std::min(height, weight * kGivenBack * h) +
         (kDeficitOfSurface * h * now.area + kDrop * h * h * h) * weight * h);
    const double motion = std::max(kEnergyTolerance * now.kinetic, kDeficitOfSurface * now.surfaceMotion);
    const double allowed = motion + kEnergyTolerance * now.potential + kFilms * now.surface + lifted +
                           0.5 * now.mass * fall * fall;
    // A volume that is wrong has a wrong energy.
    if (sum > m_energy + allowed && !failed("volume"))
      fail("energy", fmt::format("{:.4g} J after {:.4g} J, {:+.1f}%; fastest {:.3g} m/s at {}", sum, m_energy,
                                 100.0 * (sum / m_energy - 1.0), now.speed.value, written(now.speed.place)));
    m_energy = std::min(m_energy, sum + unseenEnergy(frame, now));
  }

  // Energy of the surface that drains give the liquid, J: each of them empties its shape once in a step, and
  // the liquid around it gets no more surface by that than the shape has.
  double laidOpen(const sim::Frame& frame) const {
    if (m_options.surfaceTension == 0.0) return 0.0;
    double area = 0.0;
    for (const sim::Drain& drain : m_options.drains)
      if (drain.from < frame.time && m_time < drain.until)
        area += m_surroundings.surfaceOf(drain.shape, frame.time);
    return m_options.surfaceTension * area * static_cast<double>(frame.substeps.size());
  }

  // Energy of motion and of surface that the volume deficit can have, the latter in drops of a cell or
  // larger. It may be seen again.
  double unseenEnergy(const sim::Frame& frame, const Measures& now) const {
    const double unseen = std::max(0.0, frame.stats.deficit), perVolume = std::cbrt(36.0 * M_PI);
    return std::max(0.0, now.deficitMotion) +
           m_options.surfaceTension * perVolume * unseen / m_options.voxelSize();
  }

  void speed(const Measures& now, double time) {
    const double h = m_options.voxelSize(), weight = m_options.gravity.length();
    if (!std::isfinite(now.lowest)) return;
    const double ripple = std::sqrt(weight * h);
    if (m_surroundings.atRest() && now.speed.value > kStill * ripple + 1e-3 * h * m_options.frameRate)
      fail("rest", fmt::format("{:.3g} m/s, {:.2f} sqrt(g h), at {}", now.speed.value,
                               now.speed.value / ripple, written(now.speed.place)));
    // Bernoulli: from the highest place to the lowest; a solid that moves can lift liquid to any place.
    // Surface tension draws cells of liquid together at up to sqrt(4 tension / (density h)).
    const double given = givenSpeed(m_options);
    const double height = std::max(0.0, m_surroundings.highest(time) - now.lowest) +
                          (isDriven(m_options) ? weight * m_options.size.length() : 0.0);
    // Between solids that close on each other liquid comes out the faster the narrower the gap is: what a
    // gap's whole length gives has to go out through its width.
    const double squeezed = anyMoves(m_options) ? std::max(3.0, m_options.size.length() / m_gap) : 1.0;
    // What walls drive out of liquid as it is poured into them is little, and turns at others without
    // becoming faster (Bernoulli).
    const double most =
        squeezed * (m_impact + kJets * std::sqrt(given * given + 2.0 * height + 2.0 * weight * h +
                                                 4.0 * m_options.surfaceTension / (m_options.density * h)));
    if (now.speed.value > most)
      fail("speed", fmt::format("{:.3g} m/s where {:.3g} m/s is possible, at {}", now.speed.value, most,
                                written(now.speed.place)));
  }

  const sim::Options& m_options;
  sim::Solids m_solids;
  Surroundings m_surroundings;
  VolumeBudget m_budget;
  double m_impact;  // m/s, of what walls drive out of liquid that is poured into them
  std::vector<Failure> m_failures;
  int m_frame = 0, m_owing = 0;
  double m_gap = INFINITY;  // metres: the narrowest that solids have closed yet
  double m_time = 0.0, m_energy = 0.0, m_mostDeficit = 0.0;
};

// The state after the last frame, on so many threads; written, read and gone on with after `broken` frames.
sim::State lastState(const sim::Options& options, int frames, int threads, int broken,
                     const std::filesystem::path& scratch) {
  return onThreads(threads, [&] {
    std::optional<sim::Solver> solver(options);
    for (int n = 1; n <= frames; ++n) {
      nextFrame(*solver);
      if (n != broken) continue;
      const std::filesystem::path file = scratch / "state.vdb";
      sim::writeState(solver->state(), file);
      solver.emplace(options, sim::readState(file));
      std::filesystem::remove(file);
    }
    return solver->state();
  });
}

}  // namespace

std::vector<Failure> checkScene(const std::filesystem::path& file, const std::filesystem::path& scratch,
                                const std::string& wanted) {
  scenes::Scene scene;
  try {
    scene = scenes::loadScene(file);
  } catch (const std::exception& error) {
    return {{"loader", 0, error.what()}};
  }
  const sim::Options& options = scene.sim;
  std::optional<Checks> checks;
  std::optional<sim::State> expected;
  try {
    onThreads(2, [&] {
      sim::Solver solver(options);
      checks.emplace(options, solver);
      for (int n = 1; n <= scene.frames; ++n) {
        checks->frame(solver, nextFrame(solver));
        if (checks->failed("finite") || checks->failed(wanted)) return;
      }
      expected = solver.state();
    });
  } catch (const std::exception& error) {
    if (!checks) return {{"runs", 0, error.what()}};
    checks->fail("runs", error.what());
  }
  const bool ofBytes = wanted.empty() || wanted == "threads" || wanted == "restart";
  if (!expected || !ofBytes) return checks->take();
  try {
    const sim::State broken = lastState(options, scene.frames, 1, scene.frames / 2, scratch);
    if (!difference(*expected, broken).empty()) {
      // By the other number of threads, or by the break?
      const sim::State unbroken = lastState(options, scene.frames, 1, 0, scratch);
      if (const std::string what = difference(*expected, unbroken); !what.empty())
        checks->fail("threads", what);
      if (const std::string what = difference(unbroken, broken); !what.empty()) checks->fail("restart", what);
    }
  } catch (const std::exception& error) {
    checks->fail("restart", error.what());
  }
  return checks->take();
}

}  // namespace fluidtex::stress
