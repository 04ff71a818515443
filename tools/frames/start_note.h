// What a run says of a liquid that begins with the texture of a mesh.
#pragma once

#include "scenes/scene.h"
#include "texture/surface.h"

#include <string>

namespace fluidtex::tools {

struct StartNote {
  std::string text;
  bool isWarning = false;
};

// How much of the first surface has the mesh's texture; a warning where nothing has. start: with a mesh.
StartNote startNote(const scenes::Start& start, const texture::TexturedSurface& first);

}  // namespace fluidtex::tools
