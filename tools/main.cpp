// The fluidtex program: one small file per subcommand.
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/base/keep_memory.h"
#include "tools/base/work.h"
#include "tools/commands.h"

#include <openvdb/openvdb.h>
#include <spdlog/sinks/null_sink.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <sstream>

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
  app.set_version_flag("--version", std::string("fluidtex ") + FLUIDTEX_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Examples:\n  fluidtex run scenes/dam_break.toml\n  fluidtex texture cache_fluid --exemplar lava.jpg\n "
      " fluidtex check scenes/dam_break.toml --quality "
      "final");
  int exitCode = kDone;
  addRun(app, exitCode);
  addSimulate(app, exitCode);
  addTexture(app, exitCode);
  addCompare(app, exitCode);
  addApply(app, exitCode);
  addCheck(app, exitCode);
  addRender(app, exitCode);
  addMeasure(app, exitCode);
  addReport(app, exitCode);
  addView(app, exitCode);
  addValidate(app, exitCode);
  if (argc > 1 && argv[1][0] != '-') {
    bool found = false;
    std::string known;
    for (const CLI::App* command : app.get_subcommands({})) {
      found = found || command->check_name(argv[1]);
      known += (known.empty() ? "" : ", ") + command->get_name();
    }
    if (!found) {
      say("error: {}: no such command; there are: {}\n", argv[1], known);
      return kInputWrong;
    }
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream out, err;
    const bool asked = app.exit(error, out, err) == 0;  // help, or the version
    sayText(err.str());
    const int printed = guarded([&] { printText(out.str()); });
    return asked ? printed : kInputWrong;
  }
  return exitCode;
}
