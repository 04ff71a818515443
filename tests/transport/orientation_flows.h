// Flows under which a direction field has a closed form, and carry() held to it frame after frame
// (Kwatra et al. 2007, equation 4: d ~ F d0 with F the gradient of the flow's map).
#pragma once

#include "tests/transport/textured_meshes.h"
#include "transport/options.h"

#include <algorithm>
#include <functional>
#include <string>

namespace fluidtex::testing {

using transport::Method;
using transport::Options;
using transport::Turning;

struct Way {
  const char* name;
  Options options;
};

// Ours, the paper's, and both with components moved as scalars.
inline const std::array<Way, 4> kWays{{{"trace", {Method::trace, Turning::vector}},
                                       {"grid", {Method::grid, Turning::vector}},
                                       {"trace, scalars", {Method::trace, Turning::scalars}},
                                       {"grid, scalars", {Method::grid, Turning::scalars}}}};

struct LinearCase {
  const char* name;
  Mat3d a;      // velocity gradient, 1/s
  double time;  // s
  Vec3d direction;
};

// B1 to B4, B6 of the reference tests. Directions are chosen so that the whole field turns far.
inline std::vector<LinearCase> linearCases() {
  const Vec3d any(0.3, 0.5, 0.8);
  return {{"rigid rotation", rotationAbout({1, 2, 2}, 2 * std::numbers::pi), 1.0, any},
          {"simple shear", matrix(0, 1, 0, 0, 0, 0, 0, 0, 0), 2.0, any},
          {"planar strain", matrix(1, 0, 0, 0, -1, 0, 0, 0, 0), 0.5, any},
          {"triaxial strain", matrix(0.5, 0, 0, 0, 0.25, 0, 0, 0, -0.75), 0.8, any},
          {"general", matrix(0.3, -0.8, 0.2, 0.5, 0.1, -0.4, 0.6, 0.2, -0.4), 1.0, any}};
}

struct AngleErrors {
  double mean = 0.0, worst = 0.0;  // degrees
};

inline AngleErrors angleErrors(std::vector<double> radians) {
  AngleErrors result;
  for (const double error : radians) {
    result.mean += error / double(radians.size()) / kDegree;
    result.worst = std::max(result.worst, error / kDegree);
  }
  return result;
}

// A sphere that is carried by a steady linear flow: its mesh is the start's, mapped.
inline AngleErrors linearErrors(const LinearCase& c, const Options& options, int frames) {
  const SurfaceMesh start = sphereMesh(7, 0.4);
  const sim::Frame frame = steadyFrame({0.1, -16, 16}, c.time / frames, 1, linearFlow(c.a));
  TexturedSurface surface = texturedMesh(start, constantDirection(c.direction));
  const TexturedSurface first = surface;
  for (int step = 1; step <= frames; ++step) {
    const SurfaceMesh next = mappedMesh(start, exponential(c.a * (c.time * step / frames)));
    surface = continued(carry(surface, frame, next, 1, options), next);
  }
  const Mat3d f = exponential(c.a * c.time);
  std::vector<double> errors;
  for (std::size_t v = 0; v < start.positions.size(); ++v)
    errors.push_back(angleBetween(f * Vec3d(first.orientation[v]), Vec3d(surface.orientation[v])));
  return angleErrors(errors);
}

// Flows in the plane, on the flat top of a slab: one vertex a cell. What counts is that top inside a circle
// around `center`.
struct PlanarCase {
  const char* name;
  Flow flow;                               // at strength 1
  std::function<double(double)> strength;  // over time
  double time;                             // s
  Vec3d center;
  double radius;
  std::function<Vec3d(const Vec3d&)> exact;  // direction at the end
};

// The single vortex of Bell, Colella and Glaz, turned back after T / 2 (LeVeque): all is as it was.
inline PlanarCase singleVortex(double duration) {
  const double pi = std::numbers::pi;
  return {"single vortex",
          [pi](const Vec3d& x) {
            return Vec3d(-std::pow(std::sin(pi * x.x()), 2) * std::sin(2 * pi * x.y()),
                         std::pow(std::sin(pi * x.y()), 2) * std::sin(2 * pi * x.x()), 0.0);
          },
          [pi, duration](double t) { return std::cos(pi * t / duration); },
          duration,
          {0.5, 0.75, 0.0},
          0.15,
          constantDirection({1, 0, 0})};
}

// B5: angular rate exp(-r^2) about the middle of the unit square, r in quarters of it.
inline PlanarCase swirl(double duration) {
  const double scale = 4.0;
  const auto rate = [scale](double r) { return std::exp(-scale * scale * r * r); };
  return {"swirl",
          [rate](const Vec3d& x) {
            const Vec3d r = x - Vec3d(0.5, 0.5, x.z());
            return Vec3d(-r.y(), r.x(), 0.0) * rate(r.length());
          },
          [](double) { return 1.0; },
          duration,
          {0.5, 0.5, 0.0},
          0.4,
          [rate, scale, duration](const Vec3d& x) {
            const Vec3d r = x - Vec3d(0.5, 0.5, x.z());
            const double distance = r.length(), turn = rate(distance) * duration;
            const Vec3d d0(1, 0, 0);
            if (distance == 0.0) return Vec3d(std::cos(turn), std::sin(turn), 0.0);
            // d = R(turn) [d0 + t r rate' (d0 . e_r) e_theta], the e at the start: the end's, turned back.
            const auto turned = [](const Vec3d& y, double angle) {
              return Vec3d(std::cos(angle) * y.x() - std::sin(angle) * y.y(),
                           std::sin(angle) * y.x() + std::cos(angle) * y.y(), 0.0);
            };
            const Vec3d radial = turned(r / distance, -turn), around(-radial.y(), radial.x(), 0.0);
            const double slope = -2.0 * scale * scale * distance * rate(distance);
            return turned(d0 + around * (duration * distance * slope * d0.dot(radial)), turn);
          }};
}

enum class Points { ride, stay };  // with the flow, or where they are, so that each frame reads between them

// `steps` steps of the velocity, so many of them a frame: the field is picked up once a frame.
inline AngleErrors planarErrors(const PlanarCase& c, const Options& options, int cells, int steps,
                                Points points = Points::stay, int stepsPerFrame = 1) {
  const double h = 1.0 / cells;
  // Cells reach one beyond the square on all sides, and a few above and below the surface.
  sim::Substep unit;
  const auto component = [&](int axis) {
    auto grid = sim::FloatGrid::create(0.0f);
    auto transform = openvdb::math::Transform::createLinearTransform(h);
    Vec3d shift(0.5 * h);
    shift[axis] = 0.0;
    transform->postTranslate(shift);
    grid->setTransform(transform);
    auto accessor = grid->getAccessor();
    for (int i = -2; i <= cells + 1; ++i) {
      for (int j = -2; j <= cells + 1; ++j) {
        for (int k = -5; k <= 2; ++k) {
          const openvdb::Coord ijk(i, j, k);
          accessor.setValue(ijk, float(c.flow(grid->indexToWorld(ijk))[axis]));
        }
      }
    }
    return grid;
  };
  const std::array<sim::FloatGrid::Ptr, 3> velocity{component(0), component(1), component(2)};
  SurfaceMesh mesh = boxMesh({0, 0, -3 * h}, {1, 1, 0}, {cells, cells, 3});
  TexturedSurface surface = texturedMesh(mesh, constantDirection({1, 0, 0}));
  sim::Frame frame;
  frame.index = 1;
  for (int step = 0; step < steps; ++step) {
    const double strength = c.strength((step + 0.5) * c.time / steps);
    std::array<sim::FloatGrid::Ptr, 3> scaled;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      scaled[axis] = velocity[axis]->deepCopy();
      for (auto value = scaled[axis]->beginValueOn(); value; ++value)
        value.setValue(float(strength * *value));
    }
    frame.substeps.push_back({c.time / steps, scaled[0], scaled[1], scaled[2]});
    if ((step + 1) % stepsPerFrame != 0) continue;
    ++frame.index;
    if (points == Points::ride) mesh.positions = transport::moved(mesh.positions, frame);
    surface = continued(carry(surface, frame, mesh, 1, options), mesh);
    frame.substeps.clear();
  }
  std::vector<double> errors;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3d x(mesh.positions[v]);
    if (mesh.normals[v].z() < 0.99f || (x - c.center).length() >= c.radius) continue;
    errors.push_back(angleBetween(c.exact(x), Vec3d(surface.orientation[v])));
  }
  return angleErrors(errors);
}

}  // namespace fluidtex::testing
