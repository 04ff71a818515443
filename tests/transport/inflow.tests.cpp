// A slab that stays where it is while liquid goes through it along x: in at x = 0, out at the other end.
#include "transport/inflow.h"

#include "tests/transport/textured_meshes.h"

using namespace fluidtex;
using namespace fluidtex::testing;
using namespace fluidtex::transport;

namespace {

constexpr double kSpeed = 0.6, kSeconds = 0.125, kWay = kSpeed * kSeconds;  // nearly four spacings

// One vertex a texel.
SurfaceMesh slab() {
  SurfaceMesh mesh = boxMesh({0, -0.4, -0.1}, {1.2, 0.4, 0.1}, {60, 40, 10});
  mesh.spacing = 1.0 / kTexelsPerMeter;
  return mesh;
}

sim::Frame inflow(double strain) {
  return steadyFrame({0.04, -15, 45}, kSeconds, 4,
                     [=](const Vec3d& x) { return Vec3d(kSpeed + strain * std::max(x.x(), 0.0), 0.0, 0.0); });
}

// Away from the edges along x, where these coordinates are compressed.
bool onTop(const SurfaceMesh& mesh, std::size_t v) {
  return mesh.normals[v].z() > 0.99f && std::abs(mesh.positions[v].y()) < 0.3f;
}

bool onEnd(const SurfaceMesh& mesh, std::size_t v) {
  return std::abs(mesh.normals[v].x()) > 0.99f;
}

}  // namespace

TEST_CASE("inflow: what comes out along a surface goes on as what is beside it", "[transport]") {
  const SurfaceMesh mesh = slab();
  const Carried carried = carry(texturedMesh(mesh, constantDirection({1, 0.3, 0})), inflow(0.0), mesh);
  requireWhole(carried, mesh);
  int fresh = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3f& x = mesh.positions[v];
    if (!onTop(mesh, v)) continue;
    CAPTURE(x);
    const auto along = float(kTexelsPerMeter * (double(x.x()) - kWay)),
               across = float(kTexelsPerMeter * double(x.y()));
    REQUIRE((carried.coordinate[v] - Vec2f(along, across)).length() < 0.02f);
    REQUIRE((carried.gradient[v].s - Vec3f(50, 0, 0)).length() < 0.1f);
    REQUIRE((carried.gradient[v].t - Vec3f(0, 50, 0)).length() < 0.1f);
    REQUIRE((carried.fading.coordinate[v] - Vec2f(50.0f + across, -along)).length() < 0.02f);
    REQUIRE(carried.fading.weight[v] == 0.25f);
    REQUIRE(carried.trust[v] > 0.9f);
    REQUIRE(double(carried.previousPosition[v].x()) == Approx(double(x.x()) - kWay).margin(1e-4));
    REQUIRE(angleBetween(Vec3d(carried.orientation[v]), Vec3d(1, 0.3, 0)) < kDegree);
    REQUIRE(carried.stays[v] == 0);
    if (double(x.x()) > kWay - 0.5 * mesh.spacing) continue;
    REQUIRE(carried.age[v] == 0.0f);
    ++fresh;
  }
  CHECK(fresh == 3 * 29);
}

TEST_CASE("inflow: where the flow goes through a surface its texture stays", "[transport]") {
  const SurfaceMesh mesh = slab();
  const TexturedSurface previous = texturedMesh(mesh, constantDirection({1, 0.3, 0.2}));
  const Carried carried = carry(previous, inflow(0.0), mesh);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (!onEnd(mesh, v)) continue;
    REQUIRE(carried.stays[v] == 1);
    REQUIRE((carried.coordinate[v] - previous.coordinate[v]).length() < 1e-3f);
    REQUIRE((carried.gradient[v].t - previous.gradient[v].t).length() < 1e-3f);
    REQUIRE(trustBesidesStretch(carried, previous, v) > 0.99f);
  }
}

TEST_CASE("inflow: what comes out has not been strained yet, what rides has", "[transport]") {
  const double strain = 2.0;
  const SurfaceMesh mesh = slab();
  const Carried carried = carry(texturedMesh(mesh, constantDirection({1, 0, 0})), inflow(strain), mesh);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const double x = double(mesh.positions[v].x());
    if (!onTop(mesh, v)) continue;
    CAPTURE(x);
    const double along = double(carried.gradient[v].s.x());
    if (x < kWay - mesh.spacing) REQUIRE(along == Approx(kTexelsPerMeter).epsilon(0.001));
    if (x > 0.2) REQUIRE(along == Approx(kTexelsPerMeter * std::exp(-strain * kSeconds)).epsilon(0.02));
    REQUIRE(double(carried.gradient[v].t.y()) == Approx(kTexelsPerMeter).epsilon(0.001));
  }
}

TEST_CASE("inflow: a body that moves with the flow takes all of its texture along", "[transport]") {
  const SurfaceMesh before = sphereMesh(12, 0.3, {0.5, 0, 0});
  SurfaceMesh after = before;
  for (Vec3f& x : after.positions) x.x() += float(kWay);
  const TexturedSurface previous = texturedMesh(before, constantDirection({1, 0.3, 0.2}));
  const Carried carried = carry(previous, inflow(0.0), after);
  for (std::size_t v = 0; v < after.positions.size(); ++v) {
    REQUIRE(carried.stays[v] == 0);
    REQUIRE((carried.coordinate[v] - previous.coordinate[v]).length() < 0.01f);
    REQUIRE(carried.age[v] == Approx(previous.age[v]).epsilon(1e-3));
  }
}

TEST_CASE("inflow: the end of a thread is too small to stay", "[transport]") {
  // Its end has nine vertices, that of the slab some 450.
  SurfaceMesh mesh = boxMesh({0, -0.02, -0.02}, {1.2, 0.02, 0.02}, {60, 2, 2});
  mesh.spacing = 1.0 / kTexelsPerMeter;
  const Carried carried = carry(texturedMesh(mesh, constantDirection({1, 0.3, 0})), inflow(0.0), mesh);
  CHECK(std::count(carried.stays.begin(), carried.stays.end(), 1) == 0);
  requireWhole(carried, mesh);
}

TEST_CASE("inflow: a strip of other texture at the rim does not go on for ever", "[transport]") {
  const SurfaceMesh mesh = slab();
  const sim::Frame frame = inflow(0.0);
  TexturedSurface surface = texturedMesh(mesh, constantDirection({1, 0, 0}));
  for (std::size_t v = 0; v < mesh.positions.size(); ++v)
    if (std::abs(mesh.positions[v].y()) < 0.07f) surface.coordinate[v] += Vec2f(20.0f, 7.0f);
  for (int n = 1; n <= 3; ++n) {
    surface = continued(carry(surface, frame, mesh), mesh);
    int others = 0;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
      const Vec3f& x = mesh.positions[v];
      if (!onTop(mesh, v) || double(x.x()) > kWay) continue;
      const Vec2f expected(float(kTexelsPerMeter * (double(x.x()) - n * kWay)),
                           float(kTexelsPerMeter * double(x.y())));
      others += (surface.coordinate[v] - expected).length() > 0.1f;
    }
    CAPTURE(n, others);
    CHECK((n == 1 ? others > 0 : n == 2 || others == 0));
  }
}

TEST_CASE("inflow: liquid comes out where there was none, no farther than it moves", "[transport]") {
  Landing landing;  // at the end of a level surface
  landing.normal = Vec3f(0, 0, 1);
  TracedVertex vertex{{0.02, 0, 0}, {-0.1, 0, 0}, {0, 0, 1}, {0, 0, 1}, 0.02};
  const auto inflowOf = [&](const Vec3d& origin, const Vec3d& position) {
    vertex.origin = origin;
    vertex.position = position;
    landing.point.distance = origin.length();
    return inflowAt(vertex, landing);
  };
  CHECK(inflowOf({-0.1, 0, 0}, {0.02, 0, 0}) == Inflow::out);
  CHECK(inflowOf({-0.1, 0, 0.05}, {0.02, 0, 0.02}) == Inflow::out);
  CHECK(inflowOf({-0.1, 0, 0}, {-0.04, 0, 0}) == Inflow::none);      // the motion does not explain it
  CHECK(inflowOf({-0.1, 0, -0.1}, {0.1, 0, -0.1}) == Inflow::none);  // it was inside: laid open
  CHECK(inflowOf({-0.001, 0, 0}, {0.1, 0, 0}) == Inflow::none);      // on the surface
  CHECK(inflowOf({-0.1, 0, 0.1}, {-0.05, 0, 0.0}) == Inflow::none);  // across it
  CHECK(goesThrough({{0, 0, 0}, {0, 0, 0.1}, {0, 0, 1}, {0, 0, 1}, 0.02}, landing));
  landing.point.distance = 0.004;  // the surface has moved along
  CHECK_FALSE(goesThrough({{0, 0, 0}, {0, 0, 0.1}, {0, 0, 1}, {0, 0, 1}, 0.02}, landing));
}

TEST_CASE("inflow: a surface has stayed where it moved by less than a quarter of the flow's way across it",
          "[transport]") {
  Landing here;
  here.point.distance = 0.02;
  CHECK(hasStayed({{0, 0, 0}, {0, 0, 0.1}, {0, 0, 1}, {0, 0, 1}, 0.02}, here));
  CHECK_FALSE(hasStayed({{0, 0, 0}, {0, 0, 0.06}, {0, 0, 1}, {0, 0, 1}, 0.02}, here));
  CHECK_FALSE(hasStayed({{0, 0, 0}, {0.1, 0, 0.06}, {0, 0, 1}, {0, 0, 1}, 0.02}, here));
}
