// OUT/report.html: a run on one page.
#pragma once

#include "tools/report/evenly.h"
#include "tools/run_folder/report.h"

#include <filesystem>
#include <vector>

namespace fluidtex::tools {

// Where the parts of the page lie.
struct ReportFolders {
  std::filesystem::path run;       // run.json, log.txt, surface/
  std::filesystem::path pictures;  // frames/ and the video; where the page goes
};

// What there is to show.
struct ShownRun {
  Json figures;                 // tools/report/figures.h
  std::vector<int> pictures;    // frames with one, ascending
  std::vector<int> surfaces;    // frames with one that is not empty, ascending
  std::filesystem::path video;  // empty: none
};

// Throws UsageError if folders.run holds no run.json, or one that is damaged.
ShownRun shownRun(const ReportFolders& folders);

// Bounds of what the page holds, bytes. With base64, which adds a third, and the script, 0.7 MB, a page stays
// below 30 MB.
inline constexpr std::size_t kVideoBytes = 8'000'000, kPictureBytes = 5'000'000, kMeshBytes = 8'000'000;

// Writes folders.pictures/report.html: up to 120 pictures, 640 pixels wide, and up to 12 meshes of at most
// 500,000 triangles each, both spread evenly over the frames, fewer where they would take more than their
// share; the video, or where it is larger than its share, its name. Throws as shownRun(), UsageError for a
// surface, std::runtime_error for a picture that cannot be read, and std::system_error of the disk.
void writeReport(const ReportFolders& folders);

}  // namespace fluidtex::tools
