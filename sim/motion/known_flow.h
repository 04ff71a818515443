// Analytic flows, for level-set tests, and for scenes without the solver (sim/motion/analytic_flow.h).
// Divergence-free ones are given by their vector potential: the flux through a face is the circulation of the
// potential around its edges, so that the face velocities are divergence-free to rounding.
#pragma once

#include "sim/grid/mac_grid.h"

#include <functional>
#include <numbers>

namespace fluidtex::sim {

struct KnownFlow {
  std::function<Vec3d(const Vec3d&)> potential;  // m2/s; empty where the velocity itself is given
  std::function<double(double)> strength;        // factor over time
  double duration = 0.0;  // s; flows that reverse or rotate are back at their start then
  std::function<Vec3d(const Vec3d&)> velocity = {};  // m/s, of a flow that has divergence
};

// Flows of the unit square or cube, which they do not leave, except diagonal().
KnownFlow singleVortex(double duration);  // Bell, Colella, Glaz 1989 as reversed by LeVeque 1996
KnownFlow deformation2d();                // 16 vortices
// LeVeque 1996, Enright et al. 2002; with the displacement of theirs, which lasts 3 s, for any duration.
KnownFlow deformation3d(double duration = 3.0);
KnownFlow diagonal();  // by (1, 1) in one second; it does not return

KnownFlow still();

// Rotation about a vertical axis, `rate` radians a second.
KnownFlow rotation(const Vec3d& middle = Vec3d(0.5), double rate = 2.0 * std::numbers::pi);

// In horizontal planes: the velocity along x grows by `rate` metres a second with each metre from the middle.
KnownFlow stretch(const Vec3d& middle, double rate);

// In horizontal planes, on a domain of that size: a source at two thirds of its length and width, where area
// grows by `rate` a second, an equal sink at one third, and no flow through the sides:
// u_i = rate / 2 L_i / (3 pi) sin(3 pi x_i / L_i).
KnownFlow sourceAndSink(const Vec3d& size, double rate);

// Out of a slit in the plane x = 0, along x: at `speed` (m/s) in the slit and behind it, before it faster by
// `strain` (1/s) times the way from it.
KnownFlow slot(double speed, double strain);
// How long ago (s) what is at x (m) left that slit; 0 for x <= 0.
double timeFromSlot(double x, double speed, double strain);

// A flow of the unit cube scaled to the domain [0, size], `factor` times as fast in its lengths per second.
KnownFlow drawnOut(const KnownFlow& unit, const Vec3d& size, double factor);

// The flow at strength 1 on the faces of every cell of the box [-margin, cells + margin), m/s; cells of h
// metres. By a potential, face values are means over the face; the flow continues through cells in walls.
Velocity faceVelocity(const KnownFlow& flow, const Coord& cells, int margin, double h);

// to = factor * from in the leaves of `to`, all of which `from` has.
void scale(const Velocity& from, double factor, Velocity& to);

}  // namespace fluidtex::sim
