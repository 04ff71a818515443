#include "transport/carry.h"

#include "tests/threads.h"
#include "tests/transport/textured_meshes.h"
#include "texture/shown/vector_maps.h"

#include <algorithm>
#include <cstring>

using namespace fluidtex;
using namespace fluidtex::testing;
using namespace fluidtex::transport;

TEST_CASE("carry: nothing moved, nothing changes", "[transport]") {
  const SurfaceMesh mesh = sphereMesh(16);
  const TexturedSurface previous = texturedMesh(mesh, constantDirection({0.3, 0.5, 0.8}));
  const Carried carried = carry(previous, sim::Frame{}, mesh);
  requireWhole(carried, mesh);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    REQUIRE(carried.coordinate[v] == previous.coordinate[v]);
    REQUIRE((carried.color[v] - previous.color[v]).length() < 1e-6f);
    REQUIRE((carried.orientation[v] - previous.orientation[v]).length() < 5e-6f);
    REQUIRE((carried.gradient[v].s - previous.gradient[v].s).length() < 1e-4f);
    REQUIRE(carried.age[v] == Approx(previous.age[v]));
    REQUIRE(trustBesidesStretch(carried, previous, v) == Approx(1.0f));
    REQUIRE(carried.previousPosition[v] == mesh.positions[v]);
  }
}

TEST_CASE("carry: a first frame gets an empty result", "[transport]") {
  CHECK(carry({}, sim::Frame{}, sphereMesh(2)).empty());
}

TEST_CASE("carry: a uniform stream takes everything with it onto another mesh", "[transport]") {
  const Vec3d shift(0.13, -0.07, 0.21);
  const sim::Frame frame = steadyFrame({0.1, -20, 20}, 0.1, 2, [&](const Vec3d&) { return shift / 0.1; });
  const SurfaceMesh before = sphereMesh(24), after = sphereMesh(19, 1.0, shift);
  const TexturedSurface previous = texturedMesh(before, constantDirection({0.3, 0.5, 0.8}));
  const Carried carried = carry(previous, frame, after);
  requireWhole(carried, after);
  std::vector<double> turns;
  for (std::size_t v = 0; v < after.positions.size(); ++v) {
    const Vec3f old = after.positions[v] - Vec3f(shift);
    REQUIRE((carried.previousPosition[v] - old).length() < 0.005f);  // chords of the coarser mesh
    // Texels: linear functions are carried without error but for the chord's height.
    REQUIRE((carried.coordinate[v] - Vec2f(old.x(), old.y()) * float(kTexelsPerMeter)).length() < 0.15f);
    REQUIRE(carried.color[v][0] == Approx(0.5 + 0.1 * old.x()).margin(1e-3));
    REQUIRE(carried.age[v] == Approx(2.0 + old.z()).margin(0.01));
    REQUIRE(trustBesidesStretch(carried, previous, v) > 0.98f);
    turns.push_back(angleBetween(Vec3d(projected(Vec3f(0.3f, 0.5f, 0.8f), after.normals[v])),
                                 Vec3d(carried.orientation[v])));
  }
  std::sort(turns.begin(), turns.end());
  CHECK(turns[turns.size() / 2] < 0.2 * kDegree);
  CHECK(turns[turns.size() * 95 / 100] < 1.0 * kDegree);
}

// Of one direction or normal all over the exemplar, where the surface looks about along `up`.
void requireTurned(texture::MapHolds holds, const Mat3d& f, const Mat3d& rate, double time) {
  const SurfaceMesh mesh = sphereMesh(24), next = mappedMesh(mesh, f);
  TexturedSurface before = texturedMesh(mesh, constantDirection({0.3, 0.5, 0.8}));
  before.exemplarWidth = before.exemplarHeight = 8;
  before.fading = texture::noFading(mesh.positions.size());
  texture::ExemplarMap map{{8, 8, 3, {}}, holds};
  for (int pixel = 0; pixel < 64; ++pixel) map.image.data.insert(map.image.data.end(), {0.8f, 0.6f, 0.85f});
  if (holds == texture::MapHolds::directions)
    for (std::size_t i = 2; i < map.image.data.size(); i += 3) map.image.data[i] = 0.5f;  // in the plane

  TexturedSurface after =
      continued(carry(before, steadyFrame({0.1, -24, 24}, time, 20, linearFlow(rate)), next), next);
  after.exemplarWidth = after.exemplarHeight = 8;
  texture::lookUpVectors("bump", map, true, before);
  texture::lookUpVectors("bump", map, true, after);
  int seen = 0;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (std::abs(mesh.normals[v].z()) < 0.5f) continue;  // the texture is stretched without end on the rim
    ++seen;
    const Vec3d turned = f * Vec3d(before.vectors.at("bump")[v]);
    REQUIRE(angleBetween(turned, Vec3d(after.vectors.at("bump")[v])) < 0.2 * kDegree);
  }
  CHECK(seen > 1000);
}

TEST_CASE("carry: vectors in maps of the exemplar turn with the flow", "[transport]") {
  const double angle = 1.1;
  const Vec3d axis = Vec3d(1, 2, 3).unit();
  const Mat3d turn = exponential(rotationAbout(axis, angle));
  requireTurned(texture::MapHolds::normals, turn, rotationAbout(axis, angle), 1.0);
  requireTurned(texture::MapHolds::directions, turn, rotationAbout(axis, angle), 1.0);
  const Mat3d strain(0.4, 0.0, 0.0, 0.0, -0.4, 0.0, 0.0, 0.0, 0.0);
  const Mat3d drawn(std::exp(0.4), 0.0, 0.0, 0.0, std::exp(-0.4), 0.0, 0.0, 0.0, 1.0);
  requireTurned(texture::MapHolds::directions, drawn, strain, 1.0);
}

TEST_CASE("carry: transparent colour does not bleed", "[transport]") {
  const SurfaceMesh mesh = sphereMesh(8), next = sphereMesh(11);
  TexturedSurface previous = texturedMesh(mesh, constantDirection({0, 0, 1}));
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    previous.color[v] = v % 2 ? Vec4f(0.8f, 0.2f, 0.1f, 1.0f) : Vec4f(0.0f, 9.0f, 9.0f, 0.0f);
  }
  const Carried carried = carry(previous, sim::Frame{}, next);
  int mixed = 0;
  for (const Vec4f& color : carried.color) {
    if (color[3] < 0.05f) continue;
    REQUIRE((color - Vec4f(0.8f, 0.2f, 0.1f, color[3])).length() < 1e-4f);
    mixed += color[3] < 0.95f;
  }
  CHECK(mixed > 100);
}

TEST_CASE("carry: points moved with the flow come home", "[transport]") {
  const Flow vortex = [](const Vec3d& x) {
    return Vec3d(-std::cos(x.x()) * std::sin(x.y()), std::sin(x.x()) * std::cos(x.y()), 0.1);
  };
  const sim::Frame frame = steadyFrame({0.1, -20, 20}, 0.4, 4, vortex);
  SurfaceMesh mesh = sphereMesh(20);
  const TexturedSurface previous = texturedMesh(mesh, constantDirection({0.3, 0.5, 0.8}));
  mesh.positions = moved(mesh.positions, frame);
  const Carried carried = carry(previous, frame, mesh);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    REQUIRE((carried.previousPosition[v] - previous.positions[v]).length() < 0.02f * 0.1f);
    REQUIRE((carried.coordinate[v] - previous.coordinate[v]).length() < 0.02f);
    REQUIRE((carried.color[v] - previous.color[v]).length() < 1e-3f);
  }
}

TEST_CASE("velocity and contact at positions", "[transport]") {
  sim::Frame frame = steadyFrame({0.1, -10, 10}, 1.0, 2, constantDirection({1, 2, 3}));
  frame.substeps.back() = substep({0.1, -10, 10}, 0.5, linearFlow(rotationAbout({0, 0, 1}, 2.0)));
  const std::vector<Vec3f> points{Vec3f(0.5f, 0.25f, 0.0f), Vec3f(7, 7, 7)};
  const std::vector<Vec3f> velocity = velocityAt(points, frame);
  CHECK((velocity[0] - Vec3f(-0.5f, 1.0f, 0.0f)).length() < 1e-5f);
  CHECK(velocity[1] == Vec3f(0.0f));
  CHECK(velocityAt(points, sim::Frame{})[0] == Vec3f(0.0f));

  CHECK(contactAt(points, frame) == std::vector<std::uint8_t>{0, 0});
  // A floor below z = 0, voxels of 0.1 m.
  auto solid = sim::FloatGrid::create(0.3f);
  solid->setTransform(openvdb::math::Transform::createLinearTransform(0.1));
  auto accessor = solid->getAccessor();
  for (int i = -20; i < 20; ++i) {
    for (int j = -20; j < 20; ++j) {
      for (int k = -3; k <= 3; ++k) accessor.setValue({i, j, k}, 0.1f * float(k));
    }
  }
  frame.solidPhi = solid;
  const std::vector<Vec3f> above{Vec3f(0.3f, 0.2f, 0.04f), Vec3f(0.3f, 0.2f, 0.06f), Vec3f(0, 0, -0.1f),
                                 Vec3f(0, 0, 5)};
  CHECK(contactAt(above, frame) == std::vector<std::uint8_t>{1, 0, 1, 0});
}

TEST_CASE("carry: the same bytes on any number of threads", "[transport]") {
  const sim::Frame frame = steadyFrame({0.1, -14, 14}, 0.3, 3, linearFlow(rotationAbout({1, 1, 0}, 0.7)));
  const TexturedSurface previous = texturedMesh(sphereMesh(24), constantDirection({0.3, 0.5, 0.8}));
  const SurfaceMesh next = sphereMesh(21);
  const auto run = [&](int threads) {
    return onThreads(threads, [&] { return carry(previous, frame, next); });
  };
  const Carried one = run(1), four = run(4);
  const auto same = [](const auto& a, const auto& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
  };
  CHECK(same(one.orientation, four.orientation));
  CHECK(same(one.color, four.color));
  CHECK(same(one.coordinate, four.coordinate));
  CHECK(same(one.gradient, four.gradient));
  CHECK(same(one.trust, four.trust));
  CHECK(same(one.previousPosition, four.previousPosition));
}

TEST_CASE("carry: surfaces whose arrays do not fit are refused", "[transport]") {
  const SurfaceMesh mesh = sphereMesh(4);
  const TexturedSurface good = texturedMesh(mesh, constantDirection({0.3, 0.5, 0.8}));
  const auto refused = [&](auto change) {
    TexturedSurface bad = good;
    change(bad);
    CHECK_THROWS_AS(carry(bad, {}, mesh), std::invalid_argument);
  };
  refused([](TexturedSurface& s) { s.color.pop_back(); });
  refused([](TexturedSurface& s) { s.coordinate.clear(); });
  refused([](TexturedSurface& s) { s.gradient.pop_back(); });
  refused([](TexturedSurface& s) { s.fading.weight.clear(); });
  refused([](TexturedSurface& s) { s.age.emplace_back(); });
  refused([](TexturedSurface& s) { s.foam = {0.5f}; });
  refused([](TexturedSurface& s) { s.triangles[0][1] = 1u << 30; });
  SurfaceMesh bare = mesh;
  bare.normals.clear();
  CHECK_THROWS_AS(carry(good, {}, bare), std::invalid_argument);
  CHECK_THROWS_AS(carry(good, {}, mesh, 0), std::invalid_argument);
}
