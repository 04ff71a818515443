#include "tools/summaries/plot.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <cstdlib>

using namespace fluidtex;
namespace fs = std::filesystem;

namespace {

validation::Plot diagonal() {
  validation::Plot plot{"diagonal", "a \"diagonal\"", "x", "y", false, false, {}};
  plot.curves.push_back({"line", {}, validation::Curve::Style::line});
  // More than a pipe holds.
  for (int i = 0; i < 20000; ++i) plot.curves[0].points.push_back({double(i), double(i)});
  return plot;
}

}  // namespace

TEST_CASE("plot: a whole SVG file", "[tools]") {
  const Scratch scratch;
  tools::writePlot(diagonal(), scratch.path / "a" / "plot.svg");
  const std::string svg = readBytes(scratch.path / "a" / "plot.svg");
  CHECK_THAT(svg, Catch::Contains("<svg") && Catch::Contains("diagonal"));
  CHECK(svg.substr(svg.find_last_not_of(" \n") - 5, 6) == "</svg>");
}

TEST_CASE("plot: without gnuplot one sentence, and no file", "[tools]") {
  const Scratch scratch;
  const std::string path = std::getenv("PATH");
  setenv("PATH", scratch.path.c_str(), 1);
  std::string what;
  try {
    tools::writePlot(diagonal(), scratch.path / "plot.svg");
  } catch (const std::runtime_error& error) {
    what = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  CHECK_THAT(what, Catch::Contains("plot.svg: the plot could not be drawn: gnuplot could not be started") &&
                       Catch::Contains("gnuplot-nox"));
  CHECK(fs::is_empty(scratch.path));
}
