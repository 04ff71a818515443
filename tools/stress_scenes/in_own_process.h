// Checking a scene in a process of its own: one that crashes, or never ends, is a failure like another.
#pragma once

#include "tools/stress_scenes/check_scene.h"

namespace fluidtex::stress {

// As checkScene; of further invariants
//   crash  the process is not ended by a signal
//   time   it ends within so many seconds
std::vector<Failure> checkInOwnProcess(const std::filesystem::path& file,
                                       const std::filesystem::path& scratch, double seconds,
                                       const std::string& wanted = "");

}  // namespace fluidtex::stress
