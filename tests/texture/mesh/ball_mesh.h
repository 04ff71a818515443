// A mesh on the level set of a ball.
#pragma once

#include "tests/texture/levelset/level_sets.h"
#include "texture/mesh/connect.h"
#include "texture/mesh/points.h"

namespace fluidtex::texture {

// A ball whose index space is world space, and its mesh, not yet even.
struct BallMesh {
  LevelSet phi;
  IsoSurface surface;
  EditableMesh mesh;

  explicit BallMesh(double radius, float spacing = 1.0f)
      : phi(*sphereGrid(radius, 1.0, Vec3d(0.3, 0.1, 0.2))),
        surface(isoSurface(phi)),
        mesh(connectPoints(phi, surface, spreadPoints(phi, surface, {}, spacing, 1), spacing)) {}
};

// Vertices that are left.
inline std::size_t aliveIn(const EditableMesh& mesh) {
  std::size_t count = 0;
  for (const std::uint32_t h : mesh.outgoing) count += h != kNone;
  return count;
}

}  // namespace fluidtex::texture
