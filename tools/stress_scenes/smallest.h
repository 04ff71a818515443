// Making a scene that fails as small as it can be, for those who look for the cause.
#pragma once

#include "tools/stress_scenes/random_scene.h"

#include <functional>

namespace fluidtex::stress {

// The parts without which it would not fail: leaves out one after the other, as long as `fails` says that the
// rest does so in the same way.
SceneParts smallest(SceneParts parts, const std::function<bool(const SceneParts&)>& fails);

}  // namespace fluidtex::stress
