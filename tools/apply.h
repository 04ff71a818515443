// fluidtex apply: further maps on the surfaces of a finished run.
#pragma once

#include "texture/options.h"

#include <filesystem>
#include <string>
#include <vector>

namespace fluidtex::tools {

struct ApplyWishes {
  std::filesystem::path out;              // the run's folder
  std::vector<texture::MapOptions> maps;  // `color` replaces the colours
  std::filesystem::path exemplar;         // empty: the run's own
};

// Looks the maps up at every vertex of the run's surfaces and rewrites the surfaces with them, without
// synthesis. Throws UsageError if the folder holds no run or a name is not valid for a map, ExemplarError if
// an image cannot be read; then nothing has changed.
void applyMaps(const ApplyWishes& wishes);

// Parses "NAME=FILE", "NAME:normals=FILE" or "NAME:directions=FILE". Throws UsageError for anything else.
texture::MapOptions parseMap(const std::string& text);

// Throws UsageError if no vertex property can have this name, or vertices have one of it anyway.
void checkMapName(const std::string& name);

}  // namespace fluidtex::tools
