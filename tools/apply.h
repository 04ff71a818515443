// Further maps on the surfaces of a finished run: what `fluidtex apply` does.
#pragma once

#include "texture/options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace fluidtex::tools {

struct ApplyWishes {
  std::filesystem::path out;              // the run's folder
  std::vector<texture::MapOptions> maps;  // `color` stands for the colours
  std::filesystem::path exemplar;         // empty: the run's own
};

// Looks the maps up at every vertex of every surface of the run, and writes the surfaces anew with them;
// nothing is synthesized. Throws UsageError where the folder holds no run, or a name cannot be that of a map,
// and ExemplarError where an image cannot be read; then nothing has changed.
void applyMaps(const ApplyWishes& wishes);

// "NAME=FILE", "NAME:normals=FILE" or "NAME:directions=FILE". Throws UsageError where it is something else.
texture::MapOptions parseMap(const std::string& text);

}  // namespace fluidtex::tools
