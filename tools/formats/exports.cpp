#include "tools/formats/exports.h"

#include "render/frame_name.h"
#include "tools/base/atomic_file.h"
#include "tools/formats/glb.h"
#include "tools/formats/obj.h"
#include "tools/formats/usda.h"
#include "tools/formats/vtp.h"

#include <algorithm>
#include <optional>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

std::string textOf(Format format, const ExportMesh& mesh, const Appearance& appearance) {
  switch (format) {
    case Format::ply:
      break;
    case Format::glb:
      return glbOf(mesh, appearance);
    case Format::obj:
      return objOf(mesh);
    case Format::usda:
      return usdaOf(mesh, appearance);
    case Format::vtp:
      return vtpOf(mesh);
  }
  return {};
}

// A frame's file as it lies in the folder.
struct Listed {
  int frame;
  std::uintmax_t bytes;
};

std::vector<Listed> filesIn(const fs::path& folder, const char* extension) {
  std::vector<Listed> files;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing))
    if (entry.path().extension() == extension)
      if (const auto frame = render::frameNumber(entry.path().stem().string()))
        files.push_back({*frame, entry.file_size()});
  std::sort(files.begin(), files.end(), [](const Listed& a, const Listed& b) { return a.frame < b.frame; });
  return files;
}

}  // namespace

void writeExports(const texture::TexturedSurface& surface, int frame, double time, const Exports& exports,
                  const fs::path& out) {
  const Appearance& appearance = exports.appearance;
  std::optional<ExportMesh> cut, uncut;
  for (const Format format : exports.formats) {
    if (format == Format::ply) continue;
    const bool blends =
        exports.joints == JointsAs::blend && (format == Format::glb || format == Format::usda);
    std::optional<ExportMesh>& mesh = blends ? uncut : cut;
    if (!mesh)
      mesh = exportMesh(surface, !appearance.picture.empty(), appearance.toroidal,
                        blends ? JointsAs::blend : JointsAs::cut, frame, time);
    const fs::path file = out / frameFile(format, frame);
    if (format == Format::obj && !fs::exists(file.parent_path() / kObjMaterials))
      writeTextAtomically(file.parent_path() / kObjMaterials, mtlOf(appearance));
    writeTextAtomically(file, textOf(format, *mesh, appearance));
  }
}

void updateSequences(const Exports& exports, const fs::path& out) {
  const Appearance& appearance = exports.appearance;
  for (const Format format : exports.formats) {
    const FormatFiles& names = filesOf(format);
    if (names.sequence == nullptr) continue;
    const std::vector<Listed> files = filesIn(out / names.folder, names.extension);
    if (files.empty()) continue;
    std::vector<int> frames;
    for (const Listed& file : files) frames.push_back(file.frame);
    // A frame without surface has none of the values.
    const int fullest = std::max_element(files.begin(), files.end(), [](const Listed& a, const Listed& b) {
                          return a.bytes < b.bytes;
                        })->frame;
    const std::string text = format == Format::usda ? usdStageOf(frames, fullest, appearance.frameRate)
                                                    : pvdOf(frames, appearance.frameRate);
    writeTextAtomically(out / (appearance.name + names.sequence), text);
  }
}

}  // namespace fluidtex::tools
