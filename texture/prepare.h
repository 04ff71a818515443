// Surface preparation [Kwatra07 sec. IV]: points spread evenly over a level set, connected as one manifold mesh.
#pragma once

#include "texture/options.h"
#include "texture/surface.h"

#include <openvdb/openvdb.h>

namespace fluidtex::texture {

// The spacing at which the zero set of phi carries `points` points: sqrt(area / points), metres. 0 if there is no surface.
double spacingForPoints(const openvdb::FloatGrid& phi, int points);

// Spreads points over the zero set of phi (narrow band, metres, negative inside), one per spacing^2 of area, by repulsion
// restricted to the surface [Turk91], and connects them into a closed, oriented manifold mesh with the topology of phi's own
// iso-surface [Turk92, mutual tessellation]. Level L of the hierarchy has spacing 2^L * spacing.
// `seeds`: points to start from (the last frame's, moved with the flow; they need not lie on the surface exactly); empty, or
// Points::random: drawn at random by area, keyed by voxel, so that a liquid at rest gets the same points on every frame.
// `levels` meshes are made: options.levels for a first frame, 1 after it.
// Same input, same bytes, on any number of threads. No surface: an empty result.
// Throws std::invalid_argument if spacing <= 0 or phi holds a value that is not finite.
Surface prepareSurface(const openvdb::FloatGrid& phi, double spacing, const std::vector<Vec3f>& seeds, int levels,
                       const SurfaceOptions& options);

}  // namespace fluidtex::texture
