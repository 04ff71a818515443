#include "tools/benchmarks/transport_problem.h"

#include "numerics/random.h"
#include "texture/mesh/prepare.h"
#include "texture/orientation/tangent.h"
#include "tools/benchmarks/deformed_shapes.h"
#include "tools/benchmarks/moving_surfaces.h"
#include "transport/carry.h"

#include <openvdb/tools/Morphology.h>

#include <cmath>
#include <utility>

namespace fluidtex::benchmarks {
namespace {

using texture::Vec3f;

constexpr double kFastest = 2.0;  // m/s, of the deformation
constexpr float kOff = 0.3f;      // how far off the moved points the new ones lie, spacings

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
  constexpr int kBand = kTransportSubsteps + 4;  // cells
  const double dt = h / kFastest;
  sim::MaskTree band;
  openvdb::tree::ValueAccessor<sim::MaskTree> mark(band);
  for (const Vec3f& x : positions) mark.setValueOn(openvdb::Coord::floor(openvdb::Vec3d(x) / h));
  openvdb::tools::dilateActiveValues(band, kBand, openvdb::tools::NN_FACE, openvdb::tools::IGNORE_TILES);
  sim::Frame frame;
  frame.index = 2;
  frame.time = kTransportSubsteps * dt;
  for (int s = 0; s < kTransportSubsteps; ++s) {
    const double t = (s + 0.5) * dt;
    frame.substeps.push_back(
        {dt, component(band, h, 0, t), component(band, h, 1, t), component(band, h, 2, t)});
  }
  return frame;
}

}  // namespace

TransportProblem transportProblem(int points) {
  const MovingSurface moving = movingSurface("sphere", points);
  texture::SurfaceMesh mesh =
      std::move(texture::prepareSurface(*moving.before, moving.spacing, texture::Seeds{}, 1, {}).levels[0]);
  TransportProblem problem;
  problem.frame = frameAround(mesh.positions, moving.spacing);
  problem.next = mesh;
  problem.next.positions = transport::moved(mesh.positions, problem.frame);
  const std::vector<Vec3f> along = texture::referenceVectors(mesh.normals);
  for (std::size_t v = 0; v < along.size(); ++v) {
    const auto angle = float(6.283185307 * randomUnit(3, v));
    const Vec3f across = mesh.normals[v].cross(along[v]);
    problem.next.positions[v] +=
        (along[v] * std::cos(angle) + across * std::sin(angle)) * float(kOff * moving.spacing);
  }
  static_cast<texture::SurfaceMesh&>(problem.previous) = std::move(mesh);
  texture::clearTexture(problem.previous);
  problem.previous.orientation = along;
  problem.previous.coordinate.assign(along.size(), texture::Vec2f(1.0f, 2.0f));
  problem.previous.age.assign(along.size(), 1.0f);
  problem.previous.trust.assign(along.size(), 1.0f);
  return problem;
}

}  // namespace fluidtex::benchmarks
