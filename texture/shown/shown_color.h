// What a vertex shows: the exemplar at its coordinate, and while it fades, at its former one.
#pragma once

#include "texture/exemplar/exemplar.h"

namespace fluidtex::texture {

// Of the picture in which means are taken: over 8 x 8 texels.
inline constexpr int kMeanHalvings = 3;

// The mean lightness (sRGB's curve of luminance) around each texel of linear RGBA with straight alpha: one
// channel, premultiplied, reduced by s = 2^halvings. Texel x of the colours lies at (x - (s - 1) / 2) / s of
// it.
Image lightnessAround(const Image& color, bool toroidal, int halvings = kMeanHalvings);

// Linear RGBA, straight alpha; around: lightnessAround(color, toroidal, halvings). `weight`, 0..1, is what is
// left of the former place. The colour lies between those of both places, where it is as bright as this: the
// means around both are mixed by the weight; what differs from the mean is mixed with equal power, cos and
// sin of a quarter turn, and held between the two. The sum of two pictures that have nothing to do with each
// other has the contrast of each instead of 0.7 of it half-way. (Mixing each channel so would make colours
// that neither picture has.) Lightness is mixed, not light: a tenth of the light of a bright place is a third
// of the way to it for the eye, and would come within one frame.
Vec4f shownColor(const Image& color, const Image& around, bool toroidal, const Vec2f& present,
                 const Vec2f& former, float weight, int halvings = kMeanHalvings);

}  // namespace fluidtex::texture
