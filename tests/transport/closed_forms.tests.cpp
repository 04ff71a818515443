// Both methods of transport beside closed forms; docs/results/validation.md has the whole table.
#include "tests/transport/orientation_flows.h"
#include "transport/carry.h"

#include <cstdio>

using namespace fluidtex;
using namespace fluidtex::testing;

TEST_CASE("closed forms: linear flows, the trace exact, components as scalars wrong", "[transport]") {
  for (const LinearCase& c : linearCases()) {
    INFO(c.name);
    CHECK(linearErrors(c, {Method::trace, Turning::vector}, 20).mean < 0.1);
    CHECK(linearErrors(c, {Method::trace, Turning::scalars}, 20).mean > 3.0);
  }
}

TEST_CASE("closed forms: a single vortex there and back, every vertex picked up anew each frame",
          "[transport]") {
  const auto errors = [](const Options& options, int cells, int frames) {
    return planarErrors(singleVortex(0.5), options, cells, frames).mean;
  };
  CHECK(errors({Method::trace, Turning::vector}, 32, 20) < 0.5);
  CHECK(errors({Method::grid, Turning::vector}, 32, 20) > errors({Method::trace, Turning::vector}, 32, 20));
}

TEST_CASE("closed forms: the single vortex of T = 2 in 100 frames", "[transport][slow]") {
  CHECK(planarErrors(singleVortex(2.0), {Method::trace, Turning::vector}, 64, 100).mean < 1.5);
  CHECK(planarErrors(singleVortex(2.0), {Method::trace, Turning::vector}, 128, 100).mean < 0.4);
}

namespace {

// Mean and worst error by every way, in degrees.
template <typename ErrorsOf>
void printRow(const std::string& name, const ErrorsOf& errorsOf) {
  std::printf("%-28s", name.c_str());
  for (const Way& way : kWays) {
    const AngleErrors e = errorsOf(way.options);
    std::printf("%11.5f /%9.4f", e.mean, e.worst);
    std::fflush(stdout);
  }
  std::printf("\n");
}

void printHead() {
  std::printf("%-28s", "mean / worst");
  for (const Way& way : kWays) std::printf("%22s", way.name);
  std::printf("\n");
}

}  // namespace

TEST_CASE("transport table: linear flows", "[.table]") {
  printHead();
  for (const LinearCase& c : linearCases())
    printRow(std::string(c.name) + ", 200 steps", [&](const Options& o) { return linearErrors(c, o, 200); });
}

TEST_CASE("transport table: swirl, 200 steps", "[.table]") {
  printHead();
  for (const int cells : {64, 128}) {
    for (const auto& [name, points] : {std::pair{"riding, ", Points::ride}, {"staying, ", Points::stay}})
      printRow(name + std::to_string(cells), [&, points = points](const Options& o) {
        return planarErrors(swirl(3.0), o, cells, 200, points);
      });
  }
}

TEST_CASE("transport table: vortex, T = 2, 100 steps", "[.table]") {
  printHead();
  for (const int cells : {64, 128}) {
    for (const auto& [name, steps] : {std::pair{"in one frame, ", 100}, {"in 100 frames, ", 1}})
      printRow(name + std::to_string(cells), [&, steps = steps](const Options& o) {
        return planarErrors(singleVortex(2.0), o, cells, 100, Points::stay, steps);
      });
  }
}
