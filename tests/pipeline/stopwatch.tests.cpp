#include "pipeline/stopwatch.h"

#include <catch2/catch.hpp>

using fluidtex::pipeline::Stopwatch;

TEST_CASE("stopwatch: adds the time of its life by the clock it is given", "[pipeline]") {
  double now = 100.0, seconds = 1.0;
  const auto clock = [&] { return now; };
  {
    const Stopwatch outer(seconds, clock);
    now += 2.5;
    CHECK(seconds == 1.0);
  }
  CHECK(seconds == 3.5);
  { const Stopwatch again(seconds, clock); }
  CHECK(seconds == 3.5);
}

TEST_CASE("stopwatch: wall time without a clock", "[pipeline]") {
  double seconds = 0.0;
  {
    const Stopwatch watch(seconds);
    for (const double begun = fluidtex::pipeline::wallSeconds();
         fluidtex::pipeline::wallSeconds() == begun;) {
    }
  }
  CHECK(seconds > 0.0);
}
