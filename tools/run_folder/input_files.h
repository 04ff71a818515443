// Content of the files that a scene names: a run can be resumed only with the files it began with.
#pragma once

#include "scenes/scene.h"

#include <nlohmann/json.hpp>

namespace fluidtex::tools {

// For each key that names a file, dotted as in the scene: {"file", "bytes", "hash"} of its content. A
// sequence also has "first" and "count"; of several files "bytes" is the sum, and "hash" is that of the
// files' hashes in order. The cache of another program, "files.path", has "frames"; since its files may be
// large, its "hash" is that of their names, sizes and modification times. Throws UsageError if a file cannot
// be read, and caches::LayoutError if the cache is not recognised.
nlohmann::ordered_json contentsOf(const scenes::Scene& scene);

// Why a run that began with files of contents `before` cannot be resumed with the scene's files, of contents
// `current`, in one sentence; empty if it can. Folders do not matter. Names and modification times matter for
// a cache only. Keys on one side only are ignored.
std::string contentDifference(const nlohmann::ordered_json& before, const nlohmann::ordered_json& current,
                              const scenes::Scene& scene);

}  // namespace fluidtex::tools
