#include "texture/neighborhood/neighborhood.h"

#include "tests/texture/orientation/oriented_mesh.h"
#include "tests/threads.h"
#include "texture/loops/complex.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

float noise(std::uint32_t i) {
  std::uint32_t x = i * 747796405u + 2891336453u;
  x = ((x >> ((x >> 28) + 4)) ^ x) * 277803737u;
  return float((x >> 22) ^ x) / 4294967296.0f - 0.5f;
}

// A flat box, 60 x 60 cells of one unit: its top is a plane far from the rim in the middle. Points on the top
// are shifted within the plane, and the orientation turns from vertex to vertex.
OrientedMesh plane(bool disturbed) {
  SurfaceMesh mesh = boxMesh({0, 0, 0}, {60, 60, 2}, {60, 60, 2});
  mesh.spacing = 1.0;
  mesh.orientation = referenceVectors(mesh.normals);
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
    Vec3f& x = mesh.positions[v];
    const bool inside = x.z() > 1.9f && x.x() > 0.5f && x.x() < 59.5f && x.y() > 0.5f && x.y() < 59.5f;
    if (!disturbed || !inside) continue;
    x += Vec3f(0.4f * noise(3 * v), 0.4f * noise(3 * v + 1), 0.0f);
    const float angle = 0.1f * x.x() + 6.0f * noise(3 * v + 2);
    mesh.orientation[v] = Vec3f(std::cos(angle), std::sin(angle), 0.0f);
  }
  return orientedMesh(std::move(mesh));
}

}  // namespace

TEST_CASE("neighborhood: positions on a plane are exact whatever the orientation does") {
  const OrientedMesh surface = plane(true);
  const SurfaceMesh& mesh = surface.mesh;
  for (const int window : {9, 17, 33}) {
    const std::uint32_t p = nearestVertex(mesh, Vec3f(30.2f, 29.8f, 2.0f));
    const Neighborhoods result = buildNeighborhoods(surface.view(), window, {p});
    REQUIRE(result.size() == 1);
    CHECK_FALSE(result.shrunk(0));
    const openvdb::Vec3d d(mesh.orientation[p]), b(rowAxis(mesh.orientation[p], mesh.normals[p]));
    double worst = 0.0, worstTurn = 0.0;
    std::set<std::uint32_t> found;
    for (std::size_t i = 0; i < result.vertex.size(); ++i) {
      const std::uint32_t v = result.vertex[i];
      found.insert(v);
      const openvdb::Vec3d x = openvdb::Vec3d(mesh.positions[v]) - openvdb::Vec3d(mesh.positions[p]);
      worst = std::max(
          {worst, std::abs(result.offset[i][0] - x.dot(d)), std::abs(result.offset[i][1] - x.dot(b))});
      const openvdb::Vec3d axis(mesh.orientation[v]);
      worstTurn = std::max(worstTurn, std::abs(std::complex<double>(result.turn[i]) -
                                               std::complex<double>(axis.dot(d), axis.dot(b))));
    }
    // Offsets and the connection are floats: a unit in the last place of 8 is 1e-6, of 16 2e-6; small windows
    // are off by one, since a single sweep averages rounding less than two do.
    CHECK(worst < (window < 33 ? 2e-6 : 4e-6));
    CHECK(worstTurn < 2e-6);
    // Nothing inside is missing, nothing outside is there.
    for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) {
      if (mesh.positions[v].z() < 1.9f) continue;
      const openvdb::Vec3d x = openvdb::Vec3d(mesh.positions[v]) - openvdb::Vec3d(mesh.positions[p]);
      const double size = std::max(std::abs(x.dot(d)), std::abs(x.dot(b)));
      if (std::abs(size - 0.5 * window) < 1e-5) continue;
      CHECK(found.count(v) == (size < 0.5 * window ? 1u : 0u));
    }
  }
}

TEST_CASE("neighborhood: both kinds agree for what is linear in the local coordinates, on a curved mesh") {
  const OrientedMesh surface = orientedMesh(torusMesh(90, 36));
  const std::vector<std::uint32_t> centers{5, 700, 1500, 3000};
  PixelNeighborhoods pixels;
  const int window = 9;
  const Neighborhoods result = buildNeighborhoods(surface.view(), window, centers, &pixels);
  REQUIRE(pixels.size() == centers.size() * 81);
  for (std::size_t p = 0; p < centers.size(); ++p) {
    CHECK_FALSE(result.shrunk(p));
    std::vector<float> value(surface.mesh.positions.size(), NAN);
    for (std::uint32_t i = result.first[p]; i < result.first[p + 1]; ++i)
      value[result.vertex[i]] = 0.3f + 0.7f * result.offset[i][0] - 0.4f * result.offset[i][1];
    int checked = 0;
    for (int j = -4; j <= 4; ++j) {
      for (int i = -4; i <= 4; ++i) {
        const PixelSource& pixel = pixels[p * 81 + std::size_t((j + 4) * 9 + i + 4)];
        REQUIRE_FALSE(pixel.missing());
        float sum = 0.0f;
        for (int k = 0; k < 3; ++k) sum += pixel.weight[k] * value[pixel.vertex[k]];
        if (std::isnan(sum)) continue;  // a corner of the triangle lies beyond the window's edge
        CHECK(sum == Approx(0.3f + 0.7f * i - 0.4f * j).margin(2e-5));
        ++checked;
      }
    }
    CHECK(checked >= 49);
  }
}

TEST_CASE("neighborhood: on a mesh aligned with the pixels, every pixel is one vertex") {
  OrientedMesh surface = plane(false);
  const std::uint32_t p = nearestVertex(surface.mesh, Vec3f(30, 30, 2));
  PixelNeighborhoods pixels;
  const Neighborhoods result = buildNeighborhoods(surface.view(), 17, {p}, &pixels);
  REQUIRE_FALSE(result.shrunk(0));
  const Vec3f d = surface.mesh.orientation[p], b = rowAxis(d, surface.mesh.normals[p]);
  for (int j = -8; j <= 8; ++j) {
    for (int i = -8; i <= 8; ++i) {
      const PixelSource& pixel = pixels[std::size_t((j + 8) * 17 + i + 8)];
      const std::size_t k =
          std::size_t(std::max_element(pixel.weight.begin(), pixel.weight.end()) - pixel.weight.begin());
      CHECK(pixel.weight[k] > 1.0f - 2e-6f);
      const Vec3f expected = surface.mesh.positions[p] + d * float(i) + b * float(j);
      CHECK((surface.mesh.positions[pixel.vertex[k]] - expected).length() < 1e-5f);
    }
  }
}

TEST_CASE("neighborhood: every vertex is covered, also on thin sheets and small drops") {
  std::vector<OrientedMesh> surfaces;
  surfaces.push_back(orientedMesh(sphereMesh(12)));
  surfaces.push_back(orientedMesh(sphereMesh(2)));  // smaller than any window
  surfaces.push_back(orientedMesh(boxMesh({0, 0, 0}, {30, 30, 0.2}, {30, 30, 1})));
  surfaces.push_back(orientedMesh(torusMesh(200, 8, 1.0, 0.04)));  // a thin ring: windows meet themselves
  for (const OrientedMesh& surface : surfaces) {
    for (const int window : {9, 33}) {
      const Neighborhoods result = coverSurface(surface.view(), window);
      std::vector<int> covered(surface.mesh.positions.size(), 0);
      for (std::size_t p = 0; p < result.size(); ++p) {
        CHECK(result.vertex[result.first[p]] == result.center[p]);
        CHECK(result.reach[p] <= 0.5f * float(window));
        CHECK(result.reach[p] >= 1.5f);
        std::set<std::uint32_t> once;
        for (std::uint32_t i = result.first[p]; i < result.first[p + 1]; ++i) {
          covered[result.vertex[i]] = 1;
          CHECK(once.insert(result.vertex[i]).second);
          CHECK(std::max(std::abs(result.offset[i][0]), std::abs(result.offset[i][1])) < result.reach[p]);
        }
      }
      CHECK(*std::min_element(covered.begin(), covered.end()) == 1);
    }
  }
  // A window as wide as the thin ring's girth must have ended before it met itself.
  const Neighborhoods thin = coverSurface(surfaces[3].view(), 33);
  for (std::size_t p = 0; p < thin.size(); ++p) CHECK(thin.shrunk(p));
}

TEST_CASE("neighborhood: centres lie a quarter window apart and keep to the wanted part") {
  const OrientedMesh surface = plane(true);
  std::vector<std::uint8_t> wanted(surface.mesh.positions.size(), 0);
  for (std::uint32_t v = 0; v < wanted.size(); ++v) wanted[v] = surface.mesh.positions[v].x() < 20.0f;
  const float radius = 17.0f / 4.0f;
  const std::vector<std::uint32_t> centers = selectCenters(surface.view(), radius, wanted);
  for (const std::uint32_t p : centers) CHECK(wanted[p]);
  for (std::uint32_t v = 0; v < wanted.size(); ++v) {
    if (!wanted[v]) continue;
    const bool near = std::any_of(centers.begin(), centers.end(), [&](std::uint32_t p) {
      return (surface.mesh.positions[p] - surface.mesh.positions[v]).length() <= radius * 1.0001f;
    });
    CHECK(near);
  }
  // On the top, far from the rim, no two are closer.
  for (const std::uint32_t p : centers) {
    for (const std::uint32_t q : centers) {
      const Vec3f &x = surface.mesh.positions[p], &y = surface.mesh.positions[q];
      if (p != q && x.z() > 1.9f && y.z() > 1.9f) CHECK((x - y).length() > 0.999f * radius);
    }
  }
}

TEST_CASE("neighborhood: overlaps hold every entry once, links are centres") {
  const OrientedMesh surface = orientedMesh(sphereMesh(20));
  const std::size_t count = surface.mesh.positions.size();
  const Neighborhoods windows = coverSurface(surface.view(), 9);
  const Overlaps byVertex = overlaps(windows, count);
  REQUIRE(byVertex.entry.size() == windows.vertex.size());
  for (std::uint32_t v = 0; v < count; ++v) {
    for (std::uint32_t i = byVertex.first[v]; i < byVertex.first[v + 1]; ++i) {
      const std::uint32_t p = byVertex.window[i], e = byVertex.entry[i];
      CHECK(windows.vertex[e] == v);
      CHECK((e >= windows.first[p] && e < windows.first[p + 1]));
    }
  }
  const WindowLinks links = linkWindows(windows, count, 8);
  std::size_t most = 0;
  for (std::size_t p = 0; p < windows.size(); ++p) {
    most = std::max<std::size_t>(most, links.first[p + 1] - links.first[p]);
    for (std::uint32_t i = links.first[p]; i < links.first[p + 1]; ++i) {
      CHECK(windows.vertex[links.entry[i]] == windows.center[links.window[i]]);
      CHECK(links.window[i] != p);
    }
  }
  CHECK(most == 8);
}

TEST_CASE("neighborhood: the same on one thread and on many") {
  const OrientedMesh surface = orientedMesh(torusMesh(120, 50));
  const auto build = [&](int threads) {
    return onThreads(threads, [&] {
      PixelNeighborhoods pixels;
      Neighborhoods result = coverSurface(surface.view(), 9, {}, &pixels);
      return std::make_pair(std::move(result), std::move(pixels));
    });
  };
  const auto [one, onePixels] = build(1);
  const auto [many, manyPixels] = build(4);
  CHECK(one.center == many.center);
  CHECK(one.vertex == many.vertex);
  CHECK(one.offset == many.offset);
  CHECK(one.turn == many.turn);
  REQUIRE(onePixels.size() == manyPixels.size());
  for (std::size_t i = 0; i < onePixels.size(); ++i) CHECK(onePixels[i].weight == manyPixels[i].weight);
}

TEST_CASE("neighborhood: an even or tiny window is refused") {
  const OrientedMesh surface = orientedMesh(sphereMesh(4));
  CHECK_THROWS_AS(buildNeighborhoods(surface.view(), 8, {0}), std::invalid_argument);
  CHECK_THROWS_AS(buildNeighborhoods(surface.view(), 1, {0}), std::invalid_argument);
}
