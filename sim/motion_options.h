// Settings of what moves the liquid: the solver, an analytic flow, or files of another program.
#pragma once

namespace fluidtex::sim {

enum class MotionKind { solver, rest, rotation, vortex, deformation, stretch, sourceSink, slot, files };

// An analytic flow (sim/motion/known_flow.h) is scaled to the domain. Files: caches/options.h.
struct MotionOptions {
  MotionKind flow = MotionKind::solver;
  double period = 6.0;  // s, vortex and deformation: they reverse after half of it
  // 1/s. Rotation: radians a second; vortex: the same at its centre at the start; stretch: growth rate of
  // lengths along x; source and sink: growth rate of area at the source.
  double rate = 1.0;
  double speed = 1.0;     // m/s, slot: of what leaves the slit
  double strain = 0.0;    // 1/s, slot: growth rate of lengths along x, once out of the slit
  double widening = 0.0;  // m/s, slot: of each end of the slit
};

}  // namespace fluidtex::sim
