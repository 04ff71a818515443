// Random scenes that a solver must bear: liquid, solids, walls, flows and sides of all kinds.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace fluidtex::stress {

// The text of a scene file, in parts of which each can be left out by itself, but for the first.
using SceneParts = std::vector<std::string>;

std::string textOf(const SceneParts& parts);

// Scene `number` of a seed: the same on every machine. 24 to 32 cells across, 20 frames.
SceneParts randomScene(std::uint64_t seed, int number);

}  // namespace fluidtex::stress
