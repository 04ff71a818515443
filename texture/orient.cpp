// Smooth unit tangent fields by diffusion: averages in polar maps as in [Kwatra07 sec. IV] and Zhang,
// Mischaikow, Turk: Vector Field Design on Surfaces (2004). At the coarsest level inverse iteration first
// goes for the smoothest field of all (Knoeppel et al.: Globally Optimal Direction Fields, 2013), set to unit
// length after each step (Viertel, Osting: An Approach to Quad Meshing Based on Harmonic Cross-Valued Maps,
// 2019): plain diffusion of a unit field holds on to pairs of opposite singularities, this lets them meet and
// vanish.
#include "texture/orient.h"

#include "texture/complex.h"
#include "texture/parallel.h"
#include "texture/point_grid.h"
#include "texture/random.h"
#include "texture/tangent.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::texture {
namespace {

// A direction that is not believed at all still starts with this length, so that it decides where nothing
// else does.
constexpr float kLeastLength = 0.01f;
// Steps of inverse iteration at the coarsest level.
constexpr int kSolves = 10;
// Plain sweeps between two normalisations at the coarsest level.
constexpr int kSweepsPerBurst = 10;
// Noise on the starting directions, relative to their length: a symmetric start may hold nothing of the
// smoothest field.
constexpr float kStartNoise = 1.0f;

// A tangent field in progress: at each vertex the vector length * (re d + im b), d = axes[v], b = d x n. The
// length says how much the direction is believed.
struct Field {
  std::vector<Vec3f> axes;
  std::vector<Complexf> values;
};

void normalise(std::vector<Complexf>& values) {
  forEachIndex(values.size(), [&](std::uint32_t v) {
    const float length = std::abs(values[v]);
    values[v] = length > 1e-30f ? values[v] / length : Complexf(1.0f, 0.0f);
  });
}

// The mean of the value at v and of what its neighbours predict for it.
Complexf average(const VertexGraph& graph, const Connection& connection, const std::vector<Complexf>& values,
                 std::uint32_t v) {
  const std::uint32_t begin = graph.first[v], end = graph.first[v + 1];
  Complexf sum = values[v];
  for (std::uint32_t h = begin; h < end; ++h)
    sum += product(connection.rotation[h], values[graph.neighbor[h]]);
  return sum / float(end - begin + 1);
}

// Jacobi sweeps: each value becomes the average, mixed with `pull` of the value 1 (the vertex's own axis)
// where given.
void diffuse(const VertexGraph& graph, const Connection& connection, int sweeps,
             const std::vector<float>& pull, std::vector<Complexf>& values) {
  std::vector<Complexf> next(values.size());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    forEachIndex(values.size(), [&](std::uint32_t v) {
      const Complexf mean = average(graph, connection, values, v);
      next[v] = pull.empty() ? mean : mean * (1.0f - pull[v]) + pull[v];
    });
    values.swap(next);
  }
}

double dot(const std::vector<Complexf>& a, const std::vector<Complexf>& b) {
  constexpr std::size_t kTermsAtOnce = 1024;
  return sumOf(
      a.size(),
      [&](std::uint32_t v) { return double(a[v].real()) * b[v].real() + double(a[v].imag()) * b[v].imag(); },
      kTermsAtOnce);
}

// values = L^-1 values, up to a factor, by conjugate gradients of so many sweeps at most. L is the
// connection's Laplacian, symmetric and positive; it is singular only where a parallel field exists, and then
// that field is what is looked for.
void invertLaplacian(const VertexGraph& graph, const Connection& connection, int sweeps,
                     std::vector<Complexf>& values) {
  constexpr float kShift = 1e-6f;  // relative to a vertex's own weight in L: keeps the singular case finite
  constexpr double kSmallResidual = 1e-4;  // relative; the next solve goes on from here
  const std::size_t count = values.size();
  const auto laplacian = [&](const std::vector<Complexf>& x, std::vector<Complexf>& out) {
    forEachIndex(count, [&](std::uint32_t v) {
      const std::uint32_t begin = graph.first[v], end = graph.first[v + 1];
      Complexf sum = float(end - begin) * (1.0f + kShift) * x[v];
      for (std::uint32_t h = begin; h < end; ++h)
        sum -= product(connection.rotation[h], x[graph.neighbor[h]]);
      out[v] = sum;
    });
  };
  std::vector<Complexf> x = values, residual(count), direction(count), image(count);
  laplacian(x, image);
  const double whole = dot(values, values), energy = dot(x, image);
  if (!(energy > 0.0)) return;
  const auto guess = float(whole / energy);  // the best multiple of the values themselves
  forEachIndex(count, [&](std::uint32_t v) {
    x[v] *= guess;
    residual[v] = values[v] - guess * image[v];
  });
  direction = residual;
  double size = dot(residual, residual);
  for (int sweep = 0; sweep < sweeps && size > kSmallResidual * kSmallResidual * whole; ++sweep) {
    laplacian(direction, image);
    const double curvature = dot(direction, image);
    if (!(curvature > 0.0)) break;
    const auto step = float(size / curvature);
    forEachIndex(count, [&](std::uint32_t v) {
      x[v] += step * direction[v];
      residual[v] -= step * image[v];
    });
    const double earlier = size;
    size = dot(residual, residual);
    const auto keep = float(size / earlier);
    forEachIndex(count, [&](std::uint32_t v) { direction[v] = residual[v] + keep * direction[v]; });
  }
  values.swap(x);
}

void writeOrientation(const Field& field, SurfaceMesh& mesh) {
  mesh.orientation.resize(mesh.positions.size());
  forEachIndex(mesh.positions.size(), [&](std::uint32_t v) {
    const Vec3f &d = field.axes[v], &n = mesh.normals[v];
    const Complexf& x = field.values[v];
    mesh.orientation[v] =
        tangentUnit((d * x.real() + rowAxis(d, n) * x.imag()) / std::max(std::abs(x), 1e-30f), n, d);
  });
}

// The field of one level as seen from the vertices of another: a mean over the near vertices whose normals
// agree, so that nothing passes through a thin sheet.
Field handOver(const SurfaceMesh& from, const SurfaceMesh& to) {
  constexpr float kAgreeingNormals = 0.3f;
  const double reach = 2.0 * std::max(from.spacing, to.spacing);
  const PointGrid grid(from.positions, reach);
  Field field{referenceVectors(to.normals), std::vector<Complexf>(to.positions.size())};
  const auto reach2 = float(reach * reach);
  forEachIndex(to.positions.size(), [&](std::uint32_t v) {
    const Vec3f &x = to.positions[v], &n = to.normals[v];
    Vec3f sum(0.0f);
    float weights = 0.0f;
    grid.visitNear(x, [&](std::uint32_t u) {
      const float distance2 = (from.positions[u] - x).lengthSqr(), agreement = n.dot(from.normals[u]);
      if (distance2 >= reach2 || agreement < kAgreeingNormals) return;
      const float weight = agreement * std::exp(-4.0f * distance2 / reach2);
      sum += turnedTangent(from.orientation[u], from.normals[u], n) * weight;
      weights += weight;
    });
    const float length = weights > 0.0f ? sum.length() / weights : 0.0f;
    if (length > 1e-3f) field.axes[v] = tangentUnit(sum, n, field.axes[v]);
    field.values[v] = std::max(length, kLeastLength);
  });
  return field;
}

void smooth(SurfaceMesh& mesh, Field field, int sweeps, const std::vector<float>& pull) {
  const VertexGraph graph = buildVertexGraph(mesh);
  const Connection connection = buildConnection(mesh, graph, field.axes);
  diffuse(graph, connection, sweeps, pull, field.values);
  writeOrientation(field, mesh);
}

// Four fifths of the sweeps look for the smoothest field; the others let it settle at unit length.
void orientCoarsest(SurfaceMesh& mesh, int sweeps) {
  const VertexGraph graph = buildVertexGraph(mesh);
  Field field{referenceVectors(mesh.normals), std::vector<Complexf>(mesh.positions.size())};
  const Connection connection = buildConnection(mesh, graph, field.axes);
  forEachIndex(field.values.size(), [&](std::uint32_t v) {
    const double re = 2.0 * randomUnit(0, 2ull * v) - 1.0, im = 2.0 * randomUnit(0, 2ull * v + 1) - 1.0;
    field.values[v] = Complexf(1.0f, 0.0f) + kStartNoise * Complexf(float(re), float(im));
  });
  const int plainSweeps = sweeps / 5;
  for (int solve = 0; solve < kSolves; ++solve) {
    normalise(field.values);
    invertLaplacian(graph, connection, (sweeps - plainSweeps) / kSolves, field.values);
  }
  for (int left = plainSweeps; left > 0; left -= kSweepsPerBurst) {
    normalise(field.values);
    diffuse(graph, connection, std::min(left, kSweepsPerBurst), {}, field.values);
  }
  writeOrientation(field, mesh);
}

// Starts from the carried vectors as axes, each as long as it is trusted: what is not trusted is overruled by
// what is.
void orientCarried(SurfaceMesh& mesh, const Carried& carried, const OrientOptions& options) {
  const std::size_t count = mesh.positions.size();
  Field field{referenceVectors(mesh.normals), std::vector<Complexf>(count)};
  std::vector<float> pull(count);
  forEachIndex(count, [&](std::uint32_t v) {
    const float trust = std::clamp(carried.trust[v], 0.0f, 1.0f);
    field.axes[v] = tangentUnit(carried.orientation[v], mesh.normals[v], field.axes[v]);
    field.values[v] = std::max(trust, kLeastLength);
    pull[v] = float(options.carriedWeight) * trust;
  });
  smooth(mesh, std::move(field), options.laterSweeps, pull);
}

}  // namespace

void orient(Surface& surface, const Carried& carried, const OrientOptions& options) {
  if (surface.empty()) return;
  auto& levels = surface.levels;
  if (!carried.empty()) {
    orientCarried(levels[0], carried, options);
    for (std::size_t level = 1; level < levels.size(); ++level) {
      writeOrientation(handOver(levels[level - 1], levels[level]), levels[level]);
    }
    return;
  }
  orientCoarsest(levels.back(), options.coarseSweeps);
  for (std::size_t level = levels.size() - 1; level-- > 0;) {
    smooth(levels[level], handOver(levels[level + 1], levels[level]), options.fineSweeps, {});
  }
}

std::vector<int> singularities(const SurfaceMesh& mesh) {
  const VertexGraph graph = buildVertexGraph(mesh);
  const Connection connection = buildConnection(mesh, graph, mesh.orientation);
  std::vector<int> indices(mesh.triangles.size());
  forEachIndex(mesh.triangles.size(), [&](std::uint32_t t) {
    // Against the field as axes, each edge's rotation is the turn of the field along it; what is left of
    // their sum once the curvature of the triangle is taken off is a number of full turns.
    Complexf around(1.0f, 0.0f);
    double turns = 0.0;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t from = mesh.triangles[t][i], to = mesh.triangles[t][(i + 1) % 3];
      // Read from the edge's end with the smaller index, so that both its triangles see the same half turn.
      const std::uint32_t low = std::min(from, to), high = std::max(from, to);
      std::uint32_t h = graph.first[low];
      while (graph.neighbor[h] != high) ++h;
      const Complexf rotation = low == to ? connection.rotation[h] : std::conj(connection.rotation[h]);
      const double turn = std::arg(connection.rotation[h]);
      turns += low == to ? turn : -turn;
      around = product(around, rotation);
    }
    indices[t] = int(std::lround((turns - std::arg(around)) / (2.0 * std::numbers::pi)));
  });
  return indices;
}

}  // namespace fluidtex::texture
