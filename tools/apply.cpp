// fluidtex apply OUT NAME=FILE...: further maps on the surfaces of a finished run.
#include "tools/apply.h"

#include "texture/maps.h"
#include "texture/read_image.h"
#include "tools/atomic_file.h"
#include "tools/commands.h"
#include "tools/errors.h"
#include "tools/finished_run.h"
#include "tools/ply.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <set>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

constexpr const char* kColor = "color";

void checkName(const std::string& name) {
  const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), fits) ||
      std::isdigit(static_cast<unsigned char>(name.front())))
    throw UsageError(fmt::format(
        "{}: cannot be the name of a vertex's property; give letters, digits and _, a letter first", name));
  if (isPlyProperty(name))
    throw UsageError(fmt::format("{}: is what every vertex has anyway; give another name", name));
}

}  // namespace

std::pair<std::string, fs::path> parseMap(const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == text.npos || equals == 0 || equals + 1 == text.size())
    throw UsageError(fmt::format("{}: is no map; write NAME=FILE, for example height=bark_height.png", text));
  return {text.substr(0, equals), text.substr(equals + 1)};
}

void applyMaps(const ApplyWishes& wishes) {
  for (const auto& [name, file] : wishes.maps)
    if (name != kColor) checkName(name);
  const FinishedRun run = openRun(wishes.out, wishes.exemplar);
  const int width = run.color.width, height = run.color.height;
  std::vector<std::pair<std::string, texture::Image>> maps;
  for (const auto& [name, file] : wishes.maps)
    maps.emplace_back(
        name, texture::vertexMap(name == kColor ? texture::readImage(file) : texture::readMap(file), width,
                                 run.toroidal));
  for (const int frame : run.frames) {
    texture::TexturedSurface surface = readPly(run.surfaceOf(frame), width, height);
    for (const auto& [name, map] : maps) {
      if (name == kColor)
        texture::lookUpColor(map, run.toroidal, surface);
      else
        texture::lookUpMap(name, map, run.toroidal, surface);
    }
    writeAtomically(run.surfaceOf(frame), [&](const fs::path& file) { writePly(surface, file); });
  }
}

void addApply(CLI::App& app, int& exitCode) {
  CLI::App* command =
      app.add_subcommand("apply", "Add further maps of the exemplar to the surfaces of a finished run");
  struct Arguments {
    ApplyWishes wishes;
    std::vector<std::string> maps;
  };
  auto arguments = std::make_shared<Arguments>();
  command->add_option("out", arguments->wishes.out, "Folder of the run")->required()->type_name("OUT");
  command
      ->add_option("maps", arguments->maps,
                   "Images over the same picture as the exemplar, in any resolution; `color` replaces the "
                   "vertices' colours")
      ->required()
      ->type_name("NAME=FILE");
  command
      ->add_option("--exemplar", arguments->wishes.exemplar,
                   "The run's exemplar, where it is no longer at its place")
      ->type_name("IMAGE");
  command->footer(
      "Example:\n  fluidtex apply out/dam_break height=scales_height.png roughness=scales_rough.png");
  command->callback([arguments, &exitCode] {
    exitCode = guarded([&] {
      for (const std::string& text : arguments->maps) arguments->wishes.maps.push_back(parseMap(text));
      applyMaps(arguments->wishes);
    });
  });
}

}  // namespace fluidtex::tools
