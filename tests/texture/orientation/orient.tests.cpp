#include "texture/orientation/orient.h"

#include "tests/texture/orientation/orientation_fields.h"
#include "tests/threads.h"
#include "texture/orientation/tangent.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstring>
#include <functional>
#include <numeric>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

// Angles between each vertex's field and what its neighbours predict, radians.
std::vector<double> neighborAngles(const SurfaceMesh& mesh) {
  const VertexGraph graph = buildVertexGraph(mesh);
  const Connection connection = buildConnection(mesh, graph, mesh.orientation);
  std::vector<double> angles;
  for (const Complexf& rotation : connection.rotation) angles.push_back(std::abs(double(std::arg(rotation))));
  return angles;
}

double share(const std::vector<double>& values, double below) {
  return double(std::count_if(values.begin(), values.end(), [&](double x) { return x < below; })) /
         values.size();
}

void requireUnitTangent(const SurfaceMesh& mesh) {
  REQUIRE(mesh.orientation.size() == mesh.positions.size());
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    REQUIRE(mesh.orientation[v].length() == Approx(1.0).epsilon(1e-5));
    REQUIRE(std::abs(mesh.orientation[v].dot(mesh.normals[v])) < 1e-5f);
  }
}

int count(const std::vector<Singularity>& all, int turns) {
  return int(std::count_if(all.begin(), all.end(), [&](const Singularity& s) { return s.turns == turns; }));
}

// A unit tangent field of world-space direction x.
void setField(SurfaceMesh& mesh, const std::function<Vec3f(const Vec3f&)>& x) {
  mesh.orientation.clear();
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    const Vec3f &n = mesh.normals[v], field = x(mesh.positions[v]);
    Vec3f d = field - n * n.dot(field);
    d.normalize();
    mesh.orientation.push_back(d);
  }
}

}  // namespace

TEST_CASE("singularities: indices of known fields", "[texture]") {
  SECTION("around an axis: one full turn at each pole of a sphere") {
    SurfaceMesh mesh = sphereMesh(9);
    const Vec3f axis = Vec3f(0.31f, 0.52f, 0.8f).unit();
    setField(mesh, [&](const Vec3f& x) { return axis.cross(x); });
    const std::vector<Singularity> found = singularities(mesh);
    CHECK(found.size() == 2);
    for (const Singularity& s : found) {
      CHECK(s.turns == 1);
      CHECK(std::abs(s.position.dot(axis)) > 0.97f);
    }
  }
  SECTION("around the axis of a torus: none") {
    SurfaceMesh mesh = torusMesh(40, 24);
    setField(mesh, [](const Vec3f& x) { return Vec3f(-x.y(), x.x(), 0.0f); });
    CHECK(singularities(mesh).empty());
  }
  SECTION("one direction, projected on a torus: two of each sign") {
    SurfaceMesh mesh = torusMesh(61, 37);
    setField(mesh, [](const Vec3f&) { return Vec3f(0.8f, 0.36f, 0.48f); });
    const std::vector<Singularity> found = singularities(mesh);
    CHECK(found.size() == 4);
    CHECK(count(found, 1) == 2);
    CHECK(count(found, -1) == 2);
  }
}

TEST_CASE("orientation: unit, tangent and smooth on every level of a sphere", "[texture]") {
  Surface surface = sphereLevels();
  orient(surface, {});
  for (const SurfaceMesh& mesh : surface.levels) {
    requireUnitTangent(mesh);
    const std::vector<Singularity> found = singularities(mesh);
    CHECK(sumOfTurns(found) == 2);
    CHECK(found.size() == 2);
  }
  // No smoother field exists than one that turns about an axis; its median turn along an edge is near 0.4
  // edge lengths.
  const std::vector<double> angles = neighborAngles(surface.levels[0]);
  CHECK(share(angles, 3.0 * kDegree) > 0.75);
  CHECK(share(angles, 20.0 * kDegree) > 0.985);
}

TEST_CASE("orientation: of fields that are as smooth the scene's seed chooses one", "[texture]") {
  Surface first = sphereLevels(), same = sphereLevels(), other = sphereLevels();
  orient(first, {}, {.seed = 1});
  orient(same, {}, {.seed = 1});
  orient(other, {}, {.seed = 2});
  CHECK(first.levels[0].orientation == same.levels[0].orientation);
  CHECK(first.levels[0].orientation != other.levels[0].orientation);
}

TEST_CASE("orientation: a torus ends without singularities", "[texture]") {
  Surface surface;
  for (const int k : {4, 2, 1}) surface.levels.push_back(torusMesh(24 * k, 12 * k));
  orient(surface, {});
  for (const SurfaceMesh& mesh : surface.levels) {
    requireUnitTangent(mesh);
    CHECK(singularities(mesh).empty());
  }
}

TEST_CASE("orientation: as smooth as the smoothest field known in closed form", "[texture]") {
  // Around an axis on a sphere; and around the axis of a torus.
  const auto energy = [](const SurfaceMesh& mesh) {
    double sum = 0.0;
    for (const double angle : neighborAngles(mesh)) sum += angle * angle;
    return sum;
  };
  const auto round = [](const Vec3f& x) { return Vec3f(-x.y(), x.x(), 0.0f); };
  for (const SurfaceMesh& mesh : {sphereMesh(12), sphereMesh(20), torusMesh(60, 30)}) {
    Surface surface = levelsOf({mesh}), known = surface;
    orient(surface, {});
    setField(known.levels[0], round);
    CHECK(energy(surface.levels[0]) < 1.02 * energy(known.levels[0]));
  }
}

TEST_CASE("orientation: a carried field that is smooth hardly changes, frame after frame", "[texture]") {
  Surface surface = sphereLevels();
  orient(surface, {});
  surface.levels.resize(1);
  SurfaceMesh& mesh = surface.levels[0];
  SECTION("one that diffusion made") {}
  SECTION("one that it would not choose: a spiral about an axis") {
    setField(mesh, [](const Vec3f& x) {
      const Vec3f axis(0.3f, 0.2f, 0.93f);
      return axis.cross(x) + 0.7f * x.cross(axis.cross(x));
    });
  }
  const std::vector<Vec3f> start = mesh.orientation;
  const auto changes = [&](const std::vector<Vec3f>& from) {
    std::vector<double> all;
    for (std::size_t v = 0; v < from.size(); ++v) all.push_back(angleBetween(from[v], mesh.orientation[v]));
    return all;
  };
  orient(surface, carriedFrom(mesh));
  const std::vector<double> once = changes(start);
  CHECK(std::accumulate(once.begin(), once.end(), 0.0) / once.size() < 0.1 * kDegree);
  CHECK(share(once, 0.5 * kDegree) > 0.98);
  for (int frame = 1; frame < 10; ++frame) orient(surface, carriedFrom(mesh));
  CHECK(share(changes(start), 3.0 * kDegree) > 0.98);
}

TEST_CASE("orientation: opposite singularities near each other meet, and what is far from them stays",
          "[texture]") {
  Surface surface = levelsOf({sphereMesh(40)});
  SurfaceMesh& mesh = surface.levels[0];
  for (const double spacings : {4.3, 6.7}) {
    // Around an axis, and on one side turned by the difference of the angles seen from two points.
    const double halfLength = 0.5 * spacings * mesh.spacing;
    const auto set = [&](bool pair) {
      setField(mesh, [&](const Vec3f& x) {
        const Vec3f around = Vec3f(-x.y(), x.x(), 1e-4f).unit();
        if (!pair || x.x() < 0.0f) return around;
        const double y = x.y() - 0.003, z = x.z() - 0.004;
        const auto angle = static_cast<float>(std::atan2(z, y - halfLength) - std::atan2(z, y + halfLength));
        return around * std::cos(angle) + x.cross(around) * std::sin(angle);
      });
      return singularities(mesh).size();
    };
    REQUIRE(set(false) == 2);
    REQUIRE(set(true) == 4);
    const std::vector<Vec3f> start = mesh.orientation;
    for (int frame = 0; frame < 2; ++frame) orient(surface, carriedFrom(mesh));
    CHECK(singularities(mesh).size() == 2);
    for (std::size_t v = 0; v < start.size(); ++v) {
      const bool far = mesh.positions[v].x() < 0.9f && std::abs(mesh.positions[v].z()) < 0.9f &&
                       std::abs(mesh.positions[v].x()) > 0.1f;
      if (far) REQUIRE(angleBetween(mesh.orientation[v], start[v]) < 2.0 * kDegree);
    }
  }
}

TEST_CASE("orientation: noise that was carried is smoothed away", "[texture]") {
  Surface surface = sphereLevels();
  orient(surface, {});
  surface.levels.resize(1);
  SurfaceMesh& mesh = surface.levels[0];
  const std::vector<Vec3f> clean = mesh.orientation;
  Carried carried = carriedFrom(mesh);
  const auto noise = [](std::size_t v) { return float(0.5 * std::sin(12.9898 * double(v * v % 1009))); };
  for (std::size_t v = 0; v < clean.size(); ++v) {
    carried.orientation[v] += rowAxis(clean[v], mesh.normals[v]) * noise(v);
    carried.orientation[v].normalize();
  }
  double before = 0.0, after = 0.0;
  for (std::size_t v = 0; v < clean.size(); ++v) before += angleBetween(clean[v], carried.orientation[v]);
  for (int frame = 0; frame < 5; ++frame) {
    orient(surface, carried);
    carried = carriedFrom(mesh);
  }
  for (std::size_t v = 0; v < clean.size(); ++v) after += angleBetween(clean[v], mesh.orientation[v]);
  CHECK(after < 0.25 * before);
}

TEST_CASE("orientation: what is not trusted follows what is", "[texture]") {
  SurfaceMesh mesh = torusMesh(60, 30);
  setField(mesh, [](const Vec3f& x) { return Vec3f(-x.y(), x.x(), 0.0f); });
  Carried carried = carriedFrom(mesh);
  const std::vector<Vec3f> right = mesh.orientation;
  // A strip two vertices wide holds nonsense.
  std::vector<std::size_t> strip;
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    if (v / 30 != 10 && v / 30 != 11) continue;
    strip.push_back(v);
    carried.orientation[v] = -carried.orientation[v];
    carried.trust[v] = 0.0f;
  }
  Surface surface = levelsOf({std::move(mesh)});
  orient(surface, carried);
  for (const std::size_t v : strip)
    CHECK(angleBetween(surface.levels[0].orientation[v], right[v]) < 2.0 * kDegree);
}

TEST_CASE("orientation: carried vectors that are not tangent or null are made usable", "[texture]") {
  Surface surface = levelsOf({sphereMesh(10)});
  orient(surface, {});
  Carried carried = carriedFrom(surface.levels[0]);
  carried.orientation[7] = Vec3f(0.0f);
  carried.orientation[8] = surface.levels[0].normals[8];
  carried.orientation[9] = carried.orientation[9] * 3.0f + surface.levels[0].normals[9];
  orient(surface, carried);
  requireUnitTangent(surface.levels[0]);
}

TEST_CASE("orientation: turns with the surface", "[texture]") {
  // A turned mesh with turned carried vectors gets the turned field.
  const SurfaceMesh mesh = torusMesh(30, 16);
  const Vec3f axis = Vec3f(1, 2, 2) / 3.0f;
  const float angle = 0.9f;
  const auto turn = [&](const Vec3f& x) {
    return x * std::cos(angle) + axis.cross(x) * std::sin(angle) +
           axis * (axis.dot(x) * (1 - std::cos(angle)));
  };
  Surface still = levelsOf({mesh});
  setField(still.levels[0], [](const Vec3f& x) { return Vec3f(0.3f + x.z(), x.x(), 0.5f); });
  const Carried carried = carriedFrom(still.levels[0], 0.6f);
  Surface turned = still;
  Carried carriedTurned = carried;
  for (Vec3f& x : turned.levels[0].positions) x = turn(x);
  for (Vec3f& x : turned.levels[0].normals) x = turn(x);
  for (Vec3f& x : carriedTurned.orientation) x = turn(x);
  orient(still, carried);
  orient(turned, carriedTurned);
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    REQUIRE((turn(still.levels[0].orientation[v]) - turned.levels[0].orientation[v]).length() < 1e-4f);
  }
}

TEST_CASE("orientation: every level is filled on later frames too, and no surface is no error", "[texture]") {
  Surface surface = sphereLevels();
  orient(surface, {});
  const Carried carried = carriedFrom(surface.levels[0]);
  for (SurfaceMesh& mesh : surface.levels) mesh.orientation.clear();
  orient(surface, carried);
  for (const SurfaceMesh& mesh : surface.levels) requireUnitTangent(mesh);
  Surface none;
  orient(none, {});
  CHECK(none.empty());
}

TEST_CASE("orientation: handed on at each side of a thin sheet by itself", "[texture]") {
  // A shell thinner than the spacing: the fields of its two sides know nothing of each other.
  const auto shell = [](int subdivisions) {
    SurfaceMesh mesh = sphereMesh(subdivisions), inside = sphereMesh(subdivisions, 0.98);
    const auto offset = std::uint32_t(mesh.positions.size());
    for (const Vec3I& t : inside.triangles) mesh.triangles.push_back(Vec3I(t[0], t[2], t[1]) + Vec3I(offset));
    for (const Vec3f& n : inside.normals) mesh.normals.push_back(-n);
    mesh.positions.insert(mesh.positions.end(), inside.positions.begin(), inside.positions.end());
    setSpacing(mesh);
    return mesh;
  };
  Surface surface;
  for (const int subdivisions : {16, 8}) surface.levels.push_back(shell(subdivisions));
  // Around z outside, around x inside.
  SurfaceMesh& fine = surface.levels[0];
  setField(fine, [](const Vec3f& x) {
    return x.length() > 0.99f ? Vec3f(-x.y(), x.x(), 0.01f) : Vec3f(0.01f, -x.z(), x.y());
  });
  orient(surface, carriedFrom(fine), {.carriedWeight = 1.0});
  SurfaceMesh coarse = surface.levels[1];
  const std::vector<Vec3f> handedOn = coarse.orientation;
  setField(coarse, [](const Vec3f& x) {
    return x.length() > 0.99f ? Vec3f(-x.y(), x.x(), 0.01f) : Vec3f(0.01f, -x.z(), x.y());
  });
  std::vector<double> errors;
  for (std::size_t v = 0; v < handedOn.size(); ++v) {
    errors.push_back(angleBetween(handedOn[v], coarse.orientation[v]));
  }
  CHECK(share(errors, 2.0 * kDegree) > 0.9);
}

TEST_CASE("orientation: the same bytes on any number of threads", "[texture]") {
  const auto run = [](int threads) {
    return onThreads(threads, [&] {
      Surface surface = sphereLevels();
      orient(surface, {});
      const Carried carried = carriedFrom(surface.levels[0], 0.5f);
      orient(surface, carried);
      return surface.levels[0].orientation;
    });
  };
  const std::vector<Vec3f> one = run(1), four = run(4);
  REQUIRE(one.size() == four.size());
  CHECK(std::memcmp(one.data(), four.data(), one.size() * sizeof(Vec3f)) == 0);
}

TEST_CASE("orientation: arrays that do not fit, and no symmetry, are refused", "[texture]") {
  Surface surface = levelsOf({sphereMesh(4)});
  orient(surface, {});
  const std::size_t count = surface.levels[0].positions.size();
  Carried carried;
  carried.previousPosition = surface.levels[0].positions;
  carried.orientation = surface.levels[0].orientation;
  carried.trust.assign(count - 1, 1.0f);
  CHECK_THROWS_AS(orient(surface, carried), std::invalid_argument);
  carried.trust.assign(count, 1.0f);
  CHECK_NOTHROW(orient(surface, carried));
  carried.orientation.pop_back();
  CHECK_THROWS_AS(orient(surface, carried), std::invalid_argument);
  CHECK_THROWS_AS(orient(surface, {}, {.symmetry = 0}), std::invalid_argument);
  surface.levels[0].normals.pop_back();
  CHECK_THROWS_AS(orient(surface, {}), std::invalid_argument);
}
