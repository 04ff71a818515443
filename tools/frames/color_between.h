// Colours between the points of the surface, for a scene's pictures.
#pragma once

#include "render/render.h"
#include "scenes/scene.h"
#include "texture/shown/color_between.h"

#include <filesystem>
#include <optional>

namespace fluidtex::tools {

// findJoints() of the surface; none where colours are not looked up at exemplar coordinates.
texture::Joints jointsOf(const texture::Options& options, const texture::TexturedSurface& surface);

// The picture to look up, read from its file. Nothing if the points' colours are interpolated: because the
// scene says so, or because its colours are not looked up at exemplar coordinates. Throws ExemplarError if it
// cannot be read or has not the exemplar's aspect ratio.
std::optional<texture::Detail> detailOf(const texture::Options& options);

// The same of an exemplar that moves, as a frame of the run in `out` shows it. Throws as detailOf().
texture::Detail detailOfFrame(const std::filesystem::path& out, int frame, bool toroidal);

// Look-up of `detail` on `surface`, whose joints these are; empty without `detail`. All must outlive the
// result.
render::ColorBetween colorBetween(const std::optional<texture::Detail>& detail,
                                  const texture::TexturedSurface& surface, const texture::Joints& joints);

// What is in view in a frame of a scene; colours between the points as colorBetween().
render::View viewOfFrame(const scenes::Scene& scene, int frame, const std::optional<texture::Detail>& detail,
                         const texture::TexturedSurface& surface, const texture::Joints& joints);

}  // namespace fluidtex::tools
