// Replaces drops of too few vertices by balls.
#pragma once

#include "texture/levelset/level_set.h"
#include "texture/mesh/editable_mesh.h"

namespace fluidtex::texture {

inline constexpr std::size_t kBallVertices = 18;  // an octahedron's vertices and edge midpoints

// Components of genus 0 with fewer than kBallVertices vertices, one of them in `among` (removed vertices are
// ignored), become balls of kBallVertices with the same centre and mean radius. Returns whether there were
// any.
bool roundOffDrops(EditableMesh& mesh, const LevelSet& phi, const std::vector<std::uint32_t>& among);

}  // namespace fluidtex::texture
