// fluidtex compare SCENE: what other programs do and the paper's variants, side by side [Kwatra07 sec. VII,
// figures 7A and 11A].
#include "render/frame_name.h"
#include "render/render.h"
#include "tools/base/atomic_file.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/common_options.h"
#include "tools/measure.h"
#include "tools/run.h"
#include "tools/run_folder/out_folder.h"
#include "tools/summaries/compare_table.h"
#include "tools/summaries/contact_sheet.h"

#include <fmt/core.h>

#include <array>
#include <memory>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

struct Variant {
  const char* folder;
  const char* label;
  bool textured;
  std::vector<std::string> set;  // on top of the scene and of the user's own
};

const std::array<Variant, 7> kVariants{
    {{"untextured", "untextured", false, {"texture.method=none"}},
     {"birth", "position at birth", true, {"texture.later_frames=birth"}},
     {"dual_rest", "dual rest", true, {"texture.later_frames=dual_rest"}},
     {"advected", "pure advection", true, {"texture.later_frames=advect"}},
     {"alone", "each frame alone", true, {"texture.later_frames=alone"}},
     {"scalars", "orientation as scalars", true, {"texture.transport.orientation=scalars"}},
     {"full", "full method", true, {}}}};

constexpr int kSheetRows = 4, kSheetWidth = 384;  // pixels, of one picture
constexpr int kVideoColumns = 3, kVideoWidth = 480;

scenes::Scene sceneOf(const Variant& variant, CommonOptions options) {
  options.set.insert(options.set.end(), variant.set.begin(), variant.set.end());
  return loadScene(options);
}

// One row a moment, spread over the frames that were written, the last one included; a column a variant.
void writeSheet(const fs::path& out, int first, int last) {
  std::vector<LabelledPicture> pictures;
  const int rows = std::min(kSheetRows, last - first + 1);
  for (int row = 1; row <= rows; ++row) {
    const int frame = first + (last - first) * row / rows;
    for (const Variant& variant : kVariants)
      pictures.push_back({out / variant.folder / "frames" / (render::frameName(frame) + ".png"),
                          fmt::format("{}, {}", variant.label, frame)});
  }
  writeContactSheets({{pictures, int(kVariants.size()), kSheetWidth, out / "compare.jpg"}});
}

void writeSideBySide(const fs::path& out, int first, int last, double frameRate) {
  std::vector<ContactSheet> sheets;
  for (int frame = first; frame <= last; ++frame) {
    const std::string name = render::frameName(frame) + ".png";
    ContactSheet& sheet =
        sheets.emplace_back(ContactSheet{{}, kVideoColumns, kVideoWidth, out / "frames" / name});
    for (const Variant& variant : kVariants)
      sheet.pictures.push_back({out / variant.folder / "frames" / name, variant.label});
  }
  writeContactSheets(sheets);
  writeAtomically(out / "compare.mp4", [&](const fs::path& file) {
    render::writeVideo(out / "frames", first, last, frameRate, file);
  });
}

void compare(const CommonOptions& options) {
  int first = 1, last = 0;
  const scenes::Scene plain = loadScene(options);
  parseFrames(options.frames, plain, first, last);
  const fs::path out = options.out.empty() ? fs::path("out") / (plain.name + "_compare") : options.out;
  const OutFolder folder(out);
  std::vector<Compared> rows;
  for (const Variant& variant : kVariants) {
    if (!options.quiet) say("{}\n", variant.label);
    runInto(out / variant.folder, sceneOf(variant, options), options);
    // What has no texture has nothing to be measured.
    if (variant.textured)
      measureRun({.out = out / variant.folder,
                  .exemplar = {},
                  .json = out / variant.folder / "measure.json",
                  .motion = {},
                  .quiet = true});
    rows.push_back(comparedRun(variant.label, out / variant.folder));
  }
  writeTextAtomically(out / "compare.json", toJson(rows));
  writeTextAtomically(out / "compare.md", toMarkdown(rows));
  if (!options.quiet) print("{}", toMarkdown(rows));
  if (options.noRender) return;
  writeSheet(out, first, last);
  writeSideBySide(out, first, last, plain.sim.frameRate);
}

}  // namespace

Command compareCommand() {
  const auto options = std::make_shared<CommonOptions>();
  Command command{
      "compare",
      "Run a scene with the textures of other programs and the paper's variants; contact sheet, video and "
      "table side by side"};
  command.options = sceneOptions(*options);
  named(command.options, "--out").text = "Folder for the results (default: out/SCENE_NAME_compare)";
  append(command.options,
         {{"--resume", &options->resume, "", "Go on with the variants that an earlier call has left undone"},
          {"--no-render", &options->noRender, "", "Only the table, no pictures and no video"},
          {"--no-report", &options->noReport, "", "Write no report.html of the variants"}});
  command.footer =
      "Example:\n  fluidtex compare scenes/dam_break.toml --quality preview --out out/compare\n"
      "Writes compare.jpg, compare.mp4, compare.md and compare.json, and each variant's run beside them.";
  command.run = [options] {
    compare(*options);
    return kDone;
  };
  return command;
}

}  // namespace fluidtex::tools
