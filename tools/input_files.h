// The files that a scene names, by their content: a run can go on only with what it began with.
#pragma once

#include "scenes/scene.h"

#include <nlohmann/json.hpp>

namespace fluidtex::tools {

// For each key that names a file, dotted as in the scene: {"file", "bytes", "hash"}; of a sequence of files,
// all that belong to it one after the other, and how many they are: "first", "count". Throws UsageError where
// one cannot be read.
nlohmann::ordered_json contentsOf(const scenes::Scene& scene);

// What keeps a run that began with files of these contents from going on with those that the scene names now,
// whose contents are `current`, in one sentence; empty where nothing does. Where they lie, and how old they
// are, does not matter; keys that only one side has do not either.
std::string contentDifference(const nlohmann::ordered_json& before, const nlohmann::ordered_json& current,
                              const scenes::Scene& scene);

}  // namespace fluidtex::tools
