// The fluidtex program: one small file per subcommand.
#include "scenes/faults.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/base/keep_memory.h"
#include "tools/base/work.h"
#include "tools/commands.h"

#include <openvdb/openvdb.h>
#include <spdlog/sinks/null_sink.h>
#include <spdlog/spdlog.h>

#include <cctype>
#include <filesystem>
#include <memory>
#include <sstream>
#include <vector>

namespace {

// A sentence where there is no such command, with what was meant, as far as that can be told; else empty.
std::string unknownCommand(const CLI::App& app, const std::string& name) {
  std::vector<std::string> known;
  for (const CLI::App* command : app.get_subcommands({})) {
    if (command->check_name(name)) return {};
    known.push_back(command->get_name());
  }
  if (std::error_code unknown; std::filesystem::exists(name, unknown))
    return fmt::format("{0}: no such command; to run a scene or texture a cache, fluidtex run {0}", name);
  if (const std::string near = fluidtex::scenes::nearestName(name, known); !near.empty())
    return fmt::format("{}: no such command; did you mean {}?", name, near);
  return fmt::format("{}: no such command; there are {}", name, fluidtex::scenes::listed(known));
}

// What is wrong with the arguments, and where to read what would be right.
std::string argumentFault(const CLI::App& app, const CLI::ParseError& error) {
  std::string what = error.what();
  if (what.size() > 1 && !std::isupper(static_cast<unsigned char>(what[1])))
    what[0] = char(std::tolower(static_cast<unsigned char>(what[0])));
  std::string command = "fluidtex help";
  if (const auto chosen = app.get_subcommands(); !chosen.empty()) command += " " + chosen.front()->get_name();
  return fmt::format("{}; `{}` says what can be given", what, command);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace fluidtex::tools;
  keepMemory();
  openStandardStreams();
  endWithSentence();
  openvdb::initialize();
  // Until a run opens its log file, what is logged goes nowhere; by default it would go to stdout.
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("fluidtex", std::make_shared<spdlog::sinks::null_sink_mt>()));
  CLI::App app(
      "fluidtex simulates a liquid and covers its moving surface, or that of another program's liquid, with "
      "texture grown from an example image.",
      "fluidtex");
  app.require_subcommand(1);
  app.footer(
      "Examples:\n"
      "  fluidtex run scenes/dam_break.toml\n"
      "  fluidtex texture cache_fluid --exemplar lava.jpg\n"
      "  fluidtex check scenes/dam_break.toml --quality final\n"
      "Exit status: 0 done, 1 the input is wrong, 2 it failed while running, 130 interrupted; --resume goes "
      "on.\n"
      "Variables: NO_COLOR, if set, leaves messages without colour; XDG_CACHE_HOME is where tables are kept "
      "between runs (default: ~/.cache).");
  int exitCode = kDone;
  addRun(app, exitCode);
  addSimulate(app, exitCode);
  addTexture(app, exitCode);
  addCompare(app, exitCode);
  addApply(app, exitCode);
  addCheck(app, exitCode);
  addRender(app, exitCode);
  addExport(app, exitCode);
  addMeasure(app, exitCode);
  addVideo(app, exitCode);
  addReport(app, exitCode);
  addView(app, exitCode);
  addValidate(app, exitCode);
  addNew(app, exitCode);
  addDoctor(app, exitCode);
  addHelp(app, exitCode);
  if (argc > 1 && argv[1][0] != '-') {
    if (const std::string fault = unknownCommand(app, argv[1]); !fault.empty()) {
      say("error: {}\n", fault);
      return kInputWrong;
    }
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, err;
    if (app.exit(error, out, err) != 0) {
      say("error: {}\n", argumentFault(app, error));
      return kInputWrong;
    }
    return guarded([&] { printText(out.str()); });  // help, or the version
  }
  return exitCode;
}
