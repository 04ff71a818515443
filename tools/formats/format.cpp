#include "tools/formats/format.h"

#include "render/frame_name.h"
#include "tools/base/errors.h"

#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <set>

namespace fluidtex::tools {

std::string frameFile(Format format, int frame) {
  const FormatFiles& files = filesOf(format);
  return std::string(files.folder) + "/" + render::frameName(frame) + files.extension;
}

std::vector<Format> parseFormats(const std::vector<std::string>& names) {
  std::set<Format> found{Format::ply};
  for (const std::string& name : names) {
    const auto* files = std::find_if(std::begin(kFormatFiles), std::end(kFormatFiles),
                                     [&](const FormatFiles& known) { return name == known.name; });
    if (files == std::end(kFormatFiles))
      throw UsageError(
          fmt::format("--format {}: is not known; give ply, glb, obj, usda or vtp, or several "
                      "with commas between them",
                      name));
    found.insert(static_cast<Format>(files - std::begin(kFormatFiles)));
  }
  return {found.begin(), found.end()};
}

}  // namespace fluidtex::tools
