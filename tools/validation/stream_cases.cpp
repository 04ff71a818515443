// Section C.11 of the reference, on channels one leaf wide.
#include "tools/validation/stream_cases.h"

#include "sim/solids/solids.h"
#include "sim/step/solver.h"
#include "tools/validation/solver_run.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::validation {
namespace {

using namespace sim;

// A channel of `length` metres along x, of `across` cells, 8 cells wide.
Options wideChannel(double length, double height, int across) {
  Options options;
  const double h = length / across;
  options.size = Vec3d(length, 8.0 * h, height);
  options.resolution = across;
  options.cfl = 1.0;
  return options;
}

Shape boxOf(double fromX, double toX, double top) {
  return {Box{Vec3d(fromX, -1.0, -1.0), Vec3d(toX, 10.0, top)}};
}

// Height of the surface over the middle of the channel, metres, in the column of cells i; 0 where it is dry.
double middleHeight(const State& state, int i) {
  return surfaceHeight(state, i, 4, state.phi->evalActiveVoxelBoundingBox().max()[2] + 1);
}

// m3/s through the faces normal to x in the plane of index i.
double fluxThrough(const State& state, const SolidField& solid, int i) {
  const double h = solid.voxelSize;
  const auto u = state.velocity.component[0]->getConstUnsafeAccessor();
  const auto open = solid.open.component[0]->getConstUnsafeAccessor();
  const auto phi = state.phi->getConstUnsafeAccessor();
  double sum = 0.0;
  for (int j = 0; j <= solid.domain.max()[1]; ++j) {
    for (int k = 0; k <= solid.domain.max()[2]; ++k) {
      const Coord face(i, j, k);
      const double wet = 0.5 * (std::clamp(0.5 - phi.getValue(face) / h, 0.0, 1.0) +
                                std::clamp(0.5 - phi.getValue(face.offsetBy(-1, 0, 0)) / h, 0.0, 1.0));
      sum += wet * open.getValue(face) * u.getValue(face);
    }
  }
  return sum * h * h;
}

// Liquid that flows in and out at 1 m/s, level with the source all along, for ten times through the channel.
Result slug(int resolution, const Progress& progress) {
  constexpr double kDepth = 0.26, kSpeed = 1.0, kLength = 1.0;
  Options options = wideChannel(kLength, 0.5, resolution);
  options.sides[1] = Side::stream;
  options.liquid = {{boxOf(-1.0, 2.0 * kLength, kDepth), Vec3d(kSpeed, 0.0, 0.0), 0.0}};
  Source source;
  source.shape = boxOf(-1.0, 0.1 * kLength, kDepth);
  source.velocity = Vec3d(kSpeed, 0.0, 0.0);
  options.sources = {source};
  Solver solver(options);
  const double before = solver.next().stats.volume;
  const int frames = static_cast<int>(10.0 * kLength / kSpeed * options.frameRate);
  double largest = 0.0, level = 0.0, volume = before;
  for (int n = 1; n <= frames; ++n) {
    volume = solver.next().stats.volume;
    const State& state = solver.state();
    const FloatGrid* const grids[3] = {state.velocity.component[0].get(), state.velocity.component[1].get(),
                                       state.velocity.component[2].get()};
    const auto phi = state.phi->getConstUnsafeAccessor();
    for (int axis = 0; axis < 3; ++axis) {
      for (auto it = grids[axis]->cbeginValueOn(); it; ++it) {
        const Coord face = it.getCoord();
        Coord low = face;
        low[axis] -= 1;
        const bool inside = face[0] >= 0 && face[1] >= 0 && face[2] >= 0 && face[0] <= resolution &&
                            face[1] < 8 && face[axis] > 0;
        if (!inside || (phi.getValue(face) >= 0.0f && phi.getValue(low) >= 0.0f)) continue;
        largest = std::max(largest, std::abs(*it - (axis == 0 ? kSpeed : 0.0)));
      }
    }
    for (int i = 0; i < resolution; ++i)
      level = std::max(level, std::abs(middleHeight(state, i) - kDepth) * resolution / kLength);
    progress(double(n) / frames);
  }
  Result result;
  result.rows = {row("slug", resolution, "max |du|, m/s", largest, 1e-5, 1e-8),
                 row("slug", resolution, "surface's change, h", level, {}, {}),
                 row("slug", resolution, "volume's change", volume / before - 1.0, {}, {})};
  return result;
}

// A low wave on still water, long against its depth, that runs out of the channel; what comes back is the
// difference to a channel twice as long.
Result outflowWave(int resolution, const Progress& progress) {
  constexpr double kDepth = 0.16, kHeight = 0.008, kWidth = 0.6, kLength = 3.0, kStart = 1.5;
  const double speed = std::sqrt(kGravity * kDepth);
  // So late that what came back would be in the middle of the channel.
  const double time = (kLength - kStart + 0.5 * kLength) / speed;
  std::vector<std::vector<double>> profiles;
  for (const int times : {1, 2}) {
    Options options = wideChannel(times * kLength, 0.3, times * resolution);
    if (times == 1) options.sides[1] = Side::stream;
    options.liquid = {{boxOf(-1.0, 10.0, kDepth), Vec3d(0.0), 0.0}};
    Solver still(options);
    still.next();
    State state = still.state();
    const auto wave = [&](double x) {
      return kHeight * std::exp(-(x - kStart) * (x - kStart) / (kWidth * kWidth));
    };
    for (auto it = state.phi->beginValueOn(); it; ++it)
      it.setValue(*it - float(wave(state.phi->indexToWorld(it.getCoord()).x())));
    for (auto it = state.velocity.component[0]->beginValueOn(); it; ++it)
      it.setValue(*it +
                  float(speed / kDepth * wave(state.velocity.component[0]->indexToWorld(it.getCoord()).x())));
    state.markers.clear();
    Solver solver(options, state);
    const int frames = static_cast<int>(time * options.frameRate);
    for (int n = 1; n <= frames; ++n) {
      solver.next();
      progress(0.5 * (times - 1) + 0.5 * n / frames);
    }
    std::vector<double> profile;
    profile.reserve(std::size_t(resolution));
    for (int i = 0; i < resolution; ++i) profile.push_back(middleHeight(solver.state(), i));
    profiles.push_back(std::move(profile));
  }
  double most = 0.0;
  Plot plot{"outflow_wave_" + std::to_string(resolution),
            "After the wave has left: what came back",
            "x (m)",
            "height (mm)",
            false,
            false,
            {{"open", {}}, {"twice as long", {}}}};
  for (int i = 0; i < resolution; ++i) {
    most = std::max(most, std::abs(profiles[0][i] - profiles[1][i]));
    for (int n = 0; n < 2; ++n)
      plot.curves[n].points.push_back({(i + 0.5) * kLength / resolution, 1e3 * (profiles[n][i] - kDepth)});
  }
  return {{row("outflow_wave", resolution, "reflected, % of the wave's height", 100.0 * most / kHeight, 5.0,
               1.0)},
          {plot}};
}

// Water held up by a long low sill, over which it goes at the critical depth, and off an edge behind.
Result weir(int resolution, const Progress& progress) {
  constexpr double kLength = 2.4, kSill = 0.25, kHead = 0.2, kFrom = 1.0, kTo = 2.0, kGauge = 0.6;
  const double wanted = std::pow(2.0 / 3.0, 1.5) * std::sqrt(kGravity) * std::pow(kHead, 1.5);  // m2/s
  Options options = wideChannel(kLength, 0.65, resolution);
  options.sides[1] = Side::open;
  const double h = options.voxelSize();
  // A whole number of cells, whose flux is exact.
  const double top = std::round(0.8 * (kSill + kHead) / h) * h;
  options.liquid = {{boxOf(-1.0, kFrom, kSill + kHead), Vec3d(0.0), 0.0}};
  Source source;
  source.shape = boxOf(-1.0, 0.2, top);
  source.velocity = Vec3d(wanted / top, 0.0, 0.0);
  options.sources = {source};
  Solid sill;
  // Its upstream edge is cut off, so that the flow stays on it.
  sill.shape = {Difference{
      {boxOf(kFrom, kTo, kSill), {HalfSpace{Vec3d(kFrom, 0.0, kSill - 0.12), Vec3d(1.0, 0.0, -1.0)}}}}};
  options.solids = {sill};
  Solver solver(options);
  const int frames = 10 * 24, averaged = 3 * 24;
  double head = 0.0, flux = 0.0, crest = 1e9;
  const double width = options.size.y();
  const auto solid = Solids(options).at(0.0);
  for (int n = 0; n <= frames; ++n) {
    solver.next();
    progress(double(n) / frames);
    if (n <= frames - averaged) continue;
    const State& state = solver.state();
    const double level = middleHeight(state, static_cast<int>(kGauge / h));
    const double here = fluxThrough(state, *solid, static_cast<int>(kGauge / h)) / width;
    const double approach = here / level;
    head += (level - kSill + 0.5 * approach * approach / kGravity) / averaged;
    flux += here / averaged;
  }
  for (int i = static_cast<int>(kFrom / h); i < static_cast<int>((kTo - 0.3) / h); ++i)
    crest = std::min(crest, middleHeight(solver.state(), i) - kSill);
  const double law = std::pow(2.0 / 3.0, 1.5) * std::sqrt(kGravity) * std::pow(head, 1.5);
  Plot plot{"weir_" + std::to_string(resolution),
            "Over a broad sill",
            "x (m)",
            "height (m)",
            false,
            false,
            {{"surface", {}}}};
  for (int i = 0; i < resolution; ++i)
    plot.curves[0].points.push_back({(i + 0.5) * h, middleHeight(solver.state(), i)});
  return {{row("weir", resolution, "flux against the law at the measured head, %", 100.0 * (flux / law - 1.0),
               5.0, 2.0),
           row("weir", resolution, "flux against the inflow, %", 100.0 * (flux / wanted - 1.0), {}, {}),
           row("weir", resolution, "least depth on the sill over the critical depth",
               crest / std::cbrt(flux * flux / kGravity), {}, {})},
          {plot}};
}

}  // namespace

std::vector<Case> streamCases() {
  return {{"slug", "stream", "Uniform stream in and out", {32, 64}, {32}, slug, {}},
          {"outflow_wave", "stream", "A wave that leaves with the stream", {96, 192}, {}, outflowWave, {}},
          {"weir", "stream", "Broad-crested weir", {96, 192}, {}, weir, {}}};
}

}  // namespace fluidtex::validation
