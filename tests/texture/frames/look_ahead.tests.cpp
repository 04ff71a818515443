#include "texture/frames/look_ahead.h"

#include "tests/texture/orientation/oriented_mesh.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

constexpr double kFrame = 1.0 / 24.0;  // s

// Where the points of a box's mesh were before x was drawn out by `factor` and y pressed together as much.
std::vector<Vec3f> beforeStretch(const SurfaceMesh& mesh, float factor) {
  std::vector<Vec3f> result = mesh.positions;
  for (Vec3f& p : result) p = {p.x() / factor, p.y() * factor, p.z()};
  return result;
}

// A direction in space as a number in the axes of vertex v.
Complexf inAxes(const SurfaceMesh& mesh, std::uint32_t v, const Vec3f& x) {
  const Vec3f &d = mesh.orientation[v], &n = mesh.normals[v];
  return {x.dot(d), x.dot(d.cross(n))};
}

// Axes that turn from vertex to vertex.
OrientedMesh turnedAxes(const OrientedMesh& surface) {
  SurfaceMesh mesh = surface.mesh;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const float angle = 0.3f * mesh.positions[v].x() - 0.2f * mesh.positions[v].y();
    const Vec3f d = mesh.orientation[v];
    mesh.orientation[v] = d * std::cos(angle) + mesh.normals[v].cross(d) * std::sin(angle);
  }
  return orientedMesh(std::move(mesh));
}

}  // namespace

TEST_CASE("look ahead: a strain is a stretch along its axis and the inverse across") {
  const Strain strain{0.0f, {std::log(2.0f), 0.0f}};
  CHECK(std::abs(strained(strain, {1.0f, 0.0f}) - Complexf(2.0f, 0.0f)) < 1e-6f);
  CHECK(std::abs(strained(strain, {0.0f, 1.0f}) - Complexf(0.0f, 0.5f)) < 1e-6f);
  const Strain turned{std::log(3.0f), {0.0f, std::log(2.0f)}};  // along the diagonal
  CHECK(std::abs(strained(turned, {1.0f, 1.0f}) - Complexf(6.0f, 6.0f)) < 1e-5f);
  CHECK(std::abs(strained(turned, {1.0f, -1.0f}) - Complexf(1.5f, -1.5f)) < 1e-5f);
  CHECK(largest(turned) == Approx(std::log(6.0f)));
}

TEST_CASE("look ahead: the strain of the last frame is found, whatever the orientation field") {
  const OrientedMesh box = flatBox(40), surface = GENERATE(false, true) ? turnedAxes(box) : box;
  const std::vector<float> trust(surface.mesh.positions.size(), 1.0f);
  const float factor = 1.05f;
  const std::vector<Strain> rates =
      strainRates(surface.view(), beforeStretch(surface.mesh, factor), trust, kFrame);
  const std::uint32_t v = nearestVertex(surface.mesh, Vec3f(20, 20, 2));
  const auto frame = float(kFrame);
  const Strain last{rates[v].mean * frame, rates[v].deviator * frame};
  const Complexf x = inAxes(surface.mesh, v, Vec3f(1, 0, 0)), y = inAxes(surface.mesh, v, Vec3f(0, 1, 0));
  CHECK(std::abs(strained(last, x) - factor * x) < 2e-3f);
  CHECK(std::abs(strained(last, y) - y / factor) < 2e-3f);

  // Half a second of it, and no more than asked for.
  CHECK(largest(strainAhead(rates, 0.5, 10.0)[v]) == Approx(0.5 * 24.0 * std::log(factor)).epsilon(0.03));
  CHECK(largest(strainAhead(rates, 0.5, 0.3)[v]) == Approx(0.3).epsilon(1e-4));
  for (const Strain& still : strainAhead(rates, 0.0, 0.3)) CHECK(largest(still) == 0.0f);
}

TEST_CASE("look ahead: a surface at rest, and one that was never seen, are not strained") {
  const OrientedMesh surface = orientedMesh(sphereMesh(8));
  const std::size_t count = surface.mesh.positions.size();
  const std::vector<float> trusted(count, 1.0f), lost(count, 0.0f);
  for (const Strain& s : strainRates(surface.view(), surface.mesh.positions, trusted, kFrame))
    CHECK(largest(s) < 1e-3f);
  const std::vector<Vec3f> elsewhere = beforeStretch(surface.mesh, 1.2f);
  for (const Strain& s : strainRates(surface.view(), elsewhere, lost, kFrame)) CHECK(largest(s) == 0.0f);
  for (const Strain& s : strainRates(surface.view(), elsewhere, trusted, 0.0)) CHECK(largest(s) == 0.0f);
}

TEST_CASE("look ahead: labels there and back, and the texel a label puts beside itself is the same there") {
  const OrientedMesh surface = flatBox(20);
  const std::size_t count = surface.mesh.positions.size();
  std::vector<Strain> ahead(count);
  for (std::uint32_t v = 0; v < count; ++v) {
    // One strain everywhere, in each vertex's own axes.
    const Complexf x = inAxes(surface.mesh, v, Vec3f(1, 0, 0));
    if (std::norm(x) > 0.5f) ahead[v] = {0.0f, 0.3f * x * x};
  }
  const Labels labels(count, unstretched({10, 10}, {std::polar(1.0f, 0.4f)}));
  const Labels there = strained(labels, ahead), back = unstrained(there, ahead);
  const Connection connection = strained(surface.view(), ahead);
  const std::uint32_t v = nearestVertex(surface.mesh, Vec3f(10, 10, 2));
  for (int i = 0; i < 4; ++i) CHECK(back[v].jacobian[i] == Approx(labels[v].jacobian[i]).margin(1e-5));
  CHECK(stretch(there[v]) == Approx(std::exp(0.3f)).epsilon(1e-3));
  for (std::uint32_t h = surface.graph.first[v]; h < surface.graph.first[v + 1]; ++h)
    CHECK((there[v].at(connection.edge[h]) - labels[v].at(surface.connection.edge[h])).length() < 1e-4f);
}
