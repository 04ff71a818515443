// Both methods of transport beside closed forms; docs/transport.md has the whole table.
#include "tests/transport/orientation_flows.h"
#include "transport/carry.h"

#include <cstdio>

using namespace fluidtex;
using namespace fluidtex::testing;

TEST_CASE("transport table: orientation by every way, in degrees", "[.table]") {
  std::printf("%-28s", "mean / worst");
  for (const Way& way : kWays) std::printf("%22s", way.name);
  std::printf("\n");
  const auto row = [](const std::string& name, const auto& errorsOf) {
    std::printf("%-28s", name.c_str());
    for (const Way& way : kWays) {
      const AngleErrors e = errorsOf(way.options);
      std::printf("%11.5f /%9.4f", e.mean, e.worst);
      std::fflush(stdout);
    }
    std::printf("\n");
  };
  for (const LinearCase& c : linearCases())
    row(std::string(c.name) + ", 200 steps", [&](const Options& o) { return linearErrors(c, o, 200); });
  for (const int cells : {64, 128}) {
    row("swirl, 200 steps, " + std::to_string(cells),
        [&](const Options& o) { return planarErrors(swirl(3.0), o, cells, 200); });
    row("vortex T = 2, 100, " + std::to_string(cells),
        [&](const Options& o) { return planarErrors(singleVortex(2.0), o, cells, 100); });
  }
}
