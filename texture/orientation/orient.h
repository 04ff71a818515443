// Orientation field: one unit tangent vector per vertex, smooth over the surface [Kwatra07 sec. IV, Zhang04].
#pragma once

#include "texture/mesh/vertex_graph.h"
#include "texture/orientation/tangent.h"
#include "texture/surface.h"

#include <functional>

namespace fluidtex::texture {

struct OrientOptions {
  // Rotational symmetry N of the exemplar: 1, 2 (bricks) or 4 (squares). The field is then smooth up to
  // rotations by 360 / N degrees, and each vertex has one of its N equal directions.
  int symmetry = 1;
  int coarseSweeps = 1000;     // largest number of solver steps at the coarsest level
  int fineSweeps = 20;         // diffusion at each finer level, in sweeps of averages over neighbours
  std::uint64_t seed = 1;      // selects among equally smooth fields on a first frame
  double carriedWeight = 0.5;  // 0..1: weight of the transported orientation at a vertex of trust 1
};

// Constraints on the field besides smoothness. Both are evaluated per level; either may be empty.
struct OrientWishes {
  // #V, world space: direction of the exemplar's rows, rightwards. The length is the weight, 0..1: 0 none,
  // 0.5 as much as the neighbours, 1 a hard constraint. It holds for vertices of level 0; coarser ones stand
  // for several.
  std::function<std::vector<Vec3f>(const SurfaceMesh&)> direction;
  // #V, > 0, default 1: cost of turning. Singularities avoid places where it is much higher.
  std::function<std::vector<float>(const SurfaceMesh&)> stiffness;
};

// Fills `orientation` of every level. Values are averaged as complex numbers in the polar map of each vertex.
// First frame (`carried` empty): at the coarsest level the smoothest field, by inverse iteration from
// reference vectors with noise that breaks symmetry, or the smoothest under the given directions; each finer
// level is diffused from the coarser one.
// Later frames: the smoothest field under soft constraints to carried.orientation and to the given
// directions, so that a smooth field hardly changes. Low trust, or two opposite singularities close to each
// other, release the constraint.
// Throws std::invalid_argument if a level's mesh is not closed and manifold, if an array does not have one
// entry per vertex, or if symmetry is below 1.
void orient(Surface& surface, const Carried& carried, const OrientOptions& options = {},
            const OrientWishes& wishes = {});

// A singularity of an orientation field. Its index is turns / symmetry: the field turns by `turns` times 360
// / symmetry degrees on the way around, counter-clockwise seen from outside.
struct Singularity {
  Vec3f position{0.0f};  // centre of the triangle
  int turns = 0;
};

// Singularities of the field mesh.orientation. Over a closed surface the turns sum to symmetry times the
// Euler characteristic (Poincare-Hopf).
std::vector<Singularity> singularities(const SurfaceMesh& mesh, int symmetry = 1);
// The same for the field given by the axes of `connection`.
std::vector<Singularity> singularities(const SurfaceMesh& mesh, const VertexGraph& graph,
                                       const Connection& connection, int symmetry);

}  // namespace fluidtex::texture
