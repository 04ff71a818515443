#include "sim/motion/analytic_flow.h"

#include "sim/flows/move_surface.h"
#include "sim/shapes/shape_distance.h"
#include "sim/solids/domain.h"
#include "sim/step/check_options.h"
#include "sim/step/describe_liquid.h"
#include "sim/step/step.h"
#include "sim/step/step_failures.h"
#include "sim/surface/level_set.h"
#include "sim/surface/settle_surface.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace fluidtex::sim {
namespace {

// Margin beyond the domain in which phi and the velocity continue, cells.
constexpr int kMargin = kLeafDim;

bool carriesSurface(MotionKind flow) {
  return flow == MotionKind::vortex || flow == MotionKind::deformation;
}

bool changesShape(const MotionOptions& motion) {
  return motion.flow == MotionKind::rotation || (motion.flow == MotionKind::slot && motion.widening > 0.0);
}

KnownFlow flowOf(const Options& options, const MotionOptions& motion) {
  const Vec3d middle = 0.5 * options.size;
  switch (motion.flow) {
    case MotionKind::rotation:
      return rotation(middle, motion.rate);
    // At its centre the vortex of the unit square turns by 2 pi a second.
    case MotionKind::vortex:
      return drawnOut(singleVortex(motion.period), options.size, motion.rate / (2.0 * std::numbers::pi));
    case MotionKind::deformation:
      return drawnOut(deformation3d(motion.period), options.size, 1.0);
    case MotionKind::stretch:
      return stretch(middle, motion.rate);
    case MotionKind::sourceSink:
      return sourceAndSink(options.size, motion.rate);
    case MotionKind::slot:
      return slot(motion.speed, motion.strain);
    case MotionKind::rest:
    case MotionKind::solver:
    case MotionKind::files:
      break;
  }
  return still();
}

// x turned back about the vertical axis through the middle.
Vec3d turnedBack(const Vec3d& x, const Vec3d& middle, double angle) {
  const Vec3d from = x - middle;
  const double c = std::cos(angle), s = std::sin(angle);
  return middle + Vec3d(c * from[0] + s * from[1], c * from[1] - s * from[0], from[2]);
}

// x moved towards the middle of the slit, by as far as its ends had moved when what is at x left it.
Vec3d narrowedBack(const Vec3d& x, double middle, double time, const MotionOptions& motion) {
  const double left = time - timeFromSlot(x[0], motion.speed, motion.strain);
  const double aside = x[1] - middle, moved = motion.widening * std::max(left, 0.0);
  return Vec3d(x[0], middle + std::copysign(std::max(std::abs(aside) - moved, 0.0), aside), x[2]);
}

// Along each axis.
Coord boundedCells(const SolidField& solid) {
  if (isEndless(solid.domain))
    throw std::invalid_argument("a flow in closed form needs a domain with bounds");
  return solid.domain.dim();
}

}  // namespace

AnalyticFlow::AnalyticFlow(const Options& options, const MotionOptions& motion,
                           std::shared_ptr<const SolidField> solid)
    : m_options(checked(options)),
      m_motion(motion),
      m_flow(flowOf(options, motion)),
      m_solid(std::move(solid)),
      m_velocity(faceVelocity(m_flow, boundedCells(*m_solid), kMargin, options.voxelSize())),
      m_speed(maxAbs(m_velocity)) {}

AnalyticFlow::AnalyticFlow(const Options& options, const MotionOptions& motion)
    : AnalyticFlow(options, motion, Solids(options).at(0.0)) {
  const Velocity nothing = makeVelocity(options.voxelSize());
  m_state.velocity.component[0] = nothing.component[0];
  m_state.velocity.component[1] = nothing.component[1];
  m_state.velocity.component[2] = nothing.component[2];
  m_state.phi = pouredAt(0.0);
  if (carriesSurface(motion.flow))
    m_state.markers =
        seedMarkers(*m_state.phi, *m_solid->phi, markerSeed(options.seed, 0), m_solid->visibility.get());
}

AnalyticFlow::AnalyticFlow(const Options& options, const MotionOptions& motion, State state)
    : AnalyticFlow(options, motion, Solids(options).at(0.0)) {
  checkResolution(state, options);
  m_state = std::move(state);
  m_state.phi->setTransform(cellTransform(options.voxelSize()));
}

// The liquid as it was poured, turned or widened since.
FloatGrid::Ptr AnalyticFlow::pouredAt(double time) const {
  const double h = m_options.voxelSize();
  const Vec3d middle = 0.5 * m_options.size;
  const auto poured = [&](const Vec3d& x) {
    if (m_motion.flow == MotionKind::rotation) return turnedBack(x, middle, m_motion.rate * time);
    if (m_motion.flow == MotionKind::slot) return narrowedBack(x, middle[1], time, m_motion);
    return x;
  };
  FloatGrid::Ptr phi = makePhi(h, bandWidth(m_options.cfl) * h);
  for (const LiquidBody& body : m_options.liquid) {
    const ShapeDistance distance(body.shape, h, domainBox(m_options));
    unite(
        *phi, [&](const Vec3d& x) { return distance(poured(x)); }, grown(m_solid->domain, kMargin));
  }
  settleSurface(*phi, *m_solid);
  return phi;
}

// The flow in the blocks that the surface can reach in a step, and in those around them.
Velocity AnalyticFlow::near(double strength) const {
  FloatTree topology(0.0f);
  const FloatTree& known = m_velocity.component[0]->constTree();
  for (const FloatLeaf* leaf : leavesOf(std::as_const(*m_state.phi).constTree())) {
    for (int n = 0; n < 27; ++n) {
      const Coord step(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1);
      const Coord origin = leaf->origin() + Coord(step[0] * kLeafDim, step[1] * kLeafDim, step[2] * kLeafDim);
      if (known.probeConstLeaf(origin) != nullptr) topology.touchLeaf(origin)->setValuesOn();
    }
  }
  Velocity velocity = makeVelocity(m_options.voxelSize(), topology);
  scale(m_velocity, strength, velocity);
  return velocity;
}

void AnalyticFlow::carryTo(double time, Frame& frame, const std::function<void(double)>& progress) {
  const double length = time - m_state.time, begin = m_state.time;
  double strength = 0.0;  // the greatest: it is a cosine, which has it at an end of so short a time
  for (const double t : {begin, time}) strength = std::max(strength, std::abs(m_flow.strength(t)));
  const double cells = length * strength * m_speed / m_options.voxelSize();
  const double needed = std::ceil(cells / std::min(m_options.cfl, kMaxTrace - 1.0));
  if (!(needed <= 1.0 / kShortest)) failFast(begin, strength * m_speed, 0.0);
  const int steps = std::max(1, static_cast<int>(needed));
  const double dt = length / steps;
  for (int n = 0; n < steps; ++n) {
    const Velocity velocity = near(m_flow.strength(begin + (n + 0.5) * dt));
    ++m_state.steps;
    moveSurface(*m_state.phi, m_state.markers,
                {velocity, *m_solid, dt, markerSeed(m_options.seed, m_state.steps)});
    frame.substeps.push_back({dt, velocity.component[0], velocity.component[1], velocity.component[2]});
    if (progress) progress((n + 1.0) / steps);
  }
  frame.stats.dtMin = dt;
}

Frame AnalyticFlow::next(const std::function<void(double)>& progress) {
  Frame frame;
  frame.index = m_state.frame + 1;
  frame.time = m_state.frame / m_options.frameRate;
  if (m_state.frame > 0) {
    if (carriesSurface(m_motion.flow)) {
      carryTo(frame.time, frame, progress);
    } else {
      const double dt = frame.time - m_state.time;
      const auto& [u, v, w] = m_velocity.component;
      frame.substeps.push_back({dt, u, v, w});
      frame.stats.dtMin = dt;
      if (changesShape(m_motion)) m_state.phi = pouredAt(frame.time);
    }
  }
  m_state.frame = frame.index;
  m_state.time = frame.time;
  describeLiquid(frame, *m_state.phi, *m_solid);
  if (progress) progress(1.0);
  return frame;
}

}  // namespace fluidtex::sim
