// fluidtex view OUT: the page of a run, in a browser, while the run goes on.
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/commands.h"
#include "tools/report/serve.h"

#include <memory>

namespace fluidtex::tools {

void addView(CLI::App& app, int& exitCode) {
  CLI::App* command =
      app.add_subcommand("view", "Serve the page of a run to this machine's browser while it goes on");
  struct Wishes {
    std::filesystem::path out;
    int port = 0;
  };
  auto wishes = std::make_shared<Wishes>();
  command->add_option("out", wishes->out, "Folder of the run")->required()->type_name("OUT");
  command->add_option("--port", wishes->port, "Port to listen on (default: any that is free)")
      ->check(CLI::Range(1, 65535))
      ->type_name("N");
  command->footer("Example:\n  fluidtex view out/dam_break --port 8080");
  command->callback([wishes, &exitCode] {
    exitCode = guarded([&] {
      serveRun(wishes->out, wishes->port, [](int port) {
        print("http://127.0.0.1:{}/\n", port);
        finishPrinting();
        say("Open this address in a browser of this machine; Ctrl-C ends.\n");
      });
    });
  });
}

}  // namespace fluidtex::tools
