#include "texture/shown/rest_positions.h"

#include "texture/labels/fresh.h"
#include "texture/loops/parallel.h"
#include "texture/shown/plain.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

// Position in an exemplar that is repeated, mirrored where its edges do not meet.
float repeated(float x, int size, bool toroidal) {
  if (toroidal) return x;
  const float period = 2.0f * float(size), inside = x - period * std::floor(x / period);
  return inside < float(size) ? inside : period - 1.0f - inside;
}

// Linear, premultiplied.
Vec4f projected(const Image& color, bool toroidal, const Vec3f& rest, const Vec3f& normal, float spacing) {
  Vec4f sum(0.0f);
  float weights = 0.0f;
  for (int axis = 0; axis < 3; ++axis) {
    const float weight = std::pow(std::abs(normal[axis]), 4.0f);
    if (!(weight > 1e-4f)) continue;
    // Rows run along x, or along y where x is the axis; the other direction is up in the picture.
    const int along = axis == 0 ? 1 : 0, up = axis == 2 ? 1 : 2;
    const Vec2f texel(repeated(rest[along] / spacing, color.width, toroidal),
                      repeated(-rest[up] / spacing, color.height, toroidal));
    sum += samplePremultiplied(color, toroidal, texel) * weight;
    weights += weight;
  }
  return weights > 0.0f ? sum / weights : sum;
}

// Weight of a rest whose age is `age` frames, of a life of 2 `every`.
float weightOf(int age, int every) {
  return 1.0f - std::abs(float(age) / float(every) - 1.0f);
}

}  // namespace

TexturedSurface restTextured(Surface surface, const Carried& carried, const Image& color,
                             const RestOptions& options, int frame, double secondsSinceLast) {
  TexturedSurface result = untextured(std::move(surface), carried);
  const std::size_t count = result.positions.size();
  // The second begins half a life later, at an age of `every`, with all the weight.
  const int life = 2 * options.every, firstAge = options.every > 0 ? (frame - 1) % life : 0,
            secondAge = options.every > 0 ? (frame - 1 + options.every) % life : 0;
  const bool dual = options.every > 0;
  result.rest = result.positions;
  if (dual) result.secondRest = result.positions;
  const bool goesOn = carried.rest.size() == count;
  const float second = dual ? weightOf(secondAge, options.every) : 0.0f;
  forEachIndex(count, [&](std::uint32_t v) {
    const bool known = goesOn && carried.trust[v] >= kLowTrust;
    if (known && (!dual || firstAge != 0)) result.rest[v] = carried.rest[v];
    if (known && dual && secondAge != 0) result.secondRest[v] = carried.secondRest[v];
    if (known) result.age[v] = carried.age[v] + float(secondsSinceLast);
    const Vec3f& normal = result.normals[v];
    const auto spacing = float(result.spacing);
    Vec4f shown = projected(color, options.toroidal, result.rest[v], normal, spacing);
    if (dual)
      shown = shown * (1.0f - second) +
              projected(color, options.toroidal, result.secondRest[v], normal, spacing) * second;
    result.color[v] = straight(shown);
  });
  result.exemplarWidth = color.width;
  result.exemplarHeight = color.height;
  return result;
}

}  // namespace fluidtex::texture
