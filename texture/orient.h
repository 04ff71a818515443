// The orientation field: one unit tangent vector a vertex, smooth over the surface [Kwatra07 sec. IV,
// Zhang04].
#pragma once

#include "texture/surface.h"

namespace fluidtex::texture {

struct OrientOptions {
  int coarseSweeps = 1000; // at the coarsest level
  int fineSweeps = 20;     // at each finer level after it took over the coarser one's field
  int laterSweeps = 4;     // on later frames, started from the carried field
  double carriedWeight =
      0.5;  // how strongly each sweep pulls back to the carried orientation where trust = 1
};

// Fills `orientation` of every level. First frame (carried empty): the smoothest field at the coarsest level, by inverse
// iteration from zero polar angle against consistent reference vectors, with noise that breaks symmetry; handed down and
// diffused at each finer level. Later frames: started from and held to carried.orientation, so that a field that is smooth
// hardly changes; where trust is low it is taken from the neighbours. Angles are averaged as complex numbers in the polar map
// of each vertex. Throws std::invalid_argument if a level's mesh is not closed and manifold.
void orient(Surface& surface, const Carried& carried, const OrientOptions& options = {});

// The index of the orientation field in each triangle of an oriented mesh: how many full turns the field
// makes on the way around it, counter-clockwise seen from outside; 0 where the field is regular. They sum to
// the Euler characteristic.
std::vector<int> singularities(const SurfaceMesh& mesh);

}  // namespace fluidtex::texture
