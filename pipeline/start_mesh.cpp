#include "pipeline/start_mesh.h"

#include "scenes/schema.h"
#include "sim/meshes/read_uv_mesh.h"
#include "texture/exemplar/exemplar.h"
#include "texture/frames/renewal.h"
#include "transport/onto.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace fluidtex::pipeline {
namespace {

using texture::TexelGradient;
using texture::TexturedSurface;
using texture::Vec2f;
using texture::Vec3f;

// Where more of the picture is shown, none of it is kept from being used.
constexpr double kNearlyAll = 0.98;

// Twice the signed area of a triangle in the picture, pixels.
double crossOf(const Vec2f& a, const Vec2f& b, const Vec2f& c) {
  const openvdb::Vec2d x(b - a), y(c - a);
  return x[0] * y[1] - x[1] * y[0];
}

// Gradient of the affine map that takes the triangle's corners x to the texels q. normal: twice the area.
TexelGradient gradientOf(const std::array<Vec3f, 3>& x, const std::array<Vec2f, 3>& q, const Vec3f& normal) {
  // Of a corner's barycentric coordinate: perpendicular to the opposite edge.
  const float square = normal.lengthSqr();
  TexelGradient gradient;
  for (std::size_t c = 0; c < 3; ++c) {
    const Vec3f slope = normal.cross(x[(c + 2) % 3] - x[(c + 1) % 3]) / square;
    gradient.s += slope * q[c][0];
    gradient.t += slope * q[c][1];
  }
  return gradient;
}

TexturedSurface texturedMesh(const sim::UvMesh& mesh, int width, int height) {
  TexturedSurface surface;
  surface.exemplarWidth = width;
  surface.exemplarHeight = height;
  std::vector<Vec2f> coordinate;
  std::vector<TexelGradient> gradients;
  double area = 0.0, pixels = 0.0;
  for (std::size_t i = 0; i + 2 < mesh.positions.size(); i += 3) {
    std::array<Vec3f, 3> x;
    std::array<Vec2f, 3> q;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec2f& uv = mesh.uv[i + c];
      x[c] = mesh.positions[i + c];
      q[c] = {uv[0] * float(width) - 0.5f, (1.0f - uv[1]) * float(height) - 0.5f};
    }
    const Vec3f normal = (x[1] - x[0]).cross(x[2] - x[0]);
    const double shown = 0.5 * std::abs(crossOf(q[0], q[1], q[2]));
    if (!(normal.lengthSqr() > 0.0f) || !(shown > 0.0)) continue;
    const TexelGradient gradient = gradientOf(x, q, normal);
    if (!std::isfinite(gradient.s.lengthSqr()) || !std::isfinite(gradient.t.lengthSqr()) ||
        !(gradient.s.lengthSqr() > 0.0f))
      continue;
    area += 0.5 * double(normal.length());
    pixels += shown;
    const auto first = std::uint32_t(surface.positions.size());
    surface.triangles.emplace_back(first, first + 1, first + 2);
    for (std::size_t c = 0; c < 3; ++c) {
      surface.positions.push_back(x[c]);
      surface.normals.push_back(normal.unit());
      surface.orientation.push_back(gradient.s.unit());
      coordinate.push_back(q[c]);
      gradients.push_back(gradient);
    }
  }
  texture::clearTexture(surface);
  surface.coordinate = std::move(coordinate);
  surface.gradient = std::move(gradients);
  surface.trust.assign(surface.positions.size(), 1.0f);
  surface.spacing = pixels > 0.0 ? std::sqrt(area / pixels) : 0.0;
  return surface;
}

}  // namespace

TexturedSurface startSurface(const scenes::Scene& scene, int width, int height) {
  if (scene.start.mesh.file.empty()) return {};
  TexturedSurface surface = texturedMesh(sim::readUvMesh(scene.start.mesh), width, height);
  if (surface.empty())
    throw sim::MeshError(scene.start.mesh.file.string() +
                         ": its texture coordinates span no area; unwrap it, and export its UVs with it");
  return surface;
}

bool beginsWithMesh(const scenes::Scene& scene) {
  return !scene.start.mesh.file.empty() && texture::looksUp(scene.texture) &&
         scene.texture.laterFrames == texture::LaterFrames::synthesize;
}

namespace {

// The limits of texture.spacing, where the domain is known.
void checkPixel(const scenes::Scene& scene, double pixel) {
  const sim::Vec3d& size = scene.sim.size;
  const double shortest = std::min({size[0], size[1], size[2]});
  if (!(shortest > 0.0)) return;
  const double faces = 2.0 * (size[0] * size[1] + size[1] * size[2] + size[2] * size[0]);
  const char* wrong = pixel >= shortest ? "as long as the domain's shortest side or longer"
                      : faces / pixel / pixel > scenes::kMostPoints
                          ? "so short that the liquid would have too many points"
                          : nullptr;
  if (wrong == nullptr) return;
  throw sim::MeshError(
      fmt::format("{}: a pixel of its picture is {:.3g} m long on it, {}; is its scale right?",
                  scene.start.mesh.file.string(), pixel, wrong));
}

}  // namespace

void fitToStart(scenes::Scene& scene) {
  texture::ExemplarOptions& exemplar = scene.texture.exemplar;
  if (scene.start.mesh.file.empty() || exemplar.file.empty() || scene.start.fitted) return;
  const texture::Image picture = texture::exemplarPicture(exemplar);
  const TexturedSurface start = startSurface(scene, picture.width, picture.height);
  double area = 0.0;
  for (const texture::Vec3I& t : start.triangles) {
    const Vec3f& a = start.positions[t[0]];
    area += 0.5 * double((start.positions[t[1]] - a).cross(start.positions[t[2]] - a).length());
  }
  const double wanted =
      scene.texture.spacing > 0.0 ? scene.texture.spacing : std::sqrt(area / scene.texture.points);
  const std::vector<int>& windows = scene.texture.synthesis.windows;
  const int least = 2 * *std::max_element(windows.begin(), windows.end());
  double pixel = start.spacing;
  int size = std::min(picture.width, picture.height);
  while (std::numbers::sqrt2 * pixel < wanted && size >= 2 * least) {
    pixel *= 2.0;
    size /= 2;
    ++exemplar.halvings;
  }
  checkPixel(scene, pixel);
  scene.texture.spacing = pixel;
  scene.start.fitted = true;
}

namespace {

// Grown by kMargin pixels to all sides, since what is read beside an edge is mixed of both.
texture::Image grown(const texture::Image& shown, bool toroidal) {
  constexpr int kMargin = 2;
  texture::Image result = shown;
  for (int y = 0; y < shown.height; ++y)
    for (int x = 0; x < shown.width; ++x) {
      if (*shown.at(x, y) == 0.0f) continue;
      for (int j = y - kMargin; j <= y + kMargin; ++j)
        for (int i = x - kMargin; i <= x + kMargin; ++i) {
          const bool inside = i >= 0 && j >= 0 && i < shown.width && j < shown.height;
          if (inside || toroidal)
            *result.at((i + shown.width) % shown.width, (j + shown.height) % shown.height) = 1.0f;
        }
    }
  return result;
}

// First and last pixel of a triangle along an axis: on the picture, or once around where it is repeated.
std::array<int, 2> rangeOf(const std::array<Vec2f, 3>& q, int axis, int size, bool toroidal) {
  const auto [low, high] = std::minmax({q[0][axis], q[1][axis], q[2][axis]});
  if (!toroidal)
    return {int(std::clamp(std::ceil(low), 0.0f, float(size))),
            int(std::clamp(std::floor(high), -1.0f, float(size - 1)))};
  const float most = float(size);
  if (!(high - low < most)) return {0, size - 1};
  return {int(std::ceil(low)), int(std::floor(high))};
}

}  // namespace

texture::Image shownByStart(const TexturedSurface& start, int width, int height, bool toroidal) {
  if (start.empty()) return {};
  texture::Image shown{width, height, 1, std::vector<float>(std::size_t(width) * std::size_t(height), 0.0f)};
  for (const texture::Vec3I& t : start.triangles) {
    const std::array<Vec2f, 3> q{start.coordinate[t[0]], start.coordinate[t[1]], start.coordinate[t[2]]};
    const double whole = crossOf(q[0], q[1], q[2]);
    const auto [left, right] = rangeOf(q, 0, width, toroidal);
    const auto [top, bottom] = rangeOf(q, 1, height, toroidal);
    for (int y = top; y <= bottom; ++y)
      for (int x = left; x <= right; ++x) {
        const Vec2f texel{float(x), float(y)};
        const double a = crossOf(q[1], q[2], texel) / whole, b = crossOf(q[2], q[0], texel) / whole;
        if (a < 0.0 || b < 0.0 || a + b > 1.0) continue;
        *shown.at((x % width + width) % width, (y % height + height) % height) = 1.0f;
      }
  }
  shown = grown(shown, toroidal);
  double sum = 0.0;
  for (const float value : shown.data) sum += double(value);
  if (sum > kNearlyAll * double(shown.data.size())) return {};
  return shown;
}

texture::Carried startOn(const TexturedSurface& start, const texture::SurfaceMesh& mesh, double voxel,
                         int symmetry) {
  TexturedSurface from = start;
  from.spacing = std::max(voxel, mesh.spacing);  // of trust: how far the surface may lie off the mesh
  TexturedSurface placed = transport::onto(from, mesh.positions, mesh.triangles, symmetry);
  texture::Carried carried;
  static_cast<texture::VertexTexture&>(carried) = std::move(placed);
  carried.orientation = std::move(placed.orientation);
  carried.previousPosition = mesh.positions;
  carried.renewal.assign(mesh.positions.size(), 0.0f);
  carried.original.resize(mesh.positions.size());
  for (std::size_t v = 0; v < carried.original.size(); ++v)
    carried.original[v] = texture::believed(carried.trust[v]);
  return carried;
}

}  // namespace fluidtex::pipeline
