// Settings of what moves the liquid: the solver, or a flow known in closed form.
#pragma once

namespace fluidtex::sim {

enum class MotionKind { solver, rest, rotation, vortex, deformation, stretch, sourceSink };

// A flow known in closed form (sim/motion/known_flow.h) is drawn out over the domain.
struct MotionOptions {
  MotionKind flow = MotionKind::solver;
  double period = 6.0;  // s, vortex and deformation: they turn back after half of it
  // 1/s. Rotation: radians a second; vortex: the same of its middle at the start; stretch: how fast lengths
  // along x grow; source and sink: how fast the area at the source grows.
  double rate = 1.0;
};

}  // namespace fluidtex::sim
