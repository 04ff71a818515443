#include "tools/summaries/plot.h"

#include "render/other_program.h"
#include "tools/base/atomic_file.h"

#include <fmt/format.h>

#include <stdexcept>

namespace fluidtex::tools {
namespace {

using validation::Curve;
using validation::Plot;

// A double-quoted string of gnuplot's.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

// The picture goes to gnuplot's stdout.
std::string script(const Plot& plot) {
  std::string text = fmt::format(
      "set terminal svg size 640,{} font 'sans,12' background 'white' noenhanced\n"
      "set title {}\nset xlabel {}\nset ylabel {}\nset grid lc rgb '#dddddd'\n"
      "set key outside bottom center horizontal\n",
      plot.sameScale ? 640 : 440, quoted(plot.title), quoted(plot.xLabel), quoted(plot.yLabel));
  if (plot.logarithmic) text += "set logscale xy\nset format y '%.0e'\n";
  if (plot.sameScale) text += "set size ratio -1\n";
  for (std::size_t n = 0; n < plot.curves.size(); ++n) {
    const Curve& curve = plot.curves[n];
    text += fmt::format("$curve{} << end\n", n);
    for (std::size_t i = 0; i < curve.points.size(); ++i) {
      text += fmt::format("{:.9g} {:.9g}\n", curve.points[i][0], curve.points[i][1]);
      // A blank line lifts the pen.
      if (curve.style == Curve::Style::segments && i % 2 == 1) text += "\n";
    }
    text += "end\n";
  }
  text += "plot ";
  for (std::size_t n = 0; n < plot.curves.size(); ++n) {
    const Curve& curve = plot.curves[n];
    const char* with = curve.style == Curve::Style::marks  ? "points pt 6 ps 0.8"
                       : curve.style == Curve::Style::line ? "linespoints lw 1.5 pt 7 ps 0.4"
                                                           : "lines lw 1.5";
    text += fmt::format("{}$curve{} with {} lc {} title {}", n > 0 ? ", " : "", n, with, n + 1,
                        quoted(curve.label));
  }
  return text + "\n";
}

}  // namespace

void writePlot(const Plot& whole, const std::filesystem::path& file) {
  Plot plot = whole;
  // A surface that is gone has no outline.
  std::erase_if(plot.curves, [](const Curve& curve) { return curve.points.empty(); });
  if (plot.curves.empty()) return;
  const auto fail = [&](const std::string& why) {
    throw std::runtime_error(file.string() + ": the plot could not be drawn: " + why +
                             "; is the package gnuplot-nox installed?");
  };
  render::Outcome drawn;
  try {
    drawn = render::runOther({"gnuplot"}, script(plot));
  } catch (const std::runtime_error& error) {
    fail(error.what());
  }
  if (drawn.exitCode != 0 || drawn.output.find("</svg>") == std::string::npos)
    fail("gnuplot: " + render::lastLine(drawn.complaints));
  writeTextAtomically(file, drawn.output);
}

}  // namespace fluidtex::tools
