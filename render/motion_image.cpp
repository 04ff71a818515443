#include "render/motion_image.h"

#include "render/camera.h"
#include "render/embree_scene.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace fluidtex::render {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
constexpr float kGrey = 0.5f;  // encoded

// Pixel coordinates of a place; unknown behind the camera.
Vec2f pixelOf(const CameraRays& camera, const Vec3f& x) {
  const Vec3f arm = x - camera.origin;
  const float depth = arm.dot(camera.forward);
  if (!(depth > 0.0f)) return Vec2f(kUnknown);
  const float step = lengthSquared(camera.right);  // squared; that of `down` is the same
  return {camera.center[0] + arm.dot(camera.right) / (depth * step),
          camera.center[1] + arm.dot(camera.down) / (depth * step)};
}

template <typename Value>
Value between(const std::vector<Value>& values, const texture::Vec3I& corners, const Vec3f& weights) {
  return values[corners[0]] * weights[0] + values[corners[1]] * weights[1] + values[corners[2]] * weights[2];
}

// The four pixels around pixel coordinates, and their weights; nothing beyond the picture.
struct Around {
  std::array<std::size_t, 4> pixel;
  std::array<float, 4> weight;
};
std::optional<Around> around(const MotionImage& image, const Vec2f& at) {
  const float x = at[0] - 0.5f, y = at[1] - 0.5f;
  if (!(x >= 0.0f && y >= 0.0f && x <= float(image.width - 1) && y <= float(image.height - 1)))
    return std::nullopt;
  const int i = std::min(int(x), image.width - 2), j = std::min(int(y), image.height - 2);
  const float u = x - float(i), v = y - float(j);
  const auto first = std::size_t(j) * std::size_t(image.width) + std::size_t(i);
  return Around{{first, first + 1, first + std::size_t(image.width), first + std::size_t(image.width) + 1},
                {(1.0f - u) * (1.0f - v), u * (1.0f - v), (1.0f - u) * v, u * v}};
}

}  // namespace

MotionImage motionImage(const texture::TexturedSurface& surface, const std::vector<Vec3f>& color,
                        const Options& options, double now, double before, float leastTrust) {
  const auto pixels = std::size_t(options.width) * std::size_t(options.height);
  MotionImage image{options.width,
                    options.height,
                    std::vector<Vec3f>(pixels, Vec3f(kGrey)),
                    std::vector<float>(pixels, std::numeric_limits<float>::infinity()),
                    std::vector<Vec2f>(pixels, Vec2f(kUnknown)),
                    std::vector<float>(pixels, kUnknown)};
  if (surface.empty() || surface.triangles.empty()) return image;
  EmbreeScene scene;
  scene.add(surface.positions, surface.triangles);
  scene.commit();
  const CameraRays camera = makeCamera(options.camera, image.width, image.height, now);
  const CameraRays then = makeCamera(options.camera, image.width, image.height, before);
  tbb::parallel_for(0, image.height, [&](int y) {
    std::vector<Ray> rays;
    for (int x = 0; x < image.width; ++x)
      rays.push_back({camera.origin, camera.direction(float(x) + 0.5f, float(y) + 0.5f)});
    scene.intersect(rays, Coherence::alike);
    for (std::size_t x = 0; x < rays.size(); ++x) {
      const Ray& ray = rays[x];
      if (!ray.hit()) continue;
      const std::size_t pixel = std::size_t(y) * std::size_t(image.width) + x;
      const texture::Vec3I& corners = surface.triangles[ray.triangle];
      const Vec3f weights(1.0f - ray.u - ray.v, ray.u, ray.v);
      image.color[pixel] = between(color, corners, weights);
      image.distance[pixel] = (between(surface.positions, corners, weights) - camera.origin).length();
      if (!(between(surface.trust, corners, weights) >= leastTrust)) continue;
      const Vec3f place = between(surface.previousPosition, corners, weights);
      image.before[pixel] = pixelOf(then, place);
      image.distanceBefore[pixel] = (place - then.origin).length();
    }
  });
  return image;
}

std::optional<WarpError> warpError(const MotionImage& before, const MotionImage& now, double tolerance) {
  if (before.width != now.width || before.height != now.height)
    throw std::invalid_argument("warp error: pictures of two sizes");
  if (now.width < 2 || now.height < 2) return std::nullopt;
  double sum = 0.0;
  std::size_t liquid = 0, seen = 0;
  for (std::size_t pixel = 0; pixel < now.color.size(); ++pixel) {
    liquid += std::isfinite(now.distance[pixel]);
    const std::optional<Around> from = around(before, now.before[pixel]);
    if (!from) continue;
    Vec3f read(0.0f);
    bool same = true;
    for (std::size_t n = 0; n < 4; ++n) {
      same = same && std::abs(before.distance[from->pixel[n]] - now.distanceBefore[pixel]) <= tolerance;
      read += before.color[from->pixel[n]] * from->weight[n];
    }
    if (!same) continue;
    ++seen;
    sum += double(lengthSquared(now.color[pixel] - read));
  }
  if (seen == 0) return std::nullopt;
  return WarpError{sum / double(seen), double(seen) / double(liquid)};
}

void writeFlo(const MotionImage& image, const std::filesystem::path& file) {
  std::vector<float> motion;
  motion.reserve(2 * image.before.size());
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const Vec2f& before = image.before[std::size_t(y) * std::size_t(image.width) + std::size_t(x)];
      const bool known = std::isfinite(before[0]) && std::isfinite(before[1]);
      motion.push_back(known ? before[0] - float(x) - 0.5f : 1e10f);
      motion.push_back(known ? before[1] - float(y) - 0.5f : 1e10f);
    }
  std::ofstream out(file, std::ios::binary);
  const std::int32_t size[2] = {image.width, image.height};
  out.write("PIEH", 4);
  out.write(reinterpret_cast<const char*>(size), sizeof size);
  out.write(reinterpret_cast<const char*>(motion.data()), std::streamsize(motion.size() * sizeof(float)));
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace fluidtex::render
