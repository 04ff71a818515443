#include "pipeline/orientation_guide.h"

#include "caches/liquid/placement.h"
#include "pipeline/read_grid.h"
#include "pipeline/scalars.h"
#include "sim/grid/mac_grid.h"
#include "sim/solids/domain.h"
#include "texture/loops/parallel.h"
#include "texture/orientation/directions.h"
#include "transport/carry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace fluidtex::pipeline {
namespace {

using texture::Align;
using texture::Vec3f;

// Flow that takes more frames than this for one spacing hardly counts.
constexpr double kSlowFrames = 20.0;
// Factor on the cost of turning in keep_clear: singularities leave by about ten spacings a frame, its square
// root.
constexpr float kStiff = 100.0f;

// Of the liquid's own vectors.
std::vector<Vec3f> vectorsAt(const std::vector<Vec3f>& positions, const OrientationGuide& guide,
                             const sim::Frame& frame) {
  std::vector<openvdb::Vec3d> vectors(positions.size(), openvdb::Vec3d(0.0));
  for (int axis = 0; axis < 3; ++axis) {
    const std::string name = guide.options.attribute + std::array{"_x", "_y", "_z"}[std::size_t(axis)];
    const auto values = sampled(fieldOf(frame, name), positions);
    texture::forEachIndex(vectors.size(), [&](std::uint32_t v) { vectors[v][axis] = values[v]; });
  }
  std::vector<Vec3f> result(vectors.size());
  texture::forEachIndex(
      vectors.size(), [&](std::uint32_t v) { result[v] = Vec3f(guide.worldFromFile.transform(vectors[v])); });
  return result;
}

std::vector<Vec3f> directions(const OrientationGuide& guide, const sim::Frame& frame,
                              const texture::SurfaceMesh& mesh) {
  switch (guide.options.align) {
    case Align::gravity:
      return texture::alongDirection(mesh, Vec3f(guide.gravity));
    case Align::flow:
      return texture::alongFlow(mesh, transport::velocityAt(mesh.positions, frame),
                                mesh.spacing * guide.frameRate / kSlowFrames);
    case Align::curvature:
      return texture::alongBend(mesh);
    case Align::direction:
      return texture::alongDirection(mesh, Vec3f(guide.options.direction));
    case Align::field:
      return texture::alongField(mesh, *guide.field);
    case Align::attribute:
      return texture::alongVectors(mesh, vectorsAt(mesh.positions, guide, frame));
    case Align::none:
      break;
  }
  return std::vector<Vec3f>(mesh.positions.size(), Vec3f(0.0f));
}

// Falls from kStiff to 1 over one spacing around the shapes.
std::vector<float> stiffness(const OrientationGuide& guide, const texture::SurfaceMesh& mesh) {
  std::vector<float> result(mesh.positions.size(), 1.0f);
  texture::forEachIndex(result.size(), [&](std::uint32_t v) {
    double nearest = mesh.spacing;
    for (const sim::ShapeDistance& shape : guide.keepClear)
      nearest = std::min(nearest, shape(sim::Vec3d(mesh.positions[v])));
    const auto inside = static_cast<float>(std::clamp(1.0 - nearest / mesh.spacing, 0.0, 1.0));
    result[v] = 1.0f + (kStiff - 1.0f) * inside;
  });
  return result;
}

}  // namespace

OrientationGuide orientationGuide(const scenes::Scene& scene) {
  OrientationGuide guide{scene.texture.orientation,
                         scene.sim.gravity,
                         scene.sim.frameRate,
                         nullptr,
                         caches::worldFromFile(scene.files).getMat3(),
                         {}};
  if (guide.options.align == Align::field) guide.field = readGrid<openvdb::Vec3SGrid>(guide.options.field);
  for (const sim::Shape& shape : scene.keepClear)
    guide.keepClear.emplace_back(shape, scene.sim.voxelSize(), sim::domainBox(scene.sim));
  return guide;
}

texture::OrientWishes wishesFor(const OrientationGuide& guide, const sim::Frame& frame) {
  texture::OrientWishes wishes;
  if (guide.options.align != Align::none && guide.options.weight > 0.0) {
    wishes.direction = [&](const texture::SurfaceMesh& mesh) {
      std::vector<Vec3f> result = directions(guide, frame, mesh);
      const double angle = guide.options.angle * std::numbers::pi / 180.0;
      const auto along = static_cast<float>(guide.options.weight * std::cos(angle)),
                 across = static_cast<float>(guide.options.weight * std::sin(angle));
      texture::forEachIndex(result.size(), [&](std::uint32_t v) {
        result[v] = result[v] * along + mesh.normals[v].cross(result[v]) * across;
      });
      return result;
    };
  }
  if (!guide.keepClear.empty())
    wishes.stiffness = [&](const texture::SurfaceMesh& mesh) { return stiffness(guide, mesh); };
  return wishes;
}

}  // namespace fluidtex::pipeline
