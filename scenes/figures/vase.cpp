#include "scenes/figures/vase.h"

#include "scenes/exemplars/pattern.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numbers>

namespace fluidtex::figures {
namespace {

using exemplars::Color;
constexpr double kPi = std::numbers::pi;

// Radius and height of the wall, from the foot to the mouth, metres.
constexpr std::array<double, 2> kProfile[] = {{0.100, 0.00}, {0.085, 0.03}, {0.120, 0.10}, {0.175, 0.19},
                                              {0.190, 0.26}, {0.165, 0.34}, {0.100, 0.40}, {0.080, 0.44},
                                              {0.090, 0.47}, {0.120, 0.50}};
constexpr int kRings = 48, kAround = 64;
constexpr double kWidth = 0.88;   // metres that the picture is wide
constexpr double kMargin = 0.01;  // between the islands, of the picture
constexpr Color kClay{0.42, 0.115, 0.035}, kBlack{0.012, 0.011, 0.012};

double between(double a, double b, double c, double d, double t) {
  return b + 0.5 * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

// The profile at t in 0..1, by a Catmull-Rom spline.
std::array<double, 2> profileAt(double t) {
  constexpr int kLast = int(std::size(kProfile)) - 1;
  const double x = t * kLast;
  const int i = std::min(int(x), kLast - 1);
  const auto at = [&](int n) { return kProfile[std::clamp(n, 0, kLast)]; };
  std::array<double, 2> result{};
  for (std::size_t k = 0; k < 2; ++k)
    result[k] = between(at(i - 1)[k], at(i)[k], at(i + 1)[k], at(i + 2)[k], x - i);
  return result;
}

// Radius, height, and the wall's length up to there, metres; foot first.
struct Ring {
  double radius, height, along;
};
std::vector<Ring> rings() {
  std::vector<Ring> result;
  for (int n = 0; n < kRings; ++n) {
    const auto [radius, height] = profileAt(double(n) / (kRings - 1));
    const double step =
        result.empty() ? 0.0 : std::hypot(radius - result.back().radius, height - result.back().height);
    result.push_back({radius, height, (result.empty() ? 0.0 : result.back().along) + step});
  }
  return result;
}

// The share of the picture's height that the wall takes, from the top.
double wallShare() {
  return rings().back().along / kWidth;
}

struct Disc {
  double x, y, radius;  // of the picture, y down
};
Disc mouthDisc() {
  const double radius = kProfile[std::size(kProfile) - 1][0] / kWidth;
  return {kMargin + radius, wallShare() + kMargin + radius, radius};
}
Disc footDisc() {
  const double radius = kProfile[0][0] / kWidth;
  return {1.0 - kMargin - radius, wallShare() + kMargin + radius, radius};
}

// Adds a flat disc on the ring that begins at vertex `first`. up: which way it faces.
void addDisc(Vase& vase, std::size_t first, double height, const Disc& disc, bool up) {
  const std::size_t middle = vase.vertices.size(), place = vase.places.size();
  vase.vertices.push_back({0.0, 0.0, height});
  vase.places.push_back({disc.x, 1.0 - disc.y});
  for (int j = 0; j < kAround; ++j) {
    const double angle = 2.0 * kPi * j / kAround, side = up ? 1.0 : -1.0;
    vase.places.push_back(
        {disc.x + disc.radius * std::cos(angle), 1.0 - disc.y + side * disc.radius * std::sin(angle)});
  }
  for (std::size_t j = 0; j < kAround; ++j) {
    const std::size_t next = (j + 1) % kAround;
    std::vector<Corner> face{{middle, place}, {first + j, place + 1 + j}, {first + next, place + 1 + next}};
    if (!up) std::swap(face[1], face[2]);
    vase.faces.push_back(std::move(face));
  }
}

// 0..1 paint of each band: x is 0..1 around, y is 0..1 upwards in the band.

double tongues(double x, double y, int count) {
  const double u = std::abs(x * count - std::floor(x * count) - 0.5) * 2.0;  // 0 in the middle of a tongue
  const double end = y < 0.3 ? std::sqrt(std::max(0.0, 1.0 - std::pow((0.3 - y) / 0.3, 2.0))) : 1.0;
  return u < 0.72 * end && y > 0.04 ? 1.0 : 0.0;
}

double zigzag(double x, double y, int count) {
  const double wave = std::abs(x * count - std::floor(x * count) - 0.5) * 2.0;
  return std::abs(y - 0.2 - 0.6 * wave) < 0.13 ? 1.0 : 0.0;
}

double keys(double x, double y, int count) {
  static constexpr const char* kKey[] = {"11111110", "10000010", "10111010", "10100010",
                                         "10111110", "10000000", "11111111"};
  const double u = x * count;
  const int column = std::clamp(int((u - std::floor(u)) * 8.0), 0, 7), row = int((1.0 - y) * 9.0) - 1;
  return row >= 0 && row < 7 && kKey[row][column] == '1' ? 1.0 : 0.0;
}

double rays(double x, double y, int count) {
  const double u = std::abs(x * count - std::floor(x * count) - 0.5) * 2.0;
  return u < 0.9 * (1.0 - y) ? 1.0 : 0.0;
}

// Rosettes of eight petals in rings, with a bud between each two. ratio: width of the band over its height.
double rosettes(double x, double y, int count, double ratio) {
  const double cell = ratio / count, u = (x * count - std::floor(x * count) - 0.5) * cell, v = y - 0.5;
  const double r = std::hypot(u, v), angle = std::atan2(v, u);
  if (r < 0.06) return 1.0;
  if (r < 0.31) return r < 0.1 + 0.2 * std::pow(std::abs(std::cos(4.0 * angle)), 0.7) ? 1.0 : 0.0;
  if (r > 0.36 && r < 0.42) return 1.0;
  const double side = cell - 2.0 * std::abs(u);  // twice the distance from the cell's edge
  const double bud = std::hypot(0.5 * side, std::abs(v) - 0.33);
  return bud < 0.075 ? 1.0 : 0.0;
}

// Paint at a place of the wall: x around, h upwards, both 0..1.
double wallPaint(double x, double h) {
  struct Band {
    double low, high;
  };
  const auto within = [&](const Band& band) { return h >= band.low && h < band.high; };
  const auto part = [&](const Band& band) { return (h - band.low) / (band.high - band.low); };
  constexpr Band kRays{0.07, 0.26}, kLowKeys{0.29, 0.37}, kFrieze{0.385, 0.60}, kHighKeys{0.615, 0.695},
      kShoulder{0.71, 0.80}, kNeck{0.82, 0.90}, kMouth{0.92, 0.985};
  if (h < 0.05) return 1.0;
  if (within(kRays)) return rays(x, part(kRays), 24);
  if (within(kLowKeys)) return keys(x, part(kLowKeys), 14);
  if (within(kFrieze))
    return rosettes(x, part(kFrieze), 7, 1.0 / (wallShare() * (kFrieze.high - kFrieze.low)));
  if (within(kHighKeys)) return keys(x, part(kHighKeys), 14);
  if (within(kShoulder)) return tongues(x, part(kShoulder), 36);
  if (within(kNeck)) return 1.0 - zigzag(x, part(kNeck), 16);
  if (within(kMouth)) return tongues(x, part(kMouth), 28);
  const auto line = [&](double at) { return std::abs(h - at) < 0.004; };
  return line(0.28) || line(0.377) || line(0.607) || line(0.703) || line(0.81) || line(0.91) || h > 0.99
             ? 1.0
             : 0.0;
}

double discPaint(double r) {
  return (r > 0.86 || (r > 0.55 && r < 0.68) || r < 0.18) ? 1.0 : 0.0;
}

// Distance from a disc's middle over its radius.
double shareOf(const Disc& disc, double x, double y) {
  return std::hypot(x - disc.x, y - disc.y) / disc.radius;
}

}  // namespace

Vase makeVase() {
  Vase vase;
  const std::vector<Ring> wall = rings();
  for (const Ring& ring : wall)
    for (int j = 0; j <= kAround; ++j) {
      const double share = double(j) / kAround, angle = 2.0 * kPi * share;
      if (j < kAround)
        vase.vertices.push_back({ring.radius * std::cos(angle), ring.radius * std::sin(angle), ring.height});
      vase.places.push_back({share, 1.0 - wallShare() + ring.along / kWidth});
    }
  for (std::size_t n = 0; n + 1 < kRings; ++n)
    for (std::size_t j = 0; j < kAround; ++j) {
      const auto corner = [&](std::size_t ring, std::size_t around) {
        return Corner{ring * kAround + around % kAround, ring * (kAround + 1) + around};
      };
      vase.faces.push_back({corner(n, j), corner(n, j + 1), corner(n + 1, j + 1), corner(n + 1, j)});
    }
  addDisc(vase, 0, wall.front().height, footDisc(), false);
  addDisc(vase, (kRings - 1) * kAround, wall.back().height, mouthDisc(), true);
  return vase;
}

std::string objOf(const Vase& vase) {
  std::string text = "# A painted vase, metres, Z up.\n";
  const auto add = [&](const char* format, auto... values) {
    char line[96];
    std::snprintf(line, sizeof line, format, values...);
    text += line;
  };
  for (const auto& [x, y, z] : vase.vertices) add("v %.5f %.5f %.5f\n", x, y, z);
  for (const auto& [u, v] : vase.places) add("vt %.5f %.5f\n", u, v);
  for (const std::vector<Corner>& face : vase.faces) {
    text += "f";
    for (const Corner& corner : face) add(" %zu/%zu", corner.vertex + 1, corner.place + 1);
    text += "\n";
  }
  return text;
}

std::vector<std::uint8_t> makeVasePicture(int size) {
  const double share = wallShare();
  const Disc mouth = mouthDisc(), foot = footDisc();
  return exemplars::rendered(size, 3, [&](double x, double y) {
    const double onMouth = shareOf(mouth, x, y), onFoot = shareOf(foot, x, y);
    // A little more is painted than the mesh shows, so that nothing else is seen at its edges.
    const double paint = y < share                          ? wallPaint(x, 1.0 - y / share)
                         : std::min(onMouth, onFoot) < 1.05 ? discPaint(std::min(onMouth, onFoot))
                         : y < share + 0.4 * kMargin        ? wallPaint(x, 0.0)
                                                            : 0.0;
    const double shade = 0.9 + 0.2 * exemplars::fractal(11, 0, x, y, 24, 3, 0.6);
    Color color = exemplars::mixed(kClay, kBlack, paint);
    for (double& channel : color) channel *= shade;
    return color;
  });
}

}  // namespace fluidtex::figures
