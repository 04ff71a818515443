// Settings of transport: what a scene file says under texture.transport.
#pragma once

namespace fluidtex::transport {

enum class Method {
  trace,  // ours: each vertex is followed back through the velocities of the substeps
  grid,   // the paper's: fields on the simulation's grid, first-order upwind [Kwatra07 sec. VI]
};

enum class Turning {
  vector,   // directions turn with the flow, equation (4)
  scalars,  // their components are moved along and nothing more: what the paper shows to be wrong
};

struct Options {
  Method method = Method::trace;
  Turning orientation = Turning::vector;
};

}  // namespace fluidtex::transport
