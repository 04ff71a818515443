// fluidtex apply OUT NAME=FILE...: further maps on the surfaces of a finished run.
#include "tools/apply.h"

#include "texture/exemplar/read_image.h"
#include "texture/shown/maps.h"
#include "texture/shown/vector_maps.h"
#include "tools/base/atomic_file.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/common_options.h"
#include "tools/formats/format.h"
#include "tools/formats/ply.h"
#include "tools/formats/read_ply.h"
#include "tools/frames/image_notes.h"
#include "tools/report/write_report.h"
#include "tools/run_folder/finished_run.h"
#include "tools/run_folder/journal.h"
#include "tools/run_folder/out_folder.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <set>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

constexpr const char* kColor = "color";

}  // namespace

void checkMapName(const std::string& name) {
  const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), fits) ||
      std::isdigit(static_cast<unsigned char>(name.front())))
    throw UsageError(fmt::format(
        "{}: cannot be the name of a vertex's property; give letters, digits and _, a letter first", name));
  if (texture::isReservedName(name))
    throw UsageError(fmt::format("{}: is what every vertex has anyway; give another name", name));
}

texture::MapOptions parseMap(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos || equals == 0 || equals + 1 == text.size())
    throw UsageError(fmt::format("{}: is no map; write NAME=FILE, for example height=bark_height.png", text));
  texture::MapOptions map{.name = text.substr(0, equals), .file = text.substr(equals + 1)};
  const std::size_t colon = map.name.find(':');
  if (colon == text.npos) return map;
  const std::string holds = map.name.substr(colon + 1);
  map.name.resize(colon);
  if (holds == "normals")
    map.holds = texture::MapHolds::normals;
  else if (holds == "directions")
    map.holds = texture::MapHolds::directions;
  else
    throw UsageError(fmt::format(
        "{}: a map of {} is not known; write NAME:normals=FILE or NAME:directions=FILE", text, holds));
  return map;
}

void applyMaps(const ApplyWishes& wishes) {
  std::set<std::string> names;
  for (const texture::MapOptions& map : wishes.maps) {
    if (map.name != kColor) checkMapName(map.name);
    std::vector<std::string> own{map.name};
    if (map.holds != texture::MapHolds::values)
      for (const std::string& part : texture::vectorNames(map.name)) own.push_back(part);
    for (const std::string& name : own) {
      if (!names.insert(name).second)
        throw UsageError(
            fmt::format("{}: is the name of an earlier map too; give each a name of its own", name));
    }
  }
  const OutFolder folder(existing(wishes.out));
  const FinishedRun run = openRun(wishes.out, wishes.exemplar);
  const int width = run.color.width, height = run.color.height;
  std::vector<std::pair<std::string, texture::ExemplarMap>> maps;
  for (const texture::MapOptions& map : wishes.maps) {
    maps.emplace_back(map.name, map.name == kColor ? texture::ExemplarMap{texture::vertexMap(
                                                         texture::readImage(map.file), width, run.toroidal)}
                                                   : texture::loadMap(map, width, run.toroidal));
  }
  for (const texture::MapOptions& map : wishes.maps)
    if (map.name == kColor)
      for (const std::string& note : imageNotes({map.file})) fmt::print(stderr, "warning: {}\n", note);
  for (const int frame : run.frames) {
    texture::TexturedSurface surface = readPly(run.surfaceOf(frame), width, height);
    if (!surface.empty()) {
      surface.spacing = spacingOf(run, surface, frame);
      if (lacksGradients(surface)) texture::recoverGradients(run.toroidal, surface);
    }
    for (const auto& [name, map] : maps) {
      if (name == kColor)
        texture::lookUpColor(map.image, run.toroidal, surface);
      else
        texture::lookUp(name, map, run.toroidal, surface);
    }
    writeAtomically(run.surfaceOf(frame), [&](const fs::path& file) {
      writePly(surface, run.looksUp ? texture::findJoints(surface, run.toroidal) : texture::Joints{}, file);
      // What a run that goes on finds is as good as what it wrote.
      if (hasJournal(wishes.out))
        addToJournal(wishes.out, {lineOfFile(fs::relative(run.surfaceOf(frame), wishes.out).generic_string(),
                                             fingerprintOf(file))});
    });
  }
  if (fs::exists(wishes.out / "report.html")) writeReport({wishes.out, wishes.out});
  for (const auto& [name, map] : maps)
    print("{} {} in {} surfaces\n", name, name == kColor ? "replaced" : "written", run.frames.size());
  std::string stale;
  for (const FormatFiles& format : kFormatFiles)
    if (std::string_view(format.name) != "ply" && fs::exists(wishes.out / format.folder))
      stale += (stale.empty() ? "" : ",") + std::string(format.name);
  if (!stale.empty())
    say("note: in other formats the surfaces are as they were; fluidtex export {} --format {} makes them "
        "anew\n",
        asTyped(wishes.out.string()), stale);
}

Command applyCommand() {
  struct Arguments {
    ApplyWishes wishes;
    std::vector<std::string> maps;
  };
  const auto arguments = std::make_shared<Arguments>();
  ApplyWishes& wishes = arguments->wishes;
  Command command{"apply", "Add further maps of the exemplar to the surfaces of a finished run"};
  command.options = {
      {"out", &wishes.out, "OUT", "Folder of the run", {.required = true}},
      {"maps",
       &arguments->maps,
       "NAME=FILE",
       "Images over the same picture as the exemplar, in any resolution; `color` replaces the vertices' "
       "colours",
       {.required = true}},
      exemplarOfRun(wishes.exemplar),
  };
  command.footer =
      "Example:\n  fluidtex apply out/dam_break height=scales_height.png roughness=scales_rough.png";
  command.run = [arguments] {
    for (const std::string& text : arguments->maps) arguments->wishes.maps.push_back(parseMap(text));
    applyMaps(arguments->wishes);
    return kDone;
  };
  return command;
}

}  // namespace fluidtex::tools
