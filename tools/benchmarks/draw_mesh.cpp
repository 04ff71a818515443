#include "tools/benchmarks/draw_mesh.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace fluidtex::benchmarks {
namespace {

using openvdb::Vec3d;

constexpr int kWidth = 1400, kHeight = 1000;
constexpr double kEdgeWidth = 0.8, kDotRadius = 2.2;  // pixels

struct View {
  Vec3d right, up, towards, centre;
  double scale = 1.0;  // pixels a metre
  Vec3d seen(const openvdb::Vec3f& p) const {
    const Vec3d d = Vec3d(p) - centre;
    return {0.5 * kWidth + scale * d.dot(right), 0.5 * kHeight - scale * d.dot(up), scale * d.dot(towards)};
  }
};

View viewOf(const texture::SurfaceMesh& mesh, double zoom) {
  View view;
  view.towards = Vec3d(0.55, -0.75, 0.5).unit();
  view.right = Vec3d(0.0, 0.0, 1.0).cross(view.towards).unit();
  view.up = view.towards.cross(view.right);
  Vec3d low(1e30), high(-1e30);
  for (const openvdb::Vec3f& p : mesh.positions) {
    const Vec3d q(Vec3d(p).dot(view.right), Vec3d(p).dot(view.up), Vec3d(p).dot(view.towards));
    low = openvdb::math::minComponent(low, q);
    high = openvdb::math::maxComponent(high, q);
  }
  const Vec3d middle = 0.5 * (low + high), size = high - low;
  view.centre = view.right * middle.x() + view.up * middle.y() + view.towards * middle.z();
  view.scale = zoom * 0.95 * std::min(kWidth / size.x(), kHeight / size.y());
  return view;
}

}  // namespace

void drawMesh(const texture::SurfaceMesh& mesh, double zoom, const std::filesystem::path& file) {
  const View view = viewOf(mesh, zoom);
  std::vector<float> depth(std::size_t(kWidth) * kHeight, -1e30f);
  std::vector<std::uint8_t> pixels(3 * depth.size(), 255);
  const auto set = [&](int x, int y, float z, const std::array<double, 3>& colour) {
    const std::size_t at = std::size_t(y) * kWidth + std::size_t(x);
    if (z < depth[at]) return;
    depth[at] = z;
    for (std::size_t k = 0; k < 3; ++k)
      pixels[3 * at + k] = std::uint8_t(std::clamp(255.0 * colour[k], 0.0, 255.0));
  };
  const auto range = [](double low, double high, int size) {
    return std::pair(std::max(0, int(std::floor(low))), std::min(size - 1, int(std::ceil(high))));
  };
  for (const texture::Vec3I& t : mesh.triangles) {
    std::array<Vec3d, 3> p;
    for (int k = 0; k < 3; ++k) p[std::size_t(k)] = view.seen(mesh.positions[t[k]]);
    const double area = (p[1] - p[0]).cross(p[2] - p[0]).z();
    if (area >= 0.0) continue;  // turned away: y runs downwards
    const Vec3d a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    const double light =
        0.35 + 0.65 * std::max(0.0, (b - a).cross(c - a).unit().dot(Vec3d(0.2, -0.6, 0.9).unit()));
    const auto [x0, x1] =
        range(std::min({p[0].x(), p[1].x(), p[2].x()}), std::max({p[0].x(), p[1].x(), p[2].x()}), kWidth);
    const auto [y0, y1] =
        range(std::min({p[0].y(), p[1].y(), p[2].y()}), std::max({p[0].y(), p[1].y(), p[2].y()}), kHeight);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        double nearest = 1e30, z = 0.0;
        bool inside = true;
        for (std::size_t k = 0; k < 3; ++k) {  // the edge opposite to corner k
          const Vec3d &from = p[(k + 1) % 3], &to = p[(k + 2) % 3];
          const double twice = (to.x() - from.x()) * (y - from.y()) - (to.y() - from.y()) * (x - from.x());
          const double weight = twice / area;
          inside = inside && weight >= 0.0;
          z += weight * p[k].z();
          nearest = std::min(nearest, std::abs(twice) / std::hypot(to.x() - from.x(), to.y() - from.y()));
        }
        if (!inside) continue;
        const double line = std::clamp(kEdgeWidth - nearest + 0.5, 0.0, 1.0) * 0.6;
        set(x, y, float(z),
            {light * 0.55 * (1.0 - line), light * 0.75 * (1.0 - line), light * 0.95 * (1.0 - line)});
      }
    }
  }
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (Vec3d(mesh.normals[v]).dot(view.towards) < 0.0) continue;
    const Vec3d p = view.seen(mesh.positions[v]);
    const double lift = 0.3 * mesh.spacing * view.scale;  // before the triangles around it
    const auto [x0, x1] = range(p.x() - kDotRadius, p.x() + kDotRadius, kWidth);
    const auto [y0, y1] = range(p.y() - kDotRadius, p.y() + kDotRadius, kHeight);
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x) {
        if (std::hypot(x - p.x(), y - p.y()) <= kDotRadius) set(x, y, float(p.z() + lift), {0.75, 0.15, 0.1});
      }
    }
  }
  const auto output = OIIO::ImageOutput::create(file.string());
  const OIIO::ImageSpec spec(kWidth, kHeight, 3, OIIO::TypeDesc::UINT8);
  if (!output || !output->open(file.string(), spec) ||
      !output->write_image(OIIO::TypeDesc::UINT8, pixels.data()) || !output->close())
    throw std::runtime_error("the picture " + file.string() + " cannot be written");
}

}  // namespace fluidtex::benchmarks
