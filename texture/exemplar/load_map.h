// Further maps of an exemplar, from files.
#pragma once

#include "texture/exemplar/exemplar.h"

#include <string>
#include <vector>

namespace fluidtex::texture {

// A map at the resolution of the vertices, one per exemplar pixel: halved until it is less than twice as wide
// as the exemplar.
Image vertexMap(Image map, int exemplarWidth, bool toroidal);

// Reads a map for the vertices; a grey image becomes one channel. Throws ExemplarError as readMap() does, and
// if vectors are expected of an image without three channels.
ExemplarMap loadMap(const MapOptions& options, int exemplarWidth, bool toroidal);

// Names of a map's channels: its own, or name_red, name_green and name_blue for three.
std::vector<std::string> mapNames(const std::string& name, int channels);

}  // namespace fluidtex::texture
