#include "tools/frames/exemplar_fit.h"

#include "tools/base/two_digits.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::tools {
namespace {

// Of the exemplar: with less on the surface, no feature of a usual one is seen whole.
constexpr double kLeast = 0.25;

constexpr int kLeastSide = 33;  // pixels, of an exemplar

// Of two digits: what is offered is a lead.
double rounded(double value) {
  const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::ceil(value / unit - 1e-9) * unit;
}

}  // namespace

std::string fitNote(const texture::Options& options, int width, int height, double points) {
  const double pixels = double(width) * height, part = points / pixels;
  if (part >= kLeast || points <= 0.0 || options.synthesis.method == texture::Method::none) return {};
  const auto side = [&](int whole) { return std::max(double(kLeastSide), whole * std::sqrt(part)); };
  const std::string more = options.spacing > 0.0
                               ? fmt::format("texture.spacing={:.2g}", options.spacing * std::sqrt(part))
                               : fmt::format("texture.points={:.0f}", rounded(pixels));
  return fmt::format(
      "{}% of {}'s {} x {} pixels fit on the surface, as each of its {:.0f} points shows one, so that "
      "features "
      "may come out as blobs; scaled to about {:.0f} x {:.0f} pixels, or with --set {}, all of it would fit",
      twoDigits(100.0 * part), options.exemplar.file.filename().string(), width, height, points, side(width),
      side(height), more);
}

}  // namespace fluidtex::tools
