// Surface preparation [Kwatra07 sec. IV]: points spread evenly over a level set, connected as one manifold
// mesh.
#pragma once

#include "texture/levelset/point_scale.h"
#include "texture/options.h"
#include "texture/surface.h"

#include <openvdb/openvdb.h>

namespace fluidtex::texture {

// The spacing at which the zero set of phi carries `points` points: sqrt(area / points), metres, where
// `scale` is not given. 0 if there is no surface.
double spacingForPoints(const openvdb::FloatGrid& phi, int points, const PointScale& scale = {});

// What a frame starts from: the last frame's points and mesh.
struct Seeds {
  std::vector<Vec3f>
      positions;  // the last frame's points, moved with the flow; they need not lie on the surface exactly
  std::vector<Vec3f> previous;   // where they were in the last frame; empty: not known
  std::vector<Vec3I> triangles;  // the last frame's mesh of these points; empty: not known
  std::vector<float> scale;      // the last frame's; empty: 1 everywhere
};

// Spreads points over the zero set of phi (narrow band, metres, negative inside), one per spacing^2 of area,
// by repulsion restricted to the surface [Turk91], and connects them into a closed, oriented manifold mesh
// with the topology of phi's own iso-surface [Turk92, mutual tessellation]. Level L of the hierarchy has
// spacing 2^L * spacing. `seeds`: where to start from. Without positions, or with Points::random: drawn at
// random by area, keyed by voxel, so that a liquid at rest gets the same points on every frame. With
// `triangles` the last mesh is kept and made even again wherever the topology is still the same; with
// `previous`, too, points and mesh of a liquid at rest are exactly those of the last frame. `levels` meshes
// are made: options.levels for a first frame, 1 after it. `scale`: a factor on the spacing, place by place
// (texture/levelset/point_scale.h); empty: 1 everywhere. Same input, same bytes, on any number of threads. No
// surface: an empty result. Throws std::invalid_argument if spacing <= 0, levels < 1, phi holds a value that
// is not finite, or the seeds' arrays do not fit.
Surface prepareSurface(const openvdb::FloatGrid& phi, double spacing, const Seeds& seeds, int levels,
                       const SurfaceOptions& options, const PointScale& scale = {});
Surface prepareSurface(const openvdb::FloatGrid& phi, double spacing, const std::vector<Vec3f>& seeds,
                       int levels, const SurfaceOptions& options);

// Adds the coarser levels that a surface of one level lacks, up to `levels` in all: for frames on which so
// much surface is fresh that its texture has to be found coarse to fine (texture/labels/fresh.h). They cover
// the whole surface. phi, options and scale: those that it was prepared from.
void addCoarserLevels(const openvdb::FloatGrid& phi, int levels, const SurfaceOptions& options,
                      const PointScale& scale, Surface& surface);

}  // namespace fluidtex::texture
