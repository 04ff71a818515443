// What the pictures of a scene show between the points of the surface.
#pragma once

#include "render/render.h"
#include "texture/shown/color_between.h"

#include <optional>

namespace fluidtex::tools {

// The picture to look up, read from its file; nothing where points' colours are interpolated: because the
// scene wants so, or because its colours are not those of exemplar coordinates. Throws ExemplarError: it
// cannot be read, or has not the exemplar's shape.
std::optional<texture::Detail> detailOf(const texture::Options& options);

// Looks `detail` up on `surface`; empty without one. Both must outlive the result.
render::ColorBetween colorBetween(const std::optional<texture::Detail>& detail,
                                  const texture::TexturedSurface& surface);

}  // namespace fluidtex::tools
