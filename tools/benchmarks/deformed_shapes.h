// Shapes given by a function, their level sets, and how LeVeque's deformation carries them: surfaces known in
// closed form, for benchmarks and tests.
#pragma once

#include <openvdb/openvdb.h>

#include <functional>
#include <vector>

namespace fluidtex::benchmarks {

// Any function with the shape's zero set and sign; points near the zero set.
struct Shape {
  std::function<double(const openvdb::Vec3d&)> value;
  std::vector<openvdb::Vec3d> points;
};

// Its level set: the function over the length of its gradient, within three voxels of the shape's points,
// which may be four voxels apart. Metres.
openvdb::FloatGrid::Ptr levelSetOf(const Shape& shape, double voxel);

// `count` points of a closed parameterised surface, at random by its parameters, which lie in [0, 1).
std::vector<openvdb::Vec3d> scattered(int count, const std::function<openvdb::Vec3d(double, double)>& at);

// The unit sphere, evenly by area.
openvdb::Vec3d onSphere(double u, double v);

// LeVeque's deformation of the unit cube with a period of 3 s: the velocity at p, m/s, at time t.
openvdb::Vec3d deformationVelocity(const openvdb::Vec3d& p, double t);

// Where p at time `from` is at time `to`, by fourth-order Runge-Kutta.
openvdb::Vec3d carriedByDeformation(openvdb::Vec3d p, double from, double to);

// A shape at time `start` of the deformation, as it is at time `t`.
Shape deformed(const Shape& shape, double start, double t);

// The sphere that the deformation draws out to a thin sheet [Enright02], as it is at time 0. At t = 1.5 it is
// most stretched and has kStretchedArea.
Shape enrightSphere(int samples);
inline constexpr double kStretchedArea = 1.17;  // m2

}  // namespace fluidtex::benchmarks
