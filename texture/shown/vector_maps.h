// Vector maps of an exemplar: given in the axes of the picture, they rotate and stretch with the texture.
#pragma once

#include "texture/exemplar/exemplar.h"
#include "texture/map_names.h"

namespace fluidtex::texture {

// Fills surface.vectors[name] with unit vectors in world space. A pixel holds x to the right, y upwards and z
// out of the picture, each as (c + 1) / 2. With G the gradient of the exemplar coordinate:
//  - normals are those of a relief whose heights the flow preserves: N + (x / z) G_s spacingAt - (y / z) G_t
//    spacingAt, N the surface's normal, so that stretched bumps become flatter; z is taken as 0.05 at least;
//  - directions are advected as lines: the tangent d with G d = (x, -y), as long as (x, y), plus z N; zero
//    where less than 0.02 is left, as eight bits cannot represent 0.
// In a cross-fade, former and present vectors are mixed linearly and normalised. Requires gradient, normals
// and spacing. Removes entries of surface.maps under the names that a PLY gives the components. Throws
// std::invalid_argument if the map has not three channels, holds values, or the surface does not know the
// size of its exemplar.
void lookUpVectors(const std::string& name, const ExemplarMap& map, bool toroidal, TexturedSurface& surface);

// Estimates surface.gradient, and that of the cross-fade, from the coordinates, for surfaces read from files
// (texture/labels/coordinate_gradient.h). Where neighbours do not agree on one, it is the unstretched
// gradient along the orientation. Requires spacing and orientation. Throws std::invalid_argument if the mesh
// is not closed.
void recoverGradients(bool toroidal, TexturedSurface& surface);

}  // namespace fluidtex::texture
