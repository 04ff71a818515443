// Flows of the level-set tests. Each is given by its vector potential, so that the velocities on the faces
// are free of divergence to rounding: what leaves a face is the circulation of the potential around its
// edges.
#pragma once

#include "sim/mac_grid.h"

#include <functional>

namespace fluidtex::validation {

using sim::Vec3d;

struct Flow {
  std::function<Vec3d(const Vec3d&)> potential;  // m2/s
  std::function<double(double)> strength;        // factor over time
  double duration = 0.0;                         // s; then, but for diagonal(), all is back where it began
};

Flow rotation();                     // once about the middle of the unit square
Flow singleVortex(double duration);  // Bell, Colella, Glaz 1989 as reversed by LeVeque 1996
Flow deformation2d();                // 16 vortices
Flow deformation3d();                // LeVeque 1996, Enright et al. 2002
Flow diagonal();                     // by (1, 1) in one second; it does not come back

// The flow at strength 1 on the faces of every cell of the box [-margin, cells + margin), m/s; cells of h
// metres. Face values are means over the face; those of the walls' cells let the flow run on.
sim::Velocity faceVelocity(const Flow& flow, const sim::Coord& cells, int margin, double h);

// to = factor * from, of equal topology.
void scale(const sim::Velocity& from, double factor, sim::Velocity& to);

}  // namespace fluidtex::validation
