// What the page of a run says in words and numbers.
#pragma once

#include "tools/run_folder/report.h"

#include <string_view>

namespace fluidtex::tools {

// From run.json and log.txt: {"title", "version", "quality", "seed", "threads", "total" (frames of the
// scene), "rate" (frames/s), "aspect" (of a picture, width / height), "camera": {"from", "at", "fov"},
// "scene" (its text), "warnings": [...], "frames": [{"frame", "time", ...}]}. Of a frame's record what
// the page plots; whatever is no number there is null. A report that lacks keys, as of an earlier
// version, gives nulls or defaults.
Json figuresOf(const Json& report, std::string_view log);

}  // namespace fluidtex::tools
