// Colour of a vertex: the exemplar at its coordinate, cross-faded with that at its former coordinate.
#pragma once

#include "texture/exemplar/exemplar.h"

namespace fluidtex::texture {

// Local means are taken over 8 x 8 texels.
inline constexpr int kMeanHalvings = 3;

// Mean lightness (sRGB curve of luminance) around each texel of linear RGBA with straight alpha: one channel,
// premultiplied, reduced by s = 2^halvings. Texel x of the colours lies at (x - (s - 1) / 2) / s.
Image lightnessAround(const Image& color, bool toroidal, int halvings = kMeanHalvings);

// A look-up.
struct Reading {
  Vec4f color{0.0f};  // premultiplied
  float mean = 0.0f;  // lightness around
};

Reading readAt(const Image& color, const Image& around, bool toroidal, const Vec2f& texel,
               int halvings = kMeanHalvings);

// Cross-faded colour, linear RGBA, straight alpha. around: lightnessAround(color, toroidal, halvings).
// weight, 0..1: of the former coordinate.
// The lightness is mixed first. Local means are mixed by the weight, deviations from them with equal power
// (cos and sin of a quarter turn), clamped to between the two: the plain mean of two unrelated pictures has
// 0.7 of their contrast half-way. The colour is the one of that lightness on the line between both colours;
// mixing each channel would make colours that neither picture has. Lightness, not light: a tenth of the light
// of a bright place is a third of the way to it for the eye, and would appear within one frame.
Vec4f shownColor(const Image& color, const Image& around, bool toroidal, const Vec2f& present,
                 const Vec2f& former, float weight, int halvings = kMeanHalvings);

// The same of two look-ups.
Vec4f faded(const Reading& now, const Reading& former, float weight);

}  // namespace fluidtex::texture
