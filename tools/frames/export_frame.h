// The files of a run in other formats than PLY, made from its PLYs and their spacing alone, so that they have
// the same bytes whenever that is done.
#pragma once

#include "texture/exemplar/image.h"
#include "tools/formats/exports.h"
#include "tools/run_folder/report.h"

#include <optional>

namespace fluidtex::tools {

// How exports show the surface, by the scene of run.json (all keys resolved). color: the exemplar, linear
// RGBA. Throws UsageError if a key has a value of another type.
Appearance appearanceOf(const Json& scene, const texture::Image& color);

// Writes OUT/exemplar.png, and OUT/between.png of a picture that is looked up in its place, unless they are
// there. betweenFile: that picture; empty: none.
void writePictures(const std::filesystem::path& out, const texture::Image& color,
                   const std::filesystem::path& betweenFile);

// Writes the files of a frame of OUT into another folder, where they are named as in OUT. spacing: see
// exportFrame(). Throws as exportFrame().
void writeFrameExports(const std::filesystem::path& out, int frame, const Exports& exports,
                       const texture::Image& color, const std::filesystem::path& to,
                       std::optional<double> spacing = {});

// Writes a frame's files, brings the files up to date that list the sequence, and adds the frame's to the
// journal if there is one. spacing: the frame's, metres; without it, that of run.json, which must have the
// frame. Throws UsageError where the PLY is no surface of a run, std::system_error of the disk.
void exportFrame(const std::filesystem::path& out, int frame, const Exports& exports,
                 const texture::Image& color, std::optional<double> spacing = {});

}  // namespace fluidtex::tools
