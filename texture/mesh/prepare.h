// Surface preparation [Kwatra07 sec. IV]: evenly spaced points on a level set, connected to a manifold mesh.
#pragma once

#include "texture/levelset/point_scale.h"
#include "texture/options.h"
#include "texture/surface.h"

#include <openvdb/openvdb.h>

namespace fluidtex::texture {

// Spacing, metres, at which the zero set of phi has `points` points: sqrt(area / points) without `scale`. 0
// if there is no surface. Throws std::invalid_argument if points <= 0.
double spacingForPoints(const openvdb::FloatGrid& phi, int points, const PointScale& scale = {});

// The last frame's points and mesh.
struct Seeds {
  std::vector<Vec3f>
      positions;  // the last frame's points, advected with the flow; they need not lie on the surface exactly
  std::vector<Vec3f> previous;   // their positions in the last frame; empty: unknown
  std::vector<Vec3I> triangles;  // the last frame's mesh of these points; empty: unknown
  std::vector<float> scale;      // the last frame's scale; empty: 1
};

// Spreads points over the zero set of phi, one per spacing^2 of area, by repulsion restricted to the surface
// [Turk91], and connects them to a closed, oriented manifold mesh with the topology of phi's iso-surface
// (mutual tessellation [Turk92]). Without a surface the result is empty. The result does not depend on the
// number of threads.
// phi: narrow band, metres, negative inside. spacing: metres. levels: number of levels, level L with 2^L *
// spacing; options.levels on a first frame, else 1.
// seeds: without positions, or with Points::random, points are drawn at random by area, keyed by voxel, so
// that a liquid at rest gets the same points on every frame. With `triangles` the last mesh is kept and
// evened out where the topology is unchanged. With `previous` too, a liquid at rest keeps points and mesh
// exactly.
// scale: factor on the spacing (texture/levelset/point_scale.h); empty: 1.
// Throws std::invalid_argument if spacing <= 0, levels < 1, phi holds a value that is not finite, or the
// seeds' arrays do not fit.
Surface prepareSurface(const openvdb::FloatGrid& phi, double spacing, const Seeds& seeds, int levels,
                       const SurfaceOptions& options, const PointScale& scale = {});
Surface prepareSurface(const openvdb::FloatGrid& phi, double spacing, const std::vector<Vec3f>& seeds,
                       int levels, const SurfaceOptions& options);

// Adds coarser levels, up to `levels` in all, over the whole surface: for frames with wide fresh regions,
// which are textured coarse to fine (texture/labels/fresh.h). phi, options and scale: as given to
// prepareSurface().
void addCoarserLevels(const openvdb::FloatGrid& phi, int levels, const SurfaceOptions& options,
                      const PointScale& scale, Surface& surface);

}  // namespace fluidtex::texture
