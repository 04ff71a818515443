#include "tools/frames/export_frame.h"

#include "scenes/numbered_files.h"
#include "texture/exemplar/read_image.h"
#include "texture/shown/vector_maps.h"
#include "tools/base/atomic_file.h"
#include "tools/base/errors.h"
#include "tools/formats/exemplar_picture.h"
#include "tools/formats/read_ply.h"
#include "tools/run_folder/finished_run.h"
#include "tools/run_folder/journal.h"

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

// A value of the scene by its dotted place, or what is usual.
template <typename T>
T valueOf(const Json& scene, const char* pointer, const T& usual) {
  try {
    return scene.value(Json::json_pointer(pointer), usual);
  } catch (const Json::exception&) {
    throw UsageError(std::string("run.json: ") + pointer + " is not what a run has written");
  }
}

}  // namespace

Appearance appearanceOf(const Json& scene, const texture::Image& color) {
  const Appearance usual;
  Appearance appearance;
  appearance.name = valueOf(scene, "/name", usual.name);
  appearance.frameRate = valueOf(scene, "/frame_rate", usual.frameRate);
  const bool lookedUp = looksUp(valueOf<std::string>(scene, "/texture/method", ""),
                                valueOf<std::string>(scene, "/texture/later_frames", "synthesize"));
  // Vertices of one picture each have their colours.
  if (lookedUp && valueOf<std::string>(scene, "/texture/animation/by", "time") == "time")
    appearance.picture =
        valueOf<std::string>(scene, "/texture/between", "") == "file" ? kBetweenFile : kExemplarFile;
  appearance.moves = appearance.picture == kExemplarFile &&
                     scenes::isPattern(valueOf<std::string>(scene, "/texture/exemplar", ""));
  appearance.toroidal = valueOf(scene, "/texture/toroidal", false);
  appearance.seeThrough = isSeeThrough(color);
  appearance.gloss = valueOf(scene, "/render/gloss", usual.gloss);
  appearance.roughness = valueOf(scene, "/render/roughness", usual.roughness);
  return appearance;
}

void writePictures(const fs::path& out, const texture::Image& color, const fs::path& betweenFile) {
  const auto write = [&](const char* name, const texture::Image& picture) {
    if (!fs::exists(out / name)) writeTextAtomically(out / name, pngOf(picture));
  };
  write(kExemplarFile, color);
  if (!betweenFile.empty()) write(kBetweenFile, texture::readImage(betweenFile));
}

void writeFrameExports(const fs::path& out, int frame, const Exports& exports, const texture::Image& color,
                       const fs::path& to, std::optional<double> spacing) {
  const double time = (frame - 1) / exports.appearance.frameRate;
  texture::TexturedSurface surface = readPly(out / frameFile(Format::ply, frame), color.width, color.height);
  if (!surface.empty()) surface.spacing = spacing ? *spacing : spacingOf(out, surface, frame);
  if (lacksGradients(surface)) texture::recoverGradients(exports.appearance.toroidal, surface);
  Exports own = exports;
  if (own.appearance.moves) {
    own.appearance.picture = exemplarFile(frame);
    own.appearance.seeThrough = isSeeThrough(texture::readImage(out / own.appearance.picture));
  }
  writeExports(surface, frame, time, own, to);
}

void exportFrame(const fs::path& out, int frame, const Exports& exports, const texture::Image& color,
                 std::optional<double> spacing) {
  writeFrameExports(out, frame, exports, color, out, spacing);
  updateSequences(exports, out);
  if (!hasJournal(out)) return;
  std::vector<JournalLine> lines;
  for (const Format format : exports.formats)
    if (format != Format::ply)
      lines.push_back(lineOfFile(frameFile(format, frame), fingerprintOf(out / frameFile(format, frame))));
  addToJournal(out, lines);
}

}  // namespace fluidtex::tools
