#include "texture/orientation/tangent_field.h"

#include "numerics/random.h"
#include "tests/texture/orientation/oriented_mesh.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using fluidtex::randomUnit;

namespace {

std::vector<Complexf> someValues(std::size_t count, std::uint64_t seed) {
  std::vector<Complexf> values;
  for (std::size_t v = 0; v < count; ++v)
    values.emplace_back(float(randomUnit(seed, 2 * v)) - 0.5f, float(randomUnit(seed, 2 * v + 1)) - 0.5f);
  return values;
}

std::vector<float> someWeights(std::size_t count, float least, std::uint64_t seed) {
  std::vector<float> weights;
  for (std::size_t v = 0; v < count; ++v) weights.push_back(least + float(randomUnit(seed, v)));
  return weights;
}

// A torus, a field on it, and the right side of which it is the solution.
struct Posed {
  OrientedMesh torus = orientedMesh(torusMesh(36, 18));
  std::vector<float> hold = someWeights(torus.mesh.positions.size(), 0.05f, 1);
  std::vector<float> stiffness;
  std::vector<Complexf> solution = someValues(hold.size(), 2), right;

  Posed(int symmetry, bool stiff) {
    if (stiff) stiffness = someWeights(hold.size(), 0.2f, 3);
    for (std::uint32_t v = 0; v < hold.size(); ++v) {
      std::complex<double> sum = double(hold[v]) * std::complex<double>(solution[v]);
      for (std::uint32_t h = torus.graph.first[v]; h < torus.graph.first[v + 1]; ++h) {
        const std::uint32_t u = torus.graph.neighbor[h];
        const double weight = stiff ? 0.5 * double(stiffness[v] + stiffness[u]) : 1.0;
        const std::complex<double> turn =
            std::pow(std::complex<double>(torus.connection.rotation[h]), symmetry);
        sum += weight * (std::complex<double>(solution[v]) - turn * std::complex<double>(solution[u]));
      }
      right.emplace_back(sum);
    }
  }
  std::vector<Complexf> solved(int symmetry, int steps, std::vector<Complexf> values) const {
    solveField(fieldGraph(torus.graph, torus.connection, symmetry, stiffness), hold, right, steps, 1e-6,
               values);
    return values;
  }
};

float farthest(const std::vector<Complexf>& a, const std::vector<Complexf>& b) {
  REQUIRE(a.size() == b.size());
  float most = 0.0f;
  for (std::size_t v = 0; v < a.size(); ++v) most = std::max(most, std::abs(a[v] - b[v]));
  return most;
}

}  // namespace

TEST_CASE("tangent field: powers turn by as many times the angle", "[texture]") {
  const Complexf z = std::polar(1.1f, 0.3f);
  CHECK(power(z, 1) == z);
  for (const int n : {2, 3, 4})
    CHECK(std::abs(power(z, n) - std::polar(std::pow(1.1f, float(n)), 0.3f * float(n))) < 1e-5f);
}

TEST_CASE("tangent field: the solution is found, with any symmetry and stiffness", "[texture]") {
  const int symmetry = GENERATE(1, 2, 4);
  const bool stiff = GENERATE(false, true);
  const Posed posed(symmetry, stiff);
  const std::vector<Complexf> zeros(posed.hold.size(), Complexf(0.0f));
  CHECK(farthest(posed.solved(symmetry, 500, zeros), posed.solution) < 1e-3f);
  // Also from elsewhere.
  CHECK(farthest(posed.solved(symmetry, 500, someValues(zeros.size(), 8)), posed.solution) < 1e-3f);
}

TEST_CASE("tangent field: the solver takes no more steps than it may, each of which leads nearer",
          "[texture]") {
  const Posed posed(2, true);
  const std::vector<Complexf> start = someValues(posed.hold.size(), 8);
  CHECK(posed.solved(2, 0, start) == start);
  // In the norm of the matrix, the error of conjugate gradients never rises.
  const auto error = [&](const std::vector<Complexf>& values) {
    double sum = 0.0;
    for (std::uint32_t v = 0; v < values.size(); ++v) {
      const Complexf off = values[v] - posed.solution[v];
      sum += double(posed.hold[v]) * double(std::norm(off));
      for (std::uint32_t h = posed.torus.graph.first[v]; h < posed.torus.graph.first[v + 1]; ++h) {
        const std::uint32_t u = posed.torus.graph.neighbor[h];
        const Complexf turn = posed.torus.connection.rotation[h] * posed.torus.connection.rotation[h];
        const Complexf there = values[u] - posed.solution[u];
        sum += 0.25 * double(posed.stiffness[v] + posed.stiffness[u]) * double(std::norm(off - turn * there));
      }
    }
    return sum;
  };
  double last = error(start);
  for (const int steps : {1, 2, 3, 4, 6, 8, 12}) {
    const double now = error(posed.solved(2, steps, start));
    CHECK(now < last);
    last = now;
  }
  // What is solved is left as it is.
  CHECK(farthest(posed.solved(2, 100, posed.solution), posed.solution) < 1e-5f);
}

TEST_CASE("tangent field: what is held firmly stays", "[texture]") {
  Posed posed(4, false);
  for (std::size_t v = 0; v < posed.hold.size(); ++v) {
    posed.hold[v] = 1e7f;
    posed.right[v] = posed.solution[v] * 1e7f;
  }
  const std::vector<Complexf> zeros(posed.hold.size(), Complexf(0.0f));
  CHECK(farthest(posed.solved(4, 100, zeros), posed.solution) < 1e-5f);
}

TEST_CASE("tangent field: the same solution on one thread and on two", "[texture]") {
  const Posed posed(1, true);
  const std::vector<Complexf> start = someValues(posed.hold.size(), 5);
  const auto on = [&](int threads) { return onThreads(threads, [&] { return posed.solved(1, 30, start); }); };
  CHECK(on(1) == on(2));
}

TEST_CASE("tangent field: one direction in a plane is its own average, any of its equals too", "[texture]") {
  const int symmetry = GENERATE(1, 2, 4);
  OrientedMesh box = flatBox(8);
  const auto flat = [&](std::uint32_t v) { return box.mesh.normals[v].z() > 0.999f; };
  for (std::uint32_t v = 0; v < box.mesh.positions.size(); ++v)
    if (flat(v)) box.mesh.orientation[v] = Vec3f(std::cos(0.7f * float(v)), std::sin(0.7f * float(v)), 0.0f);
  box = orientedMesh(box.mesh);
  const FieldGraph field = fieldGraph(box.graph, box.connection, symmetry);
  const Vec3f wind(0.6f, 0.8f, 0.0f);
  std::vector<Complexf> values;
  for (std::uint32_t v = 0; v < box.mesh.positions.size(); ++v) {
    const Vec3f& d = box.mesh.orientation[v];
    const Vec3f b = rowAxis(d, box.mesh.normals[v]);
    // By some of its equal directions.
    const Complexf turn = std::polar(1.0f, 2.0f * float(std::numbers::pi) * float(v % 4) / float(symmetry));
    values.push_back(power(Complexf(wind.dot(d), wind.dot(b)) * turn, symmetry));
  }
  int inner = 0;
  for (std::uint32_t v = 0; v < values.size(); ++v) {
    bool all = flat(v);
    for (const std::uint32_t u : box.graph.around(v)) all = all && flat(u);
    if (!all) continue;
    ++inner;
    CHECK(std::abs(average(field, values, v) - values[v]) < 1e-4f);
  }
  CHECK(inner == 25);
}

TEST_CASE("tangent field: normalised, values keep their angle, and zeros become one", "[texture]") {
  std::vector<Complexf> values{{3.0f, 4.0f}, {0.0f, 0.0f}, {0.0f, -1e-20f}, {1e20f, 0.0f}};
  normalise(values);
  CHECK(std::abs(values[0] - Complexf(0.6f, 0.8f)) < 1e-6f);
  CHECK(values[1] == Complexf(1.0f, 0.0f));
  CHECK(std::abs(values[2] - Complexf(0.0f, -1.0f)) < 1e-6f);
  CHECK(std::abs(values[3] - Complexf(1.0f, 0.0f)) < 1e-6f);
}
