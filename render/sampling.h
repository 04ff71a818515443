// Sample points, and warps from the unit square to the domains of integration.
//
// The points of a pixel are a stretch of an Owen-scrambled Sobol sequence whose index follows a Z-order curve
// through the picture: points of neighbouring pixels are stratified together, so that the remaining error is
// blue noise. There is no state: a point depends on pixel, sample, dimension and frame only.
#pragma once

#include "render/vec.h"

#include <cstdint>

namespace fluidtex::render {

// A 32-bit hash of two numbers.
std::uint32_t hash(std::uint32_t a, std::uint32_t b);

// Sample points of one pixel.
class PixelSamples {
 public:
  // samples: number of points the pixel will take, >= 1. Powers of two are distributed best.
  PixelSamples(int x, int y, int samples, std::uint32_t frame);

  // Point `sample` of the 2D dimension `dimension`, in [0,1) x [0,1). Points of different dimensions are
  // independent.
  Vec2f point(int sample, int dimension) const;

 private:
  std::uint32_t m_base;  // of the pixel's stretch of the sequence
  std::uint32_t m_seed;
};

// Offset from the pixel's centre under a tent filter of radius `radius`, pixels.
Vec2f tentOffset(const Vec2f& u, float radius);

// Uniform on the unit disc; continuous.
Vec2f uniformDisc(const Vec2f& u);

// Cosine-weighted unit vector around +z, pdf cos / pi.
Vec3f cosineHemisphere(const Vec2f& u);

// Uniform unit vector around +z in the cap z >= cosMax, of solid angle 2 pi (1 - cosMax).
Vec3f uniformCone(const Vec2f& u, float cosMax);

}  // namespace fluidtex::render
