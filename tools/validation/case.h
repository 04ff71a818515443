// The reference tests behind `fluidtex validate`: each runs the program's own kernels on a problem whose
// answer is known and gives rows of figures beside their bars, and curves to plot.
//
// No row has a global volume correction. Those of the level set show the surface alone; in the others the
// volume deficit is given back where it arose (docs/method/simulation.md). 2D tests of the solver are slabs
// of 8 layers between two symmetry sides (swinging_drop_2d of 16), those of the level set of 16 layers
// between walls, of which four in the middle are measured.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace fluidtex::validation {

inline constexpr double kGravity = 9.81;  // m/s2

struct Published {
  double value = 0.0;
  std::string source;  // code or paper, and the scheme
};

// One figure. It holds when its magnitude is at most `must` (at least, where `atLeast` says so); without a
// `must` it is only reported.
struct Row {
  std::string test;
  int resolution = 0;   // cells along the side that the test names
  std::string measure;  // what `value` is, and its unit
  double value = 0.0;
  std::optional<double> must, goal;
  bool atLeast = false;
  std::vector<Published> published;
  double seconds = 0.0;

  bool ok() const;
};

// A row that no other work has published.
Row row(const std::string& test, int resolution, const std::string& measure, double value,
        std::optional<double> must, std::optional<double> goal);

struct Curve {
  std::string label;
  std::vector<std::array<double, 2>> points;
  enum class Style {
    line,
    marks,
    segments
  } style = Style::line;  // segments: pairs of points, each pair a line
};

struct Plot {
  std::string name;  // file name without ending
  std::string title, xLabel, yLabel;
  bool logarithmic = false;  // both axes
  bool sameScale = false;    // both axes, for shapes
  std::vector<Curve> curves;
};

struct Result {
  std::vector<Row> rows;
  std::vector<Plot> plots;
};

// How far a case is, 0..1.
using Progress = std::function<void(double)>;

struct Case {
  std::string name;   // as on the command line
  std::string group;  // level_set, fluid, ...
  std::string title;
  std::vector<int> resolutions;  // in rising order
  std::vector<int> quick;        // those of the quick set; none: not in it
  std::function<Result(int resolution, const Progress& progress)> run;
  // Rows that follow from those of several resolutions, such as the order of convergence; may be empty.
  std::function<std::vector<Row>(const std::vector<Row>&)> summarize;
};

// All of them, in the order of the reference document.
const std::vector<Case>& cases();

}  // namespace fluidtex::validation
