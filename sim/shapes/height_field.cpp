// Bicubic interpolation: Keys, "Cubic convolution interpolation for digital image processing", 1981.
#include "sim/shapes/height_field.h"

#include "numerics/catmull_rom.h"
#include "sim/meshes/triangle_mesh.h"
#include "sim/shapes/read_heights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace fluidtex::sim {

namespace {

// Of a mesh, each of two triangles: with its level set some gigabytes.
constexpr double kMostHeights = 16777216.0;

// Column and row in pixels from the first one's centre; beyond the rim it is that of the rim.
double sample(const HeightImage& image, double column, double row) {
  const double x = std::clamp(column, 0.0, image.width - 1.0), y = std::clamp(row, 0.0, image.height - 1.0);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const auto wx = catmullRom(x - i), wy = catmullRom(y - j);
  double sum = 0.0;
  for (int b = 0; b < 4; ++b) {
    const int r = std::clamp(j + b - 1, 0, image.height - 1);
    for (int a = 0; a < 4; ++a) {
      const int c = std::clamp(i + a - 1, 0, image.width - 1);
      sum += wx[a] * wy[b] * image.values[std::size_t(r) * std::size_t(image.width) + std::size_t(c)];
    }
  }
  return sum;
}

}  // namespace

TriangleMesh groundMesh(const HeightField& ground, const openvdb::BBoxd& domain, double spacing,
                        double beyond, double base) {
  const HeightImage image = readHeights(ground.file);
  const double sides[2] = {ground.pixel * image.width, ground.pixel * image.height};
  double low[2], high[2];
  double counts[2];
  for (int a = 0; a < 2; ++a) {
    low[a] = ground.translate[a];
    high[a] = low[a] + sides[a];
    const double first = domain.min()[a], last = domain.max()[a];
    if (!std::isfinite(first)) {
      low[a] -= beyond;
    } else if (low[a] <= first + spacing) {
      low[a] = first - beyond;
    }
    if (!std::isfinite(last)) {
      high[a] += beyond;
    } else if (high[a] >= last - spacing) {
      high[a] = last + beyond;
    }
    if (high[a] <= low[a]) return {};  // the picture lies beside the domain
    counts[a] = std::max(2.0, std::ceil((high[a] - low[a]) / spacing) + 1.0);
  }
  if (counts[0] * counts[1] > kMostHeights) {
    std::ostringstream text;
    text.precision(3);
    text << ground.file.string() << ": is ground of " << high[0] - low[0] << " x " << high[1] - low[1]
         << " m on sides of the domain that have no end, " << counts[0] * counts[1] << " cells of " << spacing
         << " m across; " << kMostHeights << " can be had: give a smaller pixel, or larger cells";
    throw HeightError(text.str());
  }
  const int count[2] = {static_cast<int>(counts[0]), static_cast<int>(counts[1])};
  // Heights farther from the domain than matters are as good as at that distance.
  const double lowest = domain.min().z() - beyond, highest = domain.max().z() + beyond;
  TriangleMesh mesh;
  double foot = base;
  for (int i = 0; i < count[0]; ++i) {
    const double x = low[0] + (high[0] - low[0]) * i / (count[0] - 1);
    for (int j = 0; j < count[1]; ++j) {
      const double y = low[1] + (high[1] - low[1]) * j / (count[1] - 1);
      const double share = sample(image, (x - ground.translate[0]) / ground.pixel - 0.5,
                                  image.height - (y - ground.translate[1]) / ground.pixel - 0.5);
      const double z =
          std::clamp(ground.translate[2] + ground.low + (ground.high - ground.low) * share, lowest, highest);
      mesh.positions.emplace_back(float(x), float(y), float(z));
      foot = std::min(foot, z - beyond);
    }
  }
  using Index = openvdb::Index32;
  const auto at = [&](int i, int j) { return static_cast<Index>(i * count[1] + j); };
  for (int i = 0; i + 1 < count[0]; ++i) {
    for (int j = 0; j + 1 < count[1]; ++j) {
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  // Around the rim, anticlockwise seen from above: walls down to the base, and the base as a fan.
  std::vector<Index> rim;
  for (int i = 0; i + 1 < count[0]; ++i) rim.push_back(at(i, 0));
  for (int j = 0; j + 1 < count[1]; ++j) rim.push_back(at(count[0] - 1, j));
  for (int i = count[0] - 1; i > 0; --i) rim.push_back(at(i, count[1] - 1));
  for (int j = count[1] - 1; j > 0; --j) rim.push_back(at(0, j));
  const Index first = static_cast<Index>(mesh.positions.size()), n = static_cast<Index>(rim.size());
  for (const Index top : rim) {
    openvdb::Vec3f x = mesh.positions[top];
    x.z() = float(foot);
    mesh.positions.push_back(x);
  }
  mesh.positions.emplace_back(float(0.5 * (low[0] + high[0])), float(0.5 * (low[1] + high[1])), float(foot));
  for (Index a = 0; a < n; ++a) {
    const Index b = (a + 1) % n;
    mesh.triangles.emplace_back(rim[a], first + a, first + b);
    mesh.triangles.emplace_back(rim[a], first + b, rim[b]);
    mesh.triangles.emplace_back(first + n, first + b, first + a);
  }
  return mesh;
}

}  // namespace fluidtex::sim
