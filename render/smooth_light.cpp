#include "render/smooth_light.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace fluidtex::render {
namespace {

constexpr int kLevels = 5;
constexpr float kSpline[3] = {3.0f / 8.0f, 1.0f / 4.0f, 1.0f / 16.0f};  // cubic B-spline, by distance
constexpr int kErrorRadius =
    3;  // pixels over which the estimated error is averaged: one estimate says little
constexpr float kLeastAlbedo = 0.004f;  // below it light is not divided by the albedo, and stays
constexpr float kLeastNormal = 0.5f;    // of a mean normal: below it a pixel shows too much at once
constexpr float kNormalPower = 64.0f;
constexpr float kTolerance = 4.0f;  // of luminance, in standard errors

// What tells pixels of one piece of surface from others.
struct Guides {
  int width, height;
  std::vector<Vec3f> normal, position;  // unit normals; 0 where a pixel is left alone
  std::vector<float> footprint;         // metres that a pixel is wide there
};

template <class Body>
void forEachRow(int height, const Body& body) {
  tbb::parallel_for(tbb::blocked_range<int>(0, height), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y != rows.end(); ++y) body(y);
  });
}

// The nearest of the four neighbours: across an edge they are far.
float footprintAt(const Guides& guides, int x, int y) {
  const std::size_t at = static_cast<std::size_t>(y) * guides.width + x;
  float nearest = std::numeric_limits<float>::max();
  const auto look = [&](bool inside, std::size_t other) {
    if (inside && lengthSquared(guides.normal[other]) > 0.0f)
      nearest = std::min(nearest, (guides.position[other] - guides.position[at]).length());
  };
  look(x + 1 < guides.width, at + 1);
  look(x > 0, at - 1);
  look(y + 1 < guides.height, at + guides.width);
  look(y > 0, at - guides.width);
  return nearest;
}

// Takes normals and positions out of the layers.
Guides guidesOf(Layers& layers) {
  Guides guides{layers.width, layers.height, std::move(layers.normal), std::move(layers.position),
                std::vector<float>(layers.albedo.size())};
  for (std::size_t i = 0; i < guides.normal.size(); ++i) {
    Vec3f& normal = guides.normal[i];
    const bool clear = luminance(layers.albedo[i]) >= kLeastAlbedo && normal.length() >= kLeastNormal;
    normal = clear ? normalized(normal) : Vec3f(0.0f);
  }
  forEachRow(layers.height, [&](int y) {
    for (int x = 0; x < layers.width; ++x)
      guides.footprint[static_cast<std::size_t>(y) * layers.width + x] = footprintAt(guides, x, y);
  });
  return guides;
}

// About exp(-x) for x >= 0, and 0 from 16 on.
float falloff(float x) {
  float base = std::max(0.0f, 1.0f - x * (1.0f / 16.0f));
  for (int k = 0; k < 4; ++k) base *= base;
  return base;
}

// How far two pixels, `apart` pixels from each other, show the same smooth piece of surface: 0..1. The sixty
// fourth power of the cosine, but for its last digits, times the fall-off by distance from the plane.
float alike(const Guides& guides, std::size_t a, std::size_t b, float apart) {
  const float cosine = guides.normal[a].dot(guides.normal[b]);
  if (cosine <= 0.5f) return 0.0f;
  const float off = std::abs(guides.normal[a].dot(guides.position[b] - guides.position[a]));
  return falloff(kNormalPower * (1.0f - cosine) + off / std::max(guides.footprint[a] * apart, 1e-12f));
}

// Light and the variance of its luminance, pixel by pixel.
struct Estimate {
  std::vector<Vec3f> value;
  std::vector<float> variance;
};

// What the light on a pixel is multiplied by to be its radiance.
Vec3f divisorOf(const Vec3f& albedo) {
  return Vec3f(std::max(albedo[0], kLeastAlbedo), std::max(albedo[1], kLeastAlbedo),
               std::max(albedo[2], kLeastAlbedo));
}

// 0 where a pixel is left alone.
Estimate withoutAlbedo(MattLight matt, const std::vector<Vec3f>& albedo, const Guides& guides) {
  Estimate light{std::move(matt.radiance), std::move(matt.deviation)};
  for (std::size_t i = 0; i < light.value.size(); ++i) {
    if (!(lengthSquared(guides.normal[i]) > 0.0f)) {
      light.value[i] = Vec3f(0.0f);
      light.variance[i] = 0.0f;
      continue;
    }
    light.value[i] /= divisorOf(albedo[i]);
    const float deviation = light.variance[i] / luminance(albedo[i]);
    light.variance[i] = deviation * deviation;
  }
  return light;
}

// Means of the estimated variance over the neighbourhood.
std::vector<float> steadied(const std::vector<float>& variance, const Guides& guides) {
  std::vector<float> result(variance.size(), 0.0f);
  forEachRow(guides.height, [&](int y) {
    for (int x = 0; x < guides.width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * guides.width + x;
      float sum = 0.0f, weights = 0.0f;
      for (int v = std::max(0, y - kErrorRadius); v <= std::min(guides.height - 1, y + kErrorRadius); ++v)
        for (int u = std::max(0, x - kErrorRadius); u <= std::min(guides.width - 1, x + kErrorRadius); ++u) {
          const std::size_t other = static_cast<std::size_t>(v) * guides.width + u;
          const float weight = std::max(0.0f, guides.normal[at].dot(guides.normal[other]));
          sum += weight * variance[other];
          weights += weight;
        }
      if (weights > 0.0f) result[at] = sum / weights;
    }
  });
  return result;
}

constexpr int kLights = 2;
using Lights = std::array<Estimate, kLights>;

// Sums of one light over the pixels around one.
struct Mean {
  Vec3f sum{0.0f};
  float weights = 0.0f, variance = 0.0f;
  float bright = 0.0f, scale = 0.0f;  // of the pixel in the middle; 1 / how far others may be from it
};

// One level of the wavelet: pixels `step` apart.
Lights averaged(const Lights& lights, const Guides& guides, int step) {
  Lights result = lights;
  forEachRow(guides.height, [&](int y) {
    for (int x = 0; x < guides.width; ++x) {
      const std::size_t at = static_cast<std::size_t>(y) * guides.width + x;
      std::array<Mean, kLights> means;
      bool noisy = false;
      for (int k = 0; k < kLights; ++k) {
        const float variance = lights[k].variance[at];
        if (!(variance > 0.0f)) continue;
        noisy = true;
        means[k].bright = luminance(lights[k].value[at]);
        means[k].scale = 1.0f / (kTolerance * std::sqrt(variance));
      }
      if (!noisy) continue;
      for (int v = -2; v <= 2; ++v)
        for (int u = -2; u <= 2; ++u) {
          const int column = x + u * step, row = y + v * step;
          if (column < 0 || column >= guides.width || row < 0 || row >= guides.height) continue;
          const std::size_t other = static_cast<std::size_t>(row) * guides.width + column;
          const auto apart = static_cast<float>(step * std::max(std::abs(u), std::abs(v)));
          const float near = kSpline[std::abs(u)] * kSpline[std::abs(v)] *
                             (apart > 0.0f ? alike(guides, at, other, apart) : 1.0f);
          if (!(near > 0.0f)) continue;
          for (int k = 0; k < kLights; ++k) {
            Mean& mean = means[k];
            if (!(mean.scale > 0.0f)) continue;
            const Vec3f& value = lights[k].value[other];
            const float weight = near * falloff(std::abs(luminance(value) - mean.bright) * mean.scale);
            mean.sum += value * weight;
            mean.variance += lights[k].variance[other] * weight * weight;
            mean.weights += weight;
          }
        }
      for (int k = 0; k < kLights; ++k) {
        if (!(means[k].weights > 0.0f)) continue;
        result[k].value[at] = means[k].sum / means[k].weights;
        result[k].variance[at] = means[k].variance / (means[k].weights * means[k].weights);
      }
    }
  });
  return result;
}

}  // namespace

std::vector<Vec3f> smoothedRadiance(Layers layers) {
  const Guides guides = guidesOf(layers);
  std::vector<Vec3f> result = std::move(layers.radiance);
  Lights lights{withoutAlbedo(std::move(layers.sun), layers.albedo, guides),
                withoutAlbedo(std::move(layers.rest), layers.albedo, guides)};
  const auto add = [&](float sign) {
    for (const Estimate& light : lights)
      for (std::size_t i = 0; i < result.size(); ++i)
        result[i] += light.value[i] * divisorOf(layers.albedo[i]) * sign;
  };
  add(-1.0f);
  for (Estimate& light : lights) light.variance = steadied(light.variance, guides);
  for (int level = 0; level < kLevels; ++level) lights = averaged(lights, guides, 1 << level);
  add(1.0f);
  return result;
}

}  // namespace fluidtex::render
