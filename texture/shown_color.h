// What a vertex shows: the exemplar at its coordinate, and while it fades, at its former one.
#pragma once

#include "texture/exemplar.h"

namespace fluidtex::texture {

// The mean colour around each texel: the exemplar's colour, premultiplied, reduced by 2^3. Texel x of the exemplar lies at
// (x - 3.5) / 8 of it.
Image meansAround(const Exemplar& exemplar);

// Linear RGBA, straight alpha. `weight`, 0..1, is what is left of the former place. The means around both places
// are mixed by it; what differs from the mean is mixed with equal power, cos and sin of a quarter turn, and held
// between the two: the sum of two pictures that have nothing to do with each other has the contrast of each
// instead of 0.7 of it half-way.
Vec4f shownColor(const Exemplar& exemplar, const Image& around, const Vec2f& present, const Vec2f& former,
                 float weight);

}  // namespace fluidtex::texture
