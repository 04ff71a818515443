#include "tools/frames/disk_plan.h"

#include "tools/base/two_digits.h"

#include <fmt/core.h>

#include <algorithm>
#include <system_error>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

// Of the dam break with 9,000 to 40,000 points. Where few points show much texture, joints are many, and the
// other formats than PLY take up to twice as much.
double bytesPerPoint(Format format) {
  switch (format) {
    case Format::ply:
      return 250.0;
    case Format::glb:
    case Format::vtp:
      return 400.0;
    case Format::obj:
      return 450.0;
    case Format::usda:
      return 1300.0;
  }
  return 0.0;
}
// PNG of a path tracer's noise, and H.264.
constexpr double kBytesPerPixel = 1.6, kBytesPerVideoPixel = 0.1;
// Of a photograph as PNG.
constexpr double kBytesPerCopiedPixel = 2.0;
// Of the page: a JPEG, a triangle, its script; base64, which adds a third; and its bounds
// (tools/report/write_report.h).
constexpr double kBytesPerPreview = 40e3, kBytesPerTriangle = 5.0, kBytesOfScript = 0.7e6,
                 kBase64 = 4.0 / 3.0;
constexpr double kMostOfPreviews = 5e6, kMostOfMeshes = 8e6, kMostOfVideo = 8e6;
constexpr int kMostPreviews = 120, kMostMeshes = 12;
// The solver's grids, and the surface as it is in memory.
constexpr double kBytesOfSolver = 15e6, kStateBytesPerCell = 200.0, kStateBytesPerPoint = 181.0;

std::string sizeText(double bytes) {
  return bytes < 1e9 ? twoDigits(bytes / 1e6) + " MB" : twoDigits(bytes / 1e9) + " GB";
}

double bytesIn(const fs::path& folder) {
  double bytes = 0.0;
  std::error_code error;
  for (auto entry = fs::recursive_directory_iterator(folder, error);
       !error && entry != fs::recursive_directory_iterator(); entry.increment(error))
    if (std::error_code unknown; entry->is_regular_file(unknown)) {
      const std::uintmax_t size = entry->file_size(unknown);
      if (!unknown) bytes += double(size);
    }
  return bytes;
}

double bytesOfPage(int frames, double points, double video) {
  const double triangles = 2.0 * points;
  const double meshes =
      std::min(kMostOfMeshes, std::min(frames, kMostMeshes) * triangles * kBytesPerTriangle);
  const double previews =
      video > 0.0 ? std::min(kMostOfPreviews, std::min(frames, kMostPreviews) * kBytesPerPreview) : 0.0;
  return kBytesOfScript + kBase64 * (meshes + previews + (video <= kMostOfVideo ? video : 0.0));
}

}  // namespace

DiskPlan plannedDisk(const scenes::Scene& scene, int frames, double points, double cells, double copied,
                     bool rendered, const std::vector<Format>& formats) {
  DiskPlan plan;
  for (const Format format : formats) plan.surfaces += frames * points * bytesPerPoint(format);
  if (scenes::putsOnto(scene)) plan.surfaces += frames * points * bytesPerPoint(Format::ply);
  const double pixels = rendered ? frames * double(scene.render.width) * scene.render.height : 0.0;
  const double video = pixels * kBytesPerVideoPixel;
  plan.pictures = pixels * kBytesPerPixel + video;
  plan.page = bytesOfPage(frames, points, video) + copied * kBytesPerCopiedPixel;
  plan.state = 2.0 * (points * kStateBytesPerPoint +
                      (cells > 0.0 ? kBytesOfSolver + cells * kStateBytesPerCell : 0.0));
  return plan;
}

std::string textOf(const DiskPlan& plan) {
  std::string text = fmt::format("about {}: surfaces {}, ", sizeText(plan.total()), sizeText(plan.surfaces));
  if (plan.pictures > 0.0) text += fmt::format("pictures {}, ", sizeText(plan.pictures));
  return text + fmt::format("state/ {}, report and exemplar {}", sizeText(plan.state), sizeText(plan.page));
}

std::optional<double> freeBytes(const fs::path& folder) {
  std::error_code error;
  fs::path there = fs::absolute(folder, error);
  while (!error && there.has_relative_path() && !fs::exists(there, error)) there = there.parent_path();
  const fs::space_info space = fs::space(there, error);
  if (error) return std::nullopt;
  return double(space.available);
}

std::string diskNote(const DiskPlan& plan, const fs::path& out) {
  const std::optional<double> available = freeBytes(out);
  // Of an earlier run what is there goes first, or is a part of this one.
  if (!available || plan.total() <= *available + bytesIn(out)) return {};
  return fmt::format(
      "{}: the run is going to take {}, and {} are free there; give fewer frames, points or formats, or "
      "another "
      "folder with --out",
      out.string(), textOf(plan), sizeText(*available));
}

}  // namespace fluidtex::tools
