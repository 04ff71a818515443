// fluidtex view OUT: the page of a run, in a browser, while the run goes on.
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/commands.h"
#include "tools/report/serve.h"

#include <memory>

namespace fluidtex::tools {

Command viewCommand() {
  struct Wishes {
    std::filesystem::path out;
    int port = 0;
  };
  const auto wishes = std::make_shared<Wishes>();
  Command command{"view", "Serve the page of a run to this machine's browser while it goes on"};
  command.options = {
      {"out", &wishes->out, "OUT", "Folder of the run", {.required = true}},
      {"--port",
       &wishes->port,
       "N",
       "Port to listen on (default: any that is free)",
       {.least = 1, .most = 65535}},
  };
  command.footer = "Example:\n  fluidtex view out/dam_break --port 8080";
  command.run = [wishes] {
    serveRun(wishes->out, wishes->port, [](int port) {
      print("http://127.0.0.1:{}/\n", port);
      finishPrinting();
      say("Open this address in a browser of this machine; Ctrl-C ends.\n");
    });
    return kDone;
  };
  return command;
}

}  // namespace fluidtex::tools
