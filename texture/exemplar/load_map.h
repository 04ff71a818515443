// Further maps of an exemplar as they come from files.
#pragma once

#include "texture/exemplar/exemplar.h"

#include <string>
#include <vector>

namespace fluidtex::texture {

// A map as it is looked up at vertices, which lie a pixel of the exemplar apart: reduced by halves until it
// is less than twice as wide as the exemplar.
Image vertexMap(Image map, int exemplarWidth, bool toroidal);

// Reads a map and makes it ready for vertices; values that are grey throughout become one channel. Throws
// ExemplarError as readMap() does, and where vectors are asked of an image without three channels.
ExemplarMap loadMap(const MapOptions& options, int exemplarWidth, bool toroidal);

// The names under which a map of so many channels is kept: its own, or name_red, name_green and name_blue for
// three.
std::vector<std::string> mapNames(const std::string& name, int channels);

}  // namespace fluidtex::texture
