#include "tools/report/write_report.h"

#include "render/frame_name.h"
#include "tools/base/atomic_file.h"
#include "tools/base/errors.h"
#include "tools/base/work.h"
#include "tools/formats/read_ply.h"
#include "tools/report/figures.h"
#include "tools/report/packed_mesh.h"
#include "tools/report/page.h"
#include "tools/report/preview.h"
#include "tools/run_folder/finished_run.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <numeric>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kMostPictures = 120, kMostMeshes = 12, kMostTriangles = 500'000;
constexpr int kPreviewWidth = 640;
constexpr int kMeshesAtOnce = 2;  // each takes half a gigabyte for a million points

std::string contentOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The scene's own; else the newest, as that of a scene with another name.
fs::path videoIn(const fs::path& folder, const std::string& sceneName) {
  fs::path newest = folder / (sceneName + ".mp4");
  std::error_code missing;
  if (fs::exists(newest, missing)) return newest;
  newest.clear();
  for (const auto& entry : fs::directory_iterator(folder, missing))
    if (entry.path().extension() == ".mp4" && !entry.path().filename().string().starts_with('.') &&
        (newest.empty() || entry.last_write_time() > fs::last_write_time(newest)))
      newest = entry.path();
  return newest;
}

// Files of some frames, no more in all than the page has room for.
struct Chosen {
  std::vector<int> frames;
  std::vector<Attachment> files;  // one each
};

// Some of what is chosen, evenly.
Chosen fewer(Chosen chosen, std::size_t most) {
  std::vector<int> places(chosen.frames.size());
  std::iota(places.begin(), places.end(), 0);
  Chosen kept;
  for (const int place : evenly(places, most)) {
    kept.frames.push_back(chosen.frames[std::size_t(place)]);
    kept.files.push_back(std::move(chosen.files[std::size_t(place)]));
  }
  return kept;
}

std::size_t bytesOf(const std::vector<Attachment>& files) {
  std::size_t sum = 0;
  for (const Attachment& file : files) sum += file.bytes.size();
  return sum;
}

// Up to `most` of the frames, fewer where their files take more than `bytes`; one at least. make(frame): the
// file of a frame, `atOnce` of them at a time.
template <typename Make>
Chosen choose(const std::vector<int>& frames, std::size_t most, std::size_t bytes, int atOnce,
              const std::string& kind, const Make& make) {
  Chosen chosen{evenly(frames, most), {}};
  chosen.files.resize(chosen.frames.size());
  tbb::task_arena(atOnce).execute([&] {
    tbb::parallel_for(std::size_t{0}, chosen.frames.size(), [&](std::size_t n) {
      chosen.files[n] = {kind + "-" + std::to_string(chosen.frames[n]), make(chosen.frames[n])};
    });
  });
  for (std::size_t all = bytesOf(chosen.files); chosen.files.size() > 1 && all > bytes;
       all = bytesOf(chosen.files)) {
    const std::size_t count = chosen.files.size();
    chosen = fewer(std::move(chosen), std::clamp<std::size_t>(count * bytes / all, 1, count - 1));
  }
  return chosen;
}

// How many meshes are likely to fit: of large ones not all need be made.
std::size_t likelyMeshes(const Json& frames) {
  constexpr std::size_t kBytes = 5;  // of a triangle
  std::size_t largest = 1;
  for (const Json& frame : frames)
    if (frame["triangles"].is_number_unsigned())
      largest = std::max(largest, std::min(frame["triangles"].get<std::size_t>(), kMostTriangles));
  return std::clamp<std::size_t>(kMeshBytes / (kBytes * largest), 1, kMostMeshes);
}

}  // namespace

ShownRun shownRun(const ReportFolders& folders) {
  const Json report = readReport(folders.run);
  ShownRun shown{figuresOf(report, contentOf(folders.run / "log.txt")),
                 framesIn(folders.pictures / "frames", ".png"),
                 framesIn(folders.run / "surface", ".ply"),
                 {}};
  shown.video = videoIn(folders.pictures, shown.figures["title"].get<std::string>());
  if (shown.figures["title"].get<std::string>().empty())
    shown.figures["title"] = fs::canonical(folders.run).filename().string();
  for (const Json& frame : shown.figures["frames"])
    if (frame["vertices"] == 0) std::erase(shown.surfaces, frame["frame"].get<int>());
  return shown;
}

void writeReport(const ReportFolders& folders) {
  nowAt(kOnRun);
  ShownRun shown = shownRun(folders);
  const auto nameOf = [](int frame, const char* extension) { return render::frameName(frame) + extension; };
  Chosen pictures =
      choose(shown.pictures, kMostPictures, kPictureBytes, tbb::this_task_arena::max_concurrency(), "picture",
             [&](int frame) {
               return previewOf(folders.pictures / "frames" / nameOf(frame, ".png"), kPreviewWidth);
             });
  Chosen meshes = choose(shown.surfaces, likelyMeshes(shown.figures["frames"]), kMeshBytes, kMeshesAtOnce,
                         "mesh", [&](int frame) {
                           return packMesh(readPly(folders.run / "surface" / nameOf(frame, ".ply"), 1, 1),
                                           kMostTriangles);
                         });
  std::vector<Attachment> attachments = std::move(pictures.files);
  std::move(meshes.files.begin(), meshes.files.end(), std::back_inserter(attachments));
  Json& figures = shown.figures;
  figures["pictures"] = pictures.frames;
  figures["meshes"] = meshes.frames;
  figures["video"] = nullptr;
  if (!shown.video.empty()) {
    const bool fits = fs::file_size(shown.video) <= kVideoBytes;
    if (fits) attachments.push_back({"video", contentOf(shown.video)});
    figures["video"] = {{"name", shown.video.filename().string()}, {"embedded", fits}};
  }
  writeTextAtomically(folders.pictures / "report.html", pageOf(figures, attachments));
}

}  // namespace fluidtex::tools
