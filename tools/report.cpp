// fluidtex report OUT: the page of a run.
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/commands.h"
#include "tools/report/write_report.h"
#include "tools/run_folder/finished_run.h"
#include "tools/run_folder/out_folder.h"

#include <memory>

namespace fluidtex::tools {

void addReport(CLI::App& app, int& exitCode) {
  CLI::App* command = app.add_subcommand("report", "Show a run on one page, OUT/report.html");
  auto out = std::make_shared<std::filesystem::path>();
  command->add_option("out", *out, "Folder of the run")->required()->type_name("OUT");
  command->footer("Example:\n  fluidtex report out/dam_break");
  command->callback([out, &exitCode] {
    exitCode = guarded([&] {
      const OutFolder folder(existing(*out));
      writeReport({*out, *out});
      print("{}\n", (*out / "report.html").string());
    });
  });
}

}  // namespace fluidtex::tools
