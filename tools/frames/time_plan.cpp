#include "tools/frames/time_plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::tools {
namespace {

// CPU seconds, of the dam break at 40 and 96 cells, 8,000 and 58,000 points, one and eight ways, on two cores
// of an x86-64 server (2026-11).
constexpr double kSubstep = 0.065, kCellSubstep = 3.4e-6;
constexpr double kPoint = 20e-6;                      // surface, transport, files
constexpr double kFirst = 68e-6, kFirstWay = 7.6e-6;  // a point
constexpr double kLater = 22e-6, kLaterWay = 8.3e-6;  // a point, half of them renewed
constexpr double kTable = 11e-6;                      // a pixel of the exemplar and way
constexpr double kPath = 0.47e-6;                     // with two bounces
constexpr double kSmooth = 2e-6;                      // a pixel
// Of what more threads could save.
constexpr double kUsed = 0.8;
// Liquid that has fallen from the top of the domain, and its splash.
constexpr double kSplash = 1.5;
// Times as long as with one way, from which on that is worth a word.
constexpr double kMuchLonger = 1.5;

int waysOf(const texture::OrientationOptions& orientation) {
  return orientation.symmetry * (orientation.mirrored ? 2 : 1);
}

// Of a pixel: shipped scenes took that many before their noise was below its bound.
double pathsOf(const render::Options& render) {
  constexpr double kFirst = 16.0, kAtNoiseOne = 8e-4;
  const double enough =
      render.noise > 0.0 ? kFirst + kAtNoiseOne / (render.noise * render.noise) : double(render.samples);
  return std::min(double(render.samples), enough);
}

// As many as the fastest cell crossed needs.
double substepsOf(const scenes::Scene& scene) {
  double fastest = kSplash * std::sqrt(2.0 * scene.sim.gravity.length() * scene.sim.size.z());
  for (const sim::Source& source : scene.sim.sources) fastest = std::max(fastest, source.velocity.length());
  for (const sim::LiquidBody& body : scene.sim.liquid) fastest = std::max(fastest, body.velocity.length());
  return std::max(1.0, fastest / (scene.sim.cfl * scene.sim.voxelSize() * scene.sim.frameRate));
}

}  // namespace

PlannedTime plannedTime(const scenes::Scene& scene, const pipeline::LiquidPlan& liquid, double points,
                        double pixels, int threads) {
  const double share = threads > 1 ? 1.0 / (kUsed * threads) : 1.0;
  const int ways = waysOf(scene.texture.orientation);
  const bool textured = scene.texture.synthesis.method != texture::Method::none;
  PlannedTime plan;
  if (scene.motion.flow == sim::MotionKind::solver)
    plan.simulate = share * substepsOf(scene) * (kSubstep + kCellSubstep * double(liquid.cells));
  plan.texture = share * points * (kPoint + (textured ? kLater + kLaterWay * ways : 0.0));
  plan.firstTexture = share * (points * (kPoint + (textured ? kFirst + kFirstWay * ways : 0.0)) +
                               (textured ? kTable * ways * pixels : 0.0));
  plan.render = share * scene.render.width * scene.render.height *
                (kPath * pathsOf(scene.render) + (scene.render.smooth ? kSmooth : 0.0));
  return plan;
}

std::string waysNote(const texture::OrientationOptions& orientation) {
  const int ways = waysOf(orientation);
  const double longer = (kLater + kLaterWay * ways) / (kLater + kLaterWay);
  if (longer < kMuchLonger) return {};
  return fmt::format(
      "the exemplar is searched in {} ways (texture.orientation.symmetry = {}{}), so that texture takes "
      "about {:.0f} times as long where the liquid is lively",
      ways, orientation.symmetry, orientation.mirrored ? ", mirrored" : "", longer);
}

}  // namespace fluidtex::tools
