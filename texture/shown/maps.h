// Further maps of an exemplar (height, roughness, colours in another resolution), looked up by exemplar
// coordinates. Applicable to any surface that has these, at any time.
#pragma once

#include "texture/exemplar/load_map.h"

#include <string>
#include <vector>

namespace fluidtex::texture {

// Fills surface.maps from a map of any size, 1 or 3 channels, one entry a channel (mapNames()); in a
// cross-fade, former and present values are mixed linearly. Throws std::invalid_argument if the map is empty
// or has another number of channels, or the surface does not know the size of its exemplar.
void lookUpMap(const std::string& name, const Image& map, bool toroidal, TexturedSurface& surface);

// lookUpMap(), or for vectors lookUpVectors() (texture/shown/vector_maps.h).
void lookUp(const std::string& name, const ExemplarMap& map, bool toroidal, TexturedSurface& surface);

// Looks surface.color up again, in a linear RGBA image of any size. Throws std::invalid_argument if the image
// is empty or not RGBA, or the surface does not know the size of its exemplar.
void lookUpColor(const Image& color, bool toroidal, TexturedSurface& surface);

}  // namespace fluidtex::texture
