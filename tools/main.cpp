// The fluidtex program: one small file per subcommand.
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/base/keep_memory.h"
#include "tools/base/work.h"
#include "tools/command_line/parse.h"
#include "tools/commands.h"

#include <openvdb/openvdb.h>
#include <spdlog/sinks/null_sink.h>
#include <spdlog/spdlog.h>

#include <memory>

namespace {

using namespace fluidtex::tools;

Program fluidtexProgram() {
  Program program{
      "fluidtex",
      "fluidtex simulates a liquid and covers its moving surface, or that of another program's liquid, with "
      "texture grown from an example image.",
      "Examples:\n"
      "  fluidtex run scenes/dam_break.toml\n"
      "  fluidtex texture cache_fluid --exemplar lava.jpg\n"
      "  fluidtex check scenes/dam_break.toml --quality final\n"
      "Exit status: 0 done, 1 the input is wrong, 2 it failed while running, 130 interrupted; --resume goes "
      "on.\n"
      "Variables: NO_COLOR, if set, leaves messages without colour; XDG_CACHE_HOME is where tables are kept "
      "between runs (default: ~/.cache).",
      "fluidtex " FLUIDTEX_VERSION};
  program.commands = {runCommand(),    simulateCommand(),   textureCommand(), compareCommand(),
                      applyCommand(),  transitionCommand(), checkCommand(),   renderCommand(),
                      exportCommand(), measureCommand(),    videoCommand(),   reportCommand(),
                      viewCommand(),   validateCommand(),   newCommand(),     doctorCommand()};
  return program;
}

}  // namespace

int main(int argc, char** argv) {
  keepMemory();
  openStandardStreams();
  endWithSentence();
  openvdb::initialize();
  // Until a run opens its log file, what is logged goes nowhere; by default it would go to stdout.
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("fluidtex", std::make_shared<spdlog::sinks::null_sink_mt>()));
  Program program = fluidtexProgram();
  addHelp(program);
  int result = kDone;
  const int exitCode = guarded([&] {
    const Asked asked = parse(program, argc, argv);
    if (asked.command != nullptr)
      result = asked.command->run();
    else
      printText(asked.text);
  });
  return exitCode == kDone ? result : exitCode;
}
