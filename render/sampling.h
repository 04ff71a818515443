// Sample points and the maps from the unit square to the domains that are integrated over.
//
// The points of a pixel are a stretch of an Owen-scrambled Sobol sequence whose index runs along a Z-order
// curve through the picture: neighbouring pixels get points that complete each other, so that what error is
// left looks like fine grain. Nothing is kept between calls: a point follows from pixel, sample, dimension
// and frame alone.
#pragma once

#include "render/vec.h"

#include <cstdint>

namespace fluidtex::render {

// A well mixed 32-bit hash of two numbers.
std::uint32_t hash(std::uint32_t a, std::uint32_t b);

// All random numbers of one pixel.
class PixelSamples {
 public:
  // `samples`: how many points the pixel will take, >= 1. Powers of two are spread best.
  PixelSamples(int x, int y, int samples, std::uint32_t frame);

  // Point `sample` of the 2D dimension `dimension`, in [0,1) x [0,1). Points of different dimensions are
  // independent.
  Vec2f point(int sample, int dimension) const;

 private:
  std::uint32_t m_base;  // of the pixel's stretch of the sequence
  std::uint32_t m_seed;
};

// Offset from the pixel's centre under a tent filter that reaches `radius` pixels: density falls linearly to
// zero there.
Vec2f tentOffset(const Vec2f& u, float radius);

// Even over the unit disc; points that are close in the square stay close in the disc.
Vec2f uniformDisc(const Vec2f& u);

// Unit vector around +z with density cos / pi.
Vec3f cosineHemisphere(const Vec2f& u);

// Unit vector around +z, even over the cap where z >= cosMax. Solid angle: 2 pi (1 - cosMax).
Vec3f uniformCone(const Vec2f& u, float cosMax);

}  // namespace fluidtex::render
