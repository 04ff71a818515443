// Pictures of a run's surfaces by Cycles, the path tracer of Blender, which has to be installed.
#pragma once

#include "render/render.h"
#include "scenes/scene.h"

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace fluidtex::tools {

// What Cycles has and our own renderer has not.
struct CyclesOptions {
  // How long it is open, frames, around the frame; 0: no motion blur; nothing: as the scene says.
  std::optional<double> shutter;
  std::string shader = "coat";  // as render() has it, or "principled"
  // Pictures over the exemplar, of any size, by what they say: kMapsOfCycles.
  std::map<std::string, std::filesystem::path> maps;
  std::optional<double> height;  // of white above black in bump and displacement, m; else 0.01
};

inline constexpr const char* kMapsOfCycles[] = {"color", "roughness",    "normal",
                                                "bump",  "displacement", "alpha"};

// What is done with what comes; the last two may be empty.
struct CyclesReceiver {
  // Gets radiance, linear, as render::develop() takes it.
  std::function<void(int frame, const render::Picture&)> picture;
  std::function<void(int frame, double part)> progress;  // of one picture, 0..1
  std::function<bool()> stop;                            // asked ten times a second
};

// Draws frames whose surfaces are in RUN/surface, as `scene` says: its camera, light and surroundings, in the
// exemplar's full detail. scratch: a folder for files in between. threads: 0: one a core. Throws UsageError
// where Blender cannot read what it is given, Interrupted once it is to stop, and std::runtime_error where
// Blender is not installed or fails.
void drawByCycles(const scenes::Scene& scene, const std::filesystem::path& run,
                  const std::vector<int>& frames, const CyclesOptions& options, int threads,
                  const std::filesystem::path& scratch, const CyclesReceiver& receiver);

// Saves all that would be drawn as a file of Blender's, which needs the add-on fluidtex.py. Throws likewise.
void saveForBlender(const scenes::Scene& scene, const std::filesystem::path& run,
                    const CyclesOptions& options, const std::filesystem::path& blend);

// Where the add-on is and what draws: ../share/fluidtex/blender from the program that runs, as it is
// installed, else the sources that it was built of. Throws std::runtime_error where they are not there.
std::filesystem::path blenderScripts();

}  // namespace fluidtex::tools
