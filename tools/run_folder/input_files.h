// Content of the files that a scene names: a run can be resumed only with the files it began with.
#pragma once

#include "scenes/scene.h"

#include <nlohmann/json.hpp>

namespace fluidtex::tools {

// For each key that names a file, dotted as in the scene: {"file", "bytes", "hash"}; of a sequence all files
// concatenated, with their range "first", "count". Throws UsageError if one cannot be read.
nlohmann::ordered_json contentsOf(const scenes::Scene& scene);

// Why a run that began with files of contents `before` cannot be resumed with the scene's files, of contents
// `current`, in one sentence; empty if it can. Paths and dates do not matter, nor do keys on one side only.
std::string contentDifference(const nlohmann::ordered_json& before, const nlohmann::ordered_json& current,
                              const scenes::Scene& scene);

}  // namespace fluidtex::tools
