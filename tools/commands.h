// Subcommands of the program; each adds itself to the command line, and runs if chosen.
#pragma once

#include <CLI/CLI.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace fluidtex::tools {

// Options of every subcommand that takes a scene.
struct CommonOptions {
  std::filesystem::path scene, out, exemplar;
  std::string frames, quality = "default";
  std::vector<std::string> set;
  std::vector<std::string> formats;  // beside PLY
  std::string joints = "cut";
  int threads = 0;  // 0: one per core
  bool resume = false, noRender = false, noReport = false, follow = false, quiet = false, verbose = false;
};

void addRun(CLI::App& app, int& exitCode);
void addSimulate(CLI::App& app, int& exitCode);
void addTexture(CLI::App& app, int& exitCode);
void addApply(CLI::App& app, int& exitCode);
void addCompare(CLI::App& app, int& exitCode);
void addCheck(CLI::App& app, int& exitCode);
void addRender(CLI::App& app, int& exitCode);
void addExport(CLI::App& app, int& exitCode);
void addMeasure(CLI::App& app, int& exitCode);
void addVideo(CLI::App& app, int& exitCode);
void addReport(CLI::App& app, int& exitCode);
void addView(CLI::App& app, int& exitCode);
void addValidate(CLI::App& app, int& exitCode);
void addNew(CLI::App& app, int& exitCode);
void addDoctor(CLI::App& app, int& exitCode);
// help, version, completion, man; to be called last, as they tell of the others.
void addHelp(CLI::App& app, int& exitCode);

}  // namespace fluidtex::tools
