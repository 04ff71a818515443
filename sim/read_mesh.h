// What is wrong with a mesh file.
#pragma once

#include <stdexcept>

namespace fluidtex::sim {

// Thrown by readMesh(), and by all that reads a mesh through it; names the file and what is wrong with it.
struct MeshError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace fluidtex::sim
