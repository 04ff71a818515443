// Estimate of what a run takes on the disk.
#pragma once

#include "scenes/scene.h"
#include "tools/formats/format.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace fluidtex::tools {

// Estimated sizes of what a run writes, bytes.
struct DiskPlan {
  double surfaces = 0.0;  // of all frames, in all formats
  double pictures = 0.0;  // and the video
  double state = 0.0;     // of two states: the old one is removed after the new one is written
  double page = 0.0;      // report.html, exemplar.png, exemplar/ and between.png
  double total() const { return surfaces + pictures + state + page; }
};

// points: on the surface of a frame. cells: of liquid; 0 where nothing is simulated. copied: pixels of the
// exemplar, and of the picture that texture.between_file names, of which the folder gets copies.
DiskPlan plannedDisk(const scenes::Scene& scene, int frames, double points, double cells, double copied,
                     bool rendered, const std::vector<Format>& formats);

// "about 1.2 GB: surfaces 0.9 GB, pictures 0.1 GB, state/ 0.2 GB, report and exemplar 0.02 GB".
std::string textOf(const DiskPlan& plan);

// Bytes that are free where the folder is, or would be made; nothing where the system does not say.
std::optional<double> freeBytes(const std::filesystem::path& folder);

// A warning if the plan exceeds the free bytes at `out` plus the bytes of all files in it; else empty.
std::string diskNote(const DiskPlan& plan, const std::filesystem::path& out);

}  // namespace fluidtex::tools
