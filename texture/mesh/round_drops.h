// Drops of a handful of vertices, which cannot look like drops.
#pragma once

#include "texture/levelset/level_set.h"
#include "texture/mesh/editable_mesh.h"

namespace fluidtex::texture {

inline constexpr std::size_t kBallVertices = 18;  // an octahedron's and those in the middle of its edges

// Components without handles that have fewer vertices than kBallVertices and one in `among` (vertices that
// are gone do not count) become balls of so many, about the same middle and of the same mean radius. Whether
// there were any.
bool roundOffDrops(EditableMesh& mesh, const LevelSet& phi, const std::vector<std::uint32_t>& among);

}  // namespace fluidtex::texture
