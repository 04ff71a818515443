// Where a scene's text comes from, and places in it.
#pragma once

#include "scenes/scene.h"

#include <filesystem>
#include <optional>
#include <string>

namespace fluidtex::scenes {

struct Source {
  std::filesystem::path file;       // its folder is where the scene's file names begin
  std::optional<std::string> text;  // where it was read already, as from a pipe; `file` is then only a name
};

// As loadScene() of a file.
Scene loadScene(const Source& source, const Overrides& overrides = {});

// The line of a fault that is found only later, when a file that the scene names is read:
// FILE:LINE:COLUMN: error: KEY: MESSAGE, at the place where the key was written, in the scene or on the
// command line. key: dotted, members of lists by index. Precondition: loadScene() has taken the same.
std::string faultLine(const Source& source, const Overrides& overrides, const std::string& key,
                      const std::string& message);

}  // namespace fluidtex::scenes
