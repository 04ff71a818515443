// Hashes, periodic noise and colours, for images made by rule.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace fluidtex::exemplars {

using Color = std::array<double, 3>;  // linear RGB

// 0..1, another one for each set of arguments.
double random(std::uint64_t seed, std::uint64_t a, std::uint64_t b, std::uint64_t c);

// The same for a place of the unit square's `cells` x `cells`, which goes on over its edges.
double randomAt(std::uint64_t seed, std::uint64_t what, int i, int j, int cells);

// 0 below `low`, 1 above `high`, smooth between.
double smooth(double low, double high, double x);

double mixed(double a, double b, double t);
Color mixed(const Color& a, const Color& b, double t);

// i modulo n, from 0.
int wrapped(int i, int n);

// Value noise with `cells` lattice cells across the unit square, periodic; 0..1.
double noise(std::uint64_t seed, std::uint64_t stream, double x, double y, int cells);

// `octaves` of noise about 0, each finer one weaker by `gain`.
double fractal(std::uint64_t seed, std::uint64_t stream, double x, double y, int cells, int octaves,
               double gain);

// Of scattered sites, `cells` across the unit square, periodic [Worley 1996]: the cell that a point is in.
struct Cell {
  double border = 1e9;  // how far its border is, in units of the sites' distance
  double shade = 0.0;   // 0..1, of the cell
};
Cell cellAt(std::uint64_t seed, std::uint64_t stream, double x, double y, int cells);

// sRGB of a linear value, IEC 61966-2-1; cut to 0..1.
double encoded(double linear);

// size x size pixels, one byte each, row by row from the top: a level of 0..1 in the middle of each.
std::vector<std::uint8_t> levelMap(int size, const std::function<double(double x, double y)>& level);

// size x size pixels, sRGB, three bytes each, row by row from the top: the mean of samples x samples colours
// in each. The image is the unit square, x to the right, y down.
std::vector<std::uint8_t> rendered(int size, int samples,
                                   const std::function<Color(double x, double y)>& color);

// A place of a picture that is cut out: its colour means nothing where alpha is 0.
struct Sample {
  Color color;
  double alpha;
};

// The same, four bytes each: sRGB and alpha, which is straight.
std::vector<std::uint8_t> cutOut(int size, int samples,
                                 const std::function<Sample(double x, double y)>& sample);

}  // namespace fluidtex::exemplars
