// Ways to draw triangles whose corners show different pieces of texture: the program's own, and those that it
// is judged beside.
#pragma once

#include "texture/joints/cut.h"
#include "texture/shown/color_between.h"

#include <functional>
#include <string>
#include <vector>

namespace fluidtex::joints {

// A point of a surface, in one of its triangles and in one of the surface cut along its joints.
struct Place {
  std::uint32_t triangle = 0, cutTriangle = 0;
  texture::Vec3f weights{0.0f}, cutWeights{0.0f};  // barycentric
};

struct Way {
  std::string name;
  std::function<texture::Vec4f(const Place&)> color;  // linear RGBA, straight alpha
};

// 1. the points' colours, interpolated;
// 2. three look-ups, in proportion to the barycentric weights: texture::colorBetween();
// 3. three look-ups, with equal power: their local means (texture::Reading) in proportion, deviations from
//    these by the weights over the root of the sum of their squares, so that unrelated texture keeps its
//    contrast; clamped to between the look-ups' lightnesses; hue and saturation as in 2;
// 4. one look-up, the surface cut along the joints.
// Outside of joints 2 to 4 are the same. What fades is mixed by the program's law in all of them. The
// arguments must outlive the result; each joints are findJoints() of the surface before.
std::vector<Way> waysToDraw(const texture::Detail& detail, const texture::TexturedSurface& surface,
                            const texture::Joints& joints, const texture::CutSurface& cut,
                            const texture::Joints& cutJoints);

}  // namespace fluidtex::joints
