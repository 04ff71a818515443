#include "texture/labels/fresh.h"

#include "tests/texture/orientation/oriented_mesh.h"
#include "texture/labels/labels.h"

#include <catch2/catch.hpp>

#include <algorithm>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

// Fresh within `half` of the middle of the flat box's upper side, in squares.
std::vector<std::uint8_t> square(const SurfaceMesh& mesh, const Vec3f& middle, float halfX, float halfY) {
  std::vector<std::uint8_t> mask(mesh.positions.size());
  for (std::size_t v = 0; v < mask.size(); ++v) {
    const Vec3f d = mesh.positions[v] - middle;
    mask[v] = std::abs(d.x()) <= halfX && std::abs(d.y()) <= halfY && d.z() >= -0.5f;
  }
  return mask;
}

}  // namespace

TEST_CASE("fresh: where trust is low") {
  CHECK(freshVertices({0.0f, 1.0f, 0.9f * kLowTrust, kLowTrust}) == std::vector<std::uint8_t>{1, 0, 1, 0});
  CHECK(freshVertices({}).empty());
}

TEST_CASE("fresh: a piece is wide where a window fits into it, however long it is") {
  const OrientedMesh box = flatBox(60);
  const Vec3f middle(30.0f, 30.0f, 2.0f);
  const auto wide = [&](const std::vector<std::uint8_t>& fresh) { return wideFresh(box.graph, fresh, 21); };
  const auto large = square(box.mesh, middle, 12.0f, 12.0f), small = square(box.mesh, middle, 7.0f, 7.0f),
             streak = square(box.mesh, middle, 28.0f, 3.0f);
  CHECK(wide(large) == large);
  CHECK_FALSE(any(wide(small)));
  CHECK_FALSE(any(wide(streak)));
  CHECK_FALSE(any(wide(std::vector<std::uint8_t>(large.size(), 0))));
  // Of two pieces each stands for itself.
  auto both = square(box.mesh, Vec3f(15.0f, 15.0f, 2.0f), 12.0f, 12.0f);
  const auto one = both, other = square(box.mesh, Vec3f(50.0f, 50.0f, 2.0f), 5.0f, 5.0f);
  for (std::size_t v = 0; v < both.size(); ++v) both[v] |= other[v];
  CHECK(wide(both) == one);
}

TEST_CASE("fresh: a whole component counts by its size") {
  const SurfaceMesh large = sphereMesh(8), small = sphereMesh(2, 0.2, {3, 0, 0});
  const OrientedMesh both = orientedMesh(together(large, small));
  const std::size_t count = both.mesh.positions.size(), first = large.positions.size();
  const std::vector<std::uint8_t> all(count, 1);
  std::vector<std::uint8_t> expected(count, 0);
  std::fill_n(expected.begin(), first, std::uint8_t(1));
  CHECK(first == 642);  // vertices; 25^2 = 625
  CHECK(wideFresh(both.graph, all, 25) == expected);
  CHECK_FALSE(any(wideFresh(both.graph, all, 27)));
  std::vector<std::uint8_t> droplet(count, 1);
  std::fill_n(droplet.begin(), first, std::uint8_t(0));
  CHECK(droplets(both.graph, 9) == droplet);
  CHECK_FALSE(any(droplets(both.graph, 5)));  // 42 vertices
  CHECK(droplets(both.graph, 27) == all);
}

TEST_CASE(
    "fresh: droplets keep their coordinates, with an unstretched gradient that is turned the same way") {
  OrientedMesh ball = orientedMesh(sphereMesh(2));
  const std::size_t count = ball.mesh.positions.size();
  Carried carried;
  carried.previousPosition = ball.mesh.positions;
  const Complexf turn = std::polar(1.0f, 0.7f);
  Labels labels(count, unstretched(Vec2f(5.0f, 6.0f), {turn}));
  for (Label& label : labels)  // three times along the exemplar's rows, a half along its columns
    label.jacobian = {3.0f * label.jacobian[0], 3.0f * label.jacobian[1], 0.5f * label.jacobian[2],
                      0.5f * label.jacobian[3]};
  for (std::uint32_t v = 0; v < count; ++v) {
    carried.coordinate.push_back(labels[v].texel);
    carried.gradient.push_back(
        gradientOf(labels[v], ball.mesh.orientation[v], ball.mesh.normals[v], ball.mesh.spacing));
  }
  const Carried before = carried;
  std::vector<std::uint8_t> mask(count, 1);
  mask[0] = 0;
  calmDroplets(ball.mesh, mask, {}, carried);
  CHECK(carried.coordinate == before.coordinate);
  CHECK(carried.gradient[0].s == before.gradient[0].s);
  const Labels calm = labelsOf(ball.mesh, carried.coordinate, carried.gradient);
  for (std::size_t v = 1; v < count; ++v) {
    CHECK(stretch(calm[v]) == Approx(1.0f).epsilon(1e-4));
    CHECK(calm[v].jacobian[0] == Approx(turn.real()).margin(1e-4));
    CHECK(calm[v].jacobian[2] == Approx(turn.imag()).margin(1e-4));
  }
}
