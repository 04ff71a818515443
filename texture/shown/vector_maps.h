// Maps of an exemplar that hold vectors: they stand in the axes of the picture, and lie on the surface as the
// texture does, so that they turn and are drawn out with it.
#pragma once

#include "texture/exemplar/exemplar.h"
#include "texture/map_names.h"

namespace fluidtex::texture {

// Fills surface.vectors[name] with unit vectors in space. A pixel holds x to the right, y upwards and z out
// of the picture, each as (c + 1) / 2; with the gradient G of the exemplar coordinate q,
//  - normals are those of a relief whose heights the flow leaves as they are: N + (x / z) G_s spacingAt -
//    (y / z) G_t spacingAt, N being the surface's normal, so that drawn-out bumps become flatter; z is taken
//    as 0.05 at least;
//  - directions are carried by the map itself: the tangent d with G d = (x, -y), as long as (x, y), and z N;
//    zero where less than 0.02 is left, as eight bits cannot write 0.
// Where a vertex still shows its former place too, both are mixed by what is left of it. Needs gradient,
// normals and spacing; entries of surface.maps under the names that a PLY gives the parts are taken out.
// Throws std::invalid_argument if the map has not three channels, holds values, or the surface does not know
// the size of its exemplar.
void lookUpVectors(const std::string& name, const ExemplarMap& map, bool toroidal, TexturedSurface& surface);

// Fills surface.gradient and that of what fades from the coordinates themselves, for surfaces that come from
// a file (texture/labels/coordinate_gradient.h). Where no neighbours agree on one, it is the unstretched one
// along the orientation. Needs spacing and orientation; throws std::invalid_argument if the mesh is not
// closed.
void recoverGradients(bool toroidal, TexturedSurface& surface);

}  // namespace fluidtex::texture
