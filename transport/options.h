// Settings of transport, `texture.transport` in a scene file.
#pragma once

namespace fluidtex::transport {

enum class Method {
  trace,  // each vertex is traced back through the velocities of the substeps
  grid,   // fields on the simulation's grid, first-order upwind [Kwatra07 sec. VI]
};

enum class Turning {
  vector,   // directions turn with the flow, equation (4)
  scalars,  // components advected without turning; shown to be wrong in [Kwatra07]
};

struct Options {
  Method method = Method::trace;
  Turning orientation = Turning::vector;
};

}  // namespace fluidtex::transport
