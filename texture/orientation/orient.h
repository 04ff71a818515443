// The orientation field: one unit tangent vector a vertex, smooth over the surface [Kwatra07 sec. IV,
// Zhang04].
#pragma once

#include "texture/orientation/tangent.h"
#include "texture/surface.h"

#include <functional>

namespace fluidtex::texture {

struct OrientOptions {
  // How often an exemplar looks the same in a full turn: 1, 2 (bricks) or 4 (squares). The field is then
  // smooth up to turns by 360 / symmetry degrees, and each vertex has one of its equal directions.
  int symmetry = 1;
  int coarseSweeps = 1000;  // steps of the solver at the coarsest level, at most
  int fineSweeps = 20;      // each finer level is diffused as by so many averages over neighbours
  std::uint64_t seed = 1;  // of the scene: of several fields that are as smooth, which one a first frame gets
  double carriedWeight = 0.5;  // 0..1: how strongly a vertex of trust 1 is held to its carried orientation
};

// What the field should be besides smooth. Both are asked for each level; either may be empty.
struct OrientWishes {
  // #V, in space: where the columns of the exemplar should run. The length, 0..1, is how strongly: 0 not at
  // all, 0.5 as much as the neighbours, 1 whatever they do. It counts for vertices of level 0; coarser ones
  // stand for more.
  std::function<std::vector<Vec3f>(const SurfaceMesh&)> direction;
  // #V, > 0, 1 as usual: how much turning costs. Singularities keep away from where it is much higher.
  std::function<std::vector<float>(const SurfaceMesh&)> stiffness;
};

// Fills `orientation` of every level. First frame (carried empty): the smoothest field at the coarsest level,
// by inverse iteration from consistent reference vectors with noise that breaks symmetry, or where directions
// are wished the smoothest that is held to them; handed down and diffused at each finer level. Later frames:
// the smoothest field that is held to carried.orientation and to the wishes, so that one that is smooth
// hardly changes; where trust is low, and around two opposite singularities that are near each other, it is
// taken from the neighbours. Directions are averaged as complex
// numbers in the polar map of each vertex. Throws std::invalid_argument if a level's mesh is not closed and
// manifold, if what is wished or carried is not one a vertex, or if symmetry is below 1.
void orient(Surface& surface, const Carried& carried, const OrientOptions& options = {},
            const OrientWishes& wishes = {});

// A point where an orientation field turns: `turns` times 360 / symmetry degrees on the way around,
// counter-clockwise seen from outside.
struct Singularity {
  Vec3f position{0.0f};  // centre of the triangle
  int turns = 0;
};

// Of the field mesh.orientation. Over a closed surface the turns sum to symmetry times the Euler
// characteristic.
std::vector<Singularity> singularities(const SurfaceMesh& mesh, int symmetry = 1);
// The same of the field whose arrows are the axes of `connection`.
std::vector<Singularity> singularities(const SurfaceMesh& mesh, const VertexGraph& graph,
                                       const Connection& connection, int symmetry);

}  // namespace fluidtex::texture
