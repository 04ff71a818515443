// fluidtex report OUT: the page of a run.
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/commands.h"
#include "tools/report/write_report.h"
#include "tools/run_folder/finished_run.h"
#include "tools/run_folder/out_folder.h"

#include <memory>

namespace fluidtex::tools {

Command reportCommand() {
  const auto out = std::make_shared<std::filesystem::path>();
  Command command{"report", "Show a run on one page, OUT/report.html"};
  command.options = {{"out", out.get(), "OUT", "Folder of the run", {.required = true}}};
  command.footer = "Example:\n  fluidtex report out/dam_break";
  command.run = [out] {
    const OutFolder folder(existing(*out));
    writeReport({*out, *out});
    print("{}\n", (*out / "report.html").string());
    return kDone;
  };
  return command;
}

}  // namespace fluidtex::tools
