// Flows known in closed form: what the level-set tests are carried by, and what moves a scene without the
// solver (sim/motion/analytic_flow.h). Those without divergence are given by their vector potential, so that
// the velocities on the faces have none to rounding: what leaves a face is the circulation of the potential
// around its edges.
#pragma once

#include "sim/grid/mac_grid.h"

#include <functional>
#include <numbers>

namespace fluidtex::sim {

struct KnownFlow {
  std::function<Vec3d(const Vec3d&)> potential;  // m2/s; none where the velocity itself is given
  std::function<double(double)> strength;        // factor over time
  double duration = 0.0;  // s; then, where it turns back or around, all is where it began
  std::function<Vec3d(const Vec3d&)> velocity = {};  // m/s, of a flow that has divergence
};

// Of the unit square or cube, which they do not leave but for diagonal().
KnownFlow singleVortex(double duration);  // Bell, Colella, Glaz 1989 as reversed by LeVeque 1996
KnownFlow deformation2d();                // 16 vortices
// LeVeque 1996, Enright et al. 2002; as far as theirs, which lasts 3 s, whatever it lasts.
KnownFlow deformation3d(double duration = 3.0);
KnownFlow diagonal();  // by (1, 1) in one second; it does not come back

KnownFlow still();

// About an upright axis, `rate` radians a second.
KnownFlow rotation(const Vec3d& middle = Vec3d(0.5), double rate = 2.0 * std::numbers::pi);

// In level planes: the velocity along x grows by `rate` metres a second with each metre from the middle.
KnownFlow stretch(const Vec3d& middle, double rate);

// In level planes, on a domain of that size: a source at two thirds of its length and width, where area grows
// by `rate` a second, an equal sink at one third, and no flow through the sides:
// u_i = rate / 2 L_i / (3 pi) sin(3 pi x_i / L_i).
KnownFlow sourceAndSink(const Vec3d& size, double rate);

// A flow of the unit cube drawn out over the domain [0, size], `factor` times as fast in its lengths per
// second.
KnownFlow drawnOut(const KnownFlow& unit, const Vec3d& size, double factor);

// The flow at strength 1 on the faces of every cell of the box [-margin, cells + margin), m/s; cells of h
// metres. By a potential, face values are means over the face; those of the walls' cells let the flow run on.
Velocity faceVelocity(const KnownFlow& flow, const Coord& cells, int margin, double h);

// to = factor * from in the leaves of `to`, all of which `from` has.
void scale(const Velocity& from, double factor, Velocity& to);

}  // namespace fluidtex::sim
