// Further maps of an exemplar (height, roughness, its colours in another resolution): numbers that lie over
// the same picture, looked up by the exemplar coordinates that synthesis has found. They can be applied to
// any surface that has those, whenever.
#pragma once

#include "texture/exemplar/load_map.h"

#include <string>
#include <vector>

namespace fluidtex::texture {

// Fills surface.maps under these names, whatever the map's size: where a vertex still shows its former place
// too, with both, mixed by what is left of it. Throws std::invalid_argument if the map is empty or the
// surface does not know the size of its exemplar.
void lookUpMap(const std::string& name, const Image& map, bool toroidal, TexturedSurface& surface);

// What the map holds: lookUpMap() or, of vectors, lookUpVectors() (texture/shown/vector_maps.h).
void lookUp(const std::string& name, const ExemplarMap& map, bool toroidal, TexturedSurface& surface);

// Looks surface.color up anew, in colours of any size. Throws as lookUpMap().
void lookUpColor(const Image& color, bool toroidal, TexturedSurface& surface);

}  // namespace fluidtex::texture
