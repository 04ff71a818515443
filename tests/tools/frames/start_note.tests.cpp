#include "tools/frames/start_note.h"

#include <catch2/catch.hpp>

using namespace fluidtex;

TEST_CASE("start note: how much begins with the mesh's texture, and a warning where nothing does",
          "[tools]") {
  scenes::Start start;
  start.mesh.file = "figures/jar.obj";
  texture::TexturedSurface first;
  first.original = {1, 0, 1, 1};
  const tools::StartNote some = tools::startNote(start, first);
  CHECK(some.text == "texture: 75% of the first surface begin with that of jar.obj");
  CHECK_FALSE(some.isWarning);
  first.original = {0, 0};
  CHECK(tools::startNote(start, first).isWarning);
  CHECK(tools::startNote(start, {}).isWarning);
}
