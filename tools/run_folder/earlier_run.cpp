#include "tools/run_folder/earlier_run.h"

#include "render/frame_name.h"
#include "tools/base/atomic_file.h"
#include "tools/formats/exemplar_picture.h"
#include "tools/formats/format.h"
#include "tools/formats/obj.h"
#include "tools/run_folder/state.h"

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

void removeFrames(const fs::path& folder, const char* extension) {
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(folder, missing))
    if (entry.path().extension() == extension && render::frameNumber(entry.path().stem().string()))
      fs::remove(entry.path());
  fs::remove(folder, missing);  // where nothing else is in it
}

}  // namespace

void removeLeftovers(const fs::path& out) {
  for (const char* folder : {"", "frames", "onto", kMovingExemplar, "state"}) removeTemporaries(out / folder);
  for (const FormatFiles& format : kFormatFiles) removeTemporaries(out / format.folder);
}

void clearEarlierRun(const fs::path& out, const std::string& sceneName) {
  fs::create_directories(out);
  removeLeftovers(out);
  removeStates(out / "state");
  fs::remove(out / "run.json");
  fs::remove(out / "report.html");
  fs::remove(out / (sceneName + ".mp4"));
  for (const char* picture : {kExemplarFile, kBetweenFile}) fs::remove(out / picture);
  fs::remove(out / filesOf(Format::obj).folder / kObjMaterials);
  removeFrames(out / "frames", ".png");
  removeFrames(out / "onto", ".ply");
  removeFrames(out / kMovingExemplar, ".png");
  removeFrames(out / filesOf(Format::obj).folder, ".mtl");
  for (const FormatFiles& format : kFormatFiles) {
    removeFrames(out / format.folder, format.extension);
    if (format.sequence != nullptr) fs::remove(out / (sceneName + format.sequence));
  }
  if (fs::exists(out / "log.txt")) fs::resize_file(out / "log.txt", 0);
}

FrameFiles frameFilesOf(const scenes::Scene& scene, bool rendered) {
  return {rendered, scenes::putsOnto(scene), scenes::showsMovingPicture(scene)};
}

std::vector<std::string> resultsOf(int frame, const FrameFiles& files) {
  const std::string name = render::frameName(frame);
  std::vector<std::string> results;
  if (files.picture) results.push_back("frames/" + name + ".png");
  results.push_back(frameFile(Format::ply, frame));
  if (files.onto) results.push_back("onto/" + name + ".ply");
  if (files.exemplar) results.push_back(exemplarFile(frame));
  return results;
}

std::optional<Broken> firstBroken(const fs::path& out, const Journal& journal, int first, int last,
                                  const FrameFiles& files) {
  for (int frame = first; frame <= last; ++frame)
    for (const std::string& name : resultsOf(frame, files))
      if (!isWhole(journal, out, name))
        return Broken{frame, name, fs::exists(out / name), journal.files.contains(name)};
  return std::nullopt;
}

}  // namespace fluidtex::tools
