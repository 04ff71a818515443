#include "tools/joints/ways.h"

#include "texture/exemplar/srgb.h"
#include "texture/exemplar/texel_place.h"
#include "texture/shown/shown_color.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::joints {
namespace {

using texture::Reading;
using texture::Vec2f;
using texture::Vec3f;
using texture::Vec4f;

Vec4f pointsColor(const texture::TexturedSurface& surface, const Place& place) {
  const texture::Vec3I& corner = surface.triangles[place.triangle];
  Vec4f sum(0.0f);  // premultiplied
  for (int k = 0; k < 3; ++k) {
    const Vec4f& color = surface.color[corner[k]];
    const float weight = place.weights[k] * color[3];
    sum += Vec4f(color[0] * weight, color[1] * weight, color[2] * weight, weight);
  }
  return texture::straight(sum);
}

Reading mixedWithEqualPower(const std::array<Reading, 3>& readings, const Vec3f& weights) {
  Reading sum;
  float deviation = 0.0f, least = 1.0f, most = 0.0f;
  for (int label = 0; label < 3; ++label) {
    const Reading& one = readings[std::size_t(label)];
    const float lightness = texture::encodeSrgb(texture::luminance(one.color.asPointer()));
    sum.color += one.color * weights[label];
    sum.mean += one.mean * weights[label];
    deviation += (lightness - one.mean) * weights[label];
    least = std::min(least, lightness), most = std::max(most, lightness);
  }
  const float lightness = std::clamp(sum.mean + deviation / weights.length(), least, most);
  const float proportional = texture::luminance(sum.color.asPointer());
  if (proportional > 0.0f) {
    const float factor = texture::decodeSrgb(lightness) / proportional;
    for (int k = 0; k < 3; ++k) sum.color[k] *= factor;
  }
  return sum;
}

Vec4f equalPower(const texture::Detail& detail, const texture::TexturedSurface& surface,
                 const texture::Joint& joint, const Vec3f& weights) {
  const texture::TexelToImage toPicture(surface, detail.color);
  const auto mixed = [&](const texture::CornerPlaces& places) {
    std::array<Reading, 3> readings;
    for (std::size_t label = 0; label < 3; ++label) {
      const std::array<Vec2f, 3>& at = places[label];
      const Vec2f texel = at[0] * weights[0] + at[1] * weights[1] + at[2] * weights[2];
      readings[label] =
          texture::readAt(detail.color, detail.around, detail.toroidal, toPicture(texel), detail.halvings);
    }
    return mixedWithEqualPower(readings, weights);
  };
  float left = 0.0f;
  for (int k = 0; k < 3; ++k)
    left += weights[k] * texture::leftOf(surface.fading, surface.triangles[joint.triangle][k]);
  const Reading now = mixed(joint.shown);
  return left == 0.0f ? texture::straight(now.color) : texture::faded(now, mixed(joint.former), left);
}

}  // namespace

std::vector<Way> waysToDraw(const texture::Detail& detail, const texture::TexturedSurface& surface,
                            const texture::Joints& joints, const texture::CutSurface& cut,
                            const texture::Joints& cutJoints) {
  const auto proportional = [&](const Place& place) {
    return texture::colorBetween(detail, surface, joints, place.triangle, place.weights).value();
  };
  return {
      {"the points' colours, interpolated", [&](const Place& place) { return pointsColor(surface, place); }},
      {"three look-ups, in proportion", proportional},
      {"three look-ups, with equal power",
       [&, proportional](const Place& place) {
         const texture::Joint* joint = texture::jointIn(joints, place.triangle);
         return joint ? equalPower(detail, surface, *joint, place.weights) : proportional(place);
       }},
      {"one, the surface cut along the joints",
       [&](const Place& place) {
         return texture::colorBetween(detail, cut.surface, cutJoints, place.cutTriangle, place.cutWeights)
             .value();
       }},
  };
}

}  // namespace fluidtex::joints
