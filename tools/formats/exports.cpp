#include "tools/formats/exports.h"

#include "render/frame_name.h"
#include "tools/base/atomic_file.h"
#include "tools/formats/glb.h"
#include "tools/formats/obj.h"
#include "tools/formats/usda.h"
#include "tools/formats/vtp.h"

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <functional>
#include <optional>
#include <system_error>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

void write(Format format, const ExportMesh& mesh, const Appearance& appearance, std::ostream& out) {
  switch (format) {
    case Format::ply:
      break;
    case Format::glb:
      return writeGlb(mesh, appearance, out);
    case Format::obj:
      return writeObj(mesh, appearance, out);
    case Format::usda:
      return writeUsda(mesh, appearance, out);
    case Format::vtp:
      return writeVtp(mesh, out);
  }
}

void writeAtomicallyTo(const fs::path& file, const std::function<void(std::ostream&)>& writeTo) {
  writeAtomically(file, [&](const fs::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    writeTo(out);
    out.close();
    if (!out) throw std::system_error(errno, std::generic_category(), temporary.string() + ": cannot write");
  });
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
    if (format == Format::obj) {
      const fs::path materials = file.parent_path() / objMaterials(appearance, frame);
      if (!fs::exists(materials)) writeTextAtomically(materials, mtlOf(appearance));
    }
    writeAtomicallyTo(file, [&](std::ostream& to) { write(format, *mesh, appearance, to); });
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
    frames.reserve(files.size());
    for (const Listed& file : files) frames.push_back(file.frame);
    // A frame without surface has none of the values.
    const int fullest = std::max_element(files.begin(), files.end(), [](const Listed& a, const Listed& b) {
                          return a.bytes < b.bytes;
                        })->frame;
    writeAtomicallyTo(out / (appearance.name + names.sequence), [&](std::ostream& to) {
      if (format == Format::usda)
        writeUsdStage(frames, fullest, appearance.frameRate, to);
      else
        to << pvdOf(frames, appearance.frameRate);
    });
  }
}

}  // namespace fluidtex::tools
