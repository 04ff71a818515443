#include "pipeline/texture_guidance.h"

#include "pipeline/read_grid.h"
#include "pipeline/scalars.h"
#include "texture/frames/renewal.h"
#include "texture/orientation/curvature.h"
#include "transport/carry.h"
#include "transport/foam.h"

namespace fluidtex::pipeline {
namespace {

using texture::GuidanceBy;
using texture::Vec3f;

std::vector<float> speeds(const std::vector<Vec3f>& positions, const sim::Frame& frame) {
  const std::vector<Vec3f> velocity = transport::velocityAt(positions, frame);
  std::vector<float> result(velocity.size());
  texture::forEachIndex(result.size(), [&](std::uint32_t v) { result[v] = velocity[v].length(); });
  return result;
}

// |curl u|
std::vector<float> vorticities(const std::vector<Vec3f>& positions, const sim::Frame& frame) {
  const auto slope = transport::velocitySlopes(positions, frame);
  std::vector<float> result(positions.size());
  texture::forEachIndex(result.size(), [&](std::uint32_t v) {
    const Vec3f &x = slope[0][v], &y = slope[1][v], &z = slope[2][v];
    result[v] = Vec3f(y[2] - z[1], z[0] - x[2], x[1] - y[0]).length();
  });
  return result;
}

// #V, s; 0 on newly exposed surface.
std::vector<float> ages(const texture::Carried& carried, std::size_t count) {
  std::vector<float> result(count, 0.0f);
  for (std::size_t v = 0; v < carried.age.size(); ++v)
    if (texture::believed(carried.trust[v])) result[v] = carried.age[v];
  return result;
}

std::vector<float> levelsOn(const TextureGuidance& guidance, const sim::Frame& frame,
                            const texture::Carried& carried, double seconds, texture::SurfaceMesh& mesh) {
  const std::vector<texture::CurvePoint>& points = guidance.options.points;
  const auto along = [&](std::vector<float> values) {
    for (float& value : values) value = float(curveAt(points, value));
    return values;
  };
  switch (guidance.options.by) {
    case GuidanceBy::none:
      break;
    case GuidanceBy::height:
      return alongCurve(points, mesh.positions, [] { return [](const openvdb::Vec3d& x) { return x.z(); }; });
    case GuidanceBy::temperature:
      return alongCurve(points, mesh.positions, sampler(fieldOf(frame, "temperature")));
    case GuidanceBy::mixture:
      return alongCurve(points, mesh.positions, sampler(fieldOf(frame, "mixture")));
    case GuidanceBy::speed:
      return along(speeds(mesh.positions, frame));
    case GuidanceBy::vorticity:
      return along(vorticities(mesh.positions, frame));
    case GuidanceBy::curvature:
      return along(texture::meanCurvature(mesh));
    case GuidanceBy::age:
    case GuidanceBy::renewal:  // keepAge() in texture_frame.cpp makes carried.age the surface's for `age`
      return along(ages(carried, mesh.positions.size()));
    case GuidanceBy::foam:
      mesh.foam = transport::foamAfter(mesh.positions, frame, carried, seconds, guidance.options.foam);
      return along(mesh.foam);
    case GuidanceBy::field:
      return alongCurve(points, mesh.positions, sampler(*guidance.field));
    case GuidanceBy::attribute:
      return alongCurve(points, mesh.positions, sampler(fieldOf(frame, guidance.options.attribute)));
  }
  return {};
}

}  // namespace

TextureGuidance textureGuidance(const scenes::Scene& scene) {
  TextureGuidance guidance{scene.texture.guidance, nullptr};
  if (guidance.options.by == GuidanceBy::field)
    guidance.field = readGrid<openvdb::FloatGrid>(guidance.options.field);
  return guidance;
}

void guide(const TextureGuidance& guidance, const sim::Frame& frame, const texture::Carried& carried,
           double seconds, texture::Surface& surface) {
  const texture::Carried nothing;
  for (std::size_t level = 0; level < surface.levels.size(); ++level) {
    texture::SurfaceMesh& mesh = surface.levels[level];
    mesh.guidance = levelsOn(guidance, frame, level == 0 ? carried : nothing, seconds, mesh);
  }
}

}  // namespace fluidtex::pipeline
