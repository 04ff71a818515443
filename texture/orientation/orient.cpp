// Smooth unit tangent fields in polar maps as in [Kwatra07 sec. IV] and Zhang, Mischaikow, Turk: Vector Field
// Design on Surfaces (2004); here by linear systems in the connection Laplacian, which reach further than
// sweeps. At the coarsest level, inverse iteration finds the globally smoothest field (Knoeppel et al.:
// Globally Optimal Direction Fields, 2013), set to unit length after each step (Viertel, Osting: An Approach
// to Quad Meshing Based on Harmonic Cross-Valued Maps, 2019). Plain diffusion of a unit field keeps pairs of
// opposite singularities; this lets them meet and cancel.
#include "texture/orientation/orient.h"

#include "numerics/random.h"
#include "texture/loops/complex.h"
#include "texture/loops/parallel.h"
#include "texture/loops/point_grid.h"
#include "texture/orientation/tangent_field.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <tuple>

namespace fluidtex::texture {
namespace {

// At the coarsest level: steps of inverse iteration, then of diffusion at unit length, each reaching as far
// as so many averages over neighbours.
constexpr int kSolves = 10, kBursts = 10, kSweepsPerBurst = 20;
// Loose, since each solve starts from the last.
constexpr double kTolerance = 1e-4;
constexpr int kDiffusionSteps = 100;
// Relative to a vertex's weight in the Laplacian: regularises the singular case.
constexpr float kShift = 1e-6f;
// Noise on the initial directions, relative to their length: a symmetric start may be orthogonal to the
// smoothest field.
constexpr float kStartNoise = 1.0f;
// Transported directions of no trust still decide where there are no others within some thirty vertices.
constexpr float kLeastHold = 1e-3f;

// A field as in tangent_field.h: complex values with respect to axes.
struct Field {
  std::vector<Vec3f> axes;
  std::vector<Complexf> values;
};

// Components of a vector, tangent at n, in the axes of d.
Complexf inAxes(const Vec3f& x, const Vec3f& d, const Vec3f& n) {
  return {x.dot(d), x.dot(rowAxis(d, n))};
}

Vec3f fromAxes(const Complexf& x, const Vec3f& d, const Vec3f& n) {
  return d * x.real() + rowAxis(d, n) * x.imag();
}

// Of the N directions that a value stands for, the nearest to the vertex's axis.
Complexf nearestRoot(const Complexf& value, int symmetry) {
  return std::polar(1.0f, std::arg(value) / float(symmetry));
}

void writeOrientation(const Field& field, int symmetry, SurfaceMesh& mesh) {
  mesh.orientation.resize(mesh.positions.size());
  forEachIndex(mesh.positions.size(), [&](std::uint32_t v) {
    const Vec3f &d = field.axes[v], &n = mesh.normals[v];
    mesh.orientation[v] = tangentUnit(fromAxes(nearestRoot(field.values[v], symmetry), d, n), n, d);
  });
}

// Soft constraint of a linear system in the Laplacian.
struct Held {
  std::vector<float> hold;
  std::vector<Complexf> right;  // hold * value
};

Held heldBy(std::size_t count) {
  return {std::vector<float>(count, 0.0f), std::vector<Complexf>(count)};
}

float degree(const VertexGraph& graph, std::uint32_t v) {
  return float(graph.first[v + 1] - graph.first[v]);
}

// Constraint to `values` that equals so many sweeps of averages: one implicit step of diffusion.
void holdToValues(const VertexGraph& graph, const std::vector<Complexf>& values, int sweeps, Held& held) {
  forEachIndex(values.size(), [&](std::uint32_t v) {
    const float weight = (degree(graph, v) + 1.0f) / float(sweeps);
    held.hold[v] += weight;
    held.right[v] += weight * values[v];
  });
}

// A wish evaluated on the mesh; empty without one.
template <class Value>
std::vector<Value> asked(const std::function<std::vector<Value>(const SurfaceMesh&)>& wish,
                         const SurfaceMesh& mesh) {
  if (!wish) return {};
  std::vector<Value> values = wish(mesh);
  if (values.size() != mesh.positions.size())
    throw std::invalid_argument("the field's wishes are not one a vertex");
  return values;
}

// share: number of level 0 vertices that a vertex of this mesh stands for. False if there are no wishes.
bool holdToWishes(const SurfaceMesh& mesh, const VertexGraph& graph, const std::vector<Vec3f>& axes,
                  const std::vector<Vec3f>& directions, double share, int symmetry, Held& held) {
  constexpr float kLeast = 1e-3f, kMost = 0.999f;
  std::vector<std::uint8_t> wished(directions.size(), 0);
  forEachIndex(directions.size(), [&](std::uint32_t v) {
    const Vec3f& n = mesh.normals[v];
    const Complexf x = inAxes(directions[v], axes[v], n);
    const float length = std::abs(x), strength = std::min(directions[v].length(), kMost);
    if (!(length > 0.0f) || !(strength > kLeast)) return;
    wished[v] = 1;
    const float weight = degree(graph, v) * strength / (1.0f - strength) * float(share);
    held.hold[v] += weight;
    held.right[v] += weight * power(x / length, symmetry);
  });
  return std::find(wished.begin(), wished.end(), 1) != wished.end();
}

double shareOf(const SurfaceMesh& mesh, const Surface& surface) {
  const double ratio = mesh.spacing / surface.levels[0].spacing;
  return ratio * ratio;
}

// Combing: of the N equal directions each vertex takes the nearest to the wish there, else to a neighbour's
// choice. Away from singularities the field is then continuous as a vector field too.
void comb(const SurfaceMesh& mesh, const VertexGraph& graph, const Connection& connection,
          const std::vector<Vec3f>& directions, int symmetry, Field& field) {
  constexpr float kSaysEnough = 0.1f;
  const std::size_t count = field.values.size();
  std::vector<Complexf> chosen(count);
  std::vector<std::uint8_t> known(count, 0);
  std::vector<std::uint32_t> queue;
  const auto choose = [&](std::uint32_t v, const Complexf& near) {
    // With `near` as the axis, the nearest root is the one nearest to it.
    const Complexf unit = near / std::abs(near);
    const Complexf value = product(field.values[v], std::conj(power(unit, symmetry)));
    chosen[v] = product(nearestRoot(value, symmetry), unit);
    known[v] = 1;
    queue.push_back(v);
  };
  for (std::uint32_t v = 0; v < directions.size(); ++v) {
    const Complexf x = inAxes(directions[v], field.axes[v], mesh.normals[v]);
    if (std::abs(x) > kSaysEnough) choose(v, x);
  }
  std::size_t next = 0;
  for (std::uint32_t first = 0; first < count; ++first) {
    if (!known[first] && next == queue.size()) choose(first, Complexf(1.0f, 0.0f));
    for (; next < queue.size(); ++next) {
      const std::uint32_t v = queue[next];
      for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h) {
        const std::uint32_t u = graph.neighbor[h];
        if (!known[u]) choose(u, conjugateProduct(connection.rotation[h], chosen[v]));
      }
    }
  }
  // Each vertex's axis becomes its direction, so that the nearest root is that direction.
  forEachIndex(count, [&](std::uint32_t v) {
    field.axes[v] =
        tangentUnit(fromAxes(chosen[v], field.axes[v], mesh.normals[v]), mesh.normals[v], field.axes[v]);
    field.values[v] = Complexf(1.0f, 0.0f);
  });
}

void orientCoarsest(Surface& surface, const OrientOptions& options, const OrientWishes& wishes) {
  SurfaceMesh& mesh = surface.levels.back();
  const std::size_t count = mesh.positions.size();
  const VertexGraph graph = buildVertexGraph(mesh);
  Field field{referenceVectors(mesh.normals), std::vector<Complexf>(count)};
  const Connection connection = buildConnection(mesh, graph, field.axes);
  const FieldGraph smooth = fieldGraph(graph, connection, options.symmetry, asked(wishes.stiffness, mesh));
  const std::uint64_t key = streamOf(options.seed, Stream::orientation);
  forEachIndex(count, [&](std::uint32_t v) {
    const double re = 2.0 * randomUnit(key, 2ull * v) - 1.0, im = 2.0 * randomUnit(key, 2ull * v + 1) - 1.0;
    field.values[v] = Complexf(1.0f, 0.0f) + kStartNoise * Complexf(float(re), float(im));
  });

  Held wished = heldBy(count);
  forEachIndex(count, [&](std::uint32_t v) { wished.hold[v] = kShift * degree(graph, v); });
  const std::vector<Vec3f> directions = asked(wishes.direction, mesh);
  if (holdToWishes(mesh, graph, field.axes, directions, shareOf(mesh, surface), options.symmetry, wished)) {
    solveField(smooth, wished.hold, wished.right, options.coarseSweeps, kTolerance, field.values);
  } else {
    for (int solve = 0; solve < kSolves; ++solve) {
      normalise(field.values);
      const std::vector<Complexf> right = field.values;
      solveField(smooth, wished.hold, right, options.coarseSweeps / kSolves, kTolerance, field.values);
    }
  }
  // Diffusion at unit length, since the linear systems above let the field be short near singularities.
  for (int burst = 0; burst < kBursts; ++burst) {
    normalise(field.values);
    Held held = wished;
    holdToValues(graph, field.values, kSweepsPerBurst, held);
    solveField(smooth, held.hold, held.right, kDiffusionSteps, kTolerance, field.values);
  }
  normalise(field.values);
  if (options.symmetry > 1) comb(mesh, graph, connection, directions, options.symmetry, field);
  writeOrientation(field, options.symmetry, mesh);
}

// Transfers the field of one level to the vertices of another: mean over near vertices whose normals agree,
// so that nothing passes through a thin sheet. The axes are those of the nearest one.
Field handOver(const SurfaceMesh& from, const SurfaceMesh& to, int symmetry) {
  constexpr float kAgreeingNormals = 0.3f;
  const double reachOfOne = 2.0 * std::max(from.spacing, to.spacing);  // where the scale is 1
  const double widest = to.scale.empty() ? 1.0 : double(*std::max_element(to.scale.begin(), to.scale.end()));
  const PointGrid grid(from.positions, reachOfOne * widest);
  Field field{referenceVectors(to.normals), std::vector<Complexf>(to.positions.size(), Complexf(1.0f, 0.0f))};
  forEachIndex(to.positions.size(), [&](std::uint32_t v) {
    const Vec3f &x = to.positions[v], &n = to.normals[v];
    const double reach = reachOfOne * to.spacingAt(v) / to.spacing;
    const auto reach2 = float(reach * reach);
    const auto visit = [&](const auto& use) {
      grid.visitNear(x, [&](std::uint32_t u) {
        const float distance2 = (from.positions[u] - x).lengthSqr(), agreement = n.dot(from.normals[u]);
        if (distance2 < reach2 && agreement >= kAgreeingNormals) use(u, distance2, agreement);
      });
    };
    float nearest = reach2;
    visit([&](std::uint32_t u, float distance2, float) {
      if (distance2 >= nearest) return;
      nearest = distance2;
      field.axes[v] = tangentUnit(turnedTangent(from.orientation[u], from.normals[u], n), n, field.axes[v]);
    });
    Complexf sum(0.0f, 0.0f);
    visit([&](std::uint32_t u, float distance2, float agreement) {
      const Complexf d = inAxes(turnedTangent(from.orientation[u], from.normals[u], n), field.axes[v], n);
      sum += agreement * std::exp(-4.0f * distance2 / reach2) * power(d, symmetry);
    });
    if (std::abs(sum) > 0.0f) field.values[v] = sum / std::abs(sum);
  });
  return field;
}

// Diffuses a field transferred from a coarser level.
void orientFiner(std::size_t level, Surface& surface, const OrientOptions& options,
                 const OrientWishes& wishes) {
  SurfaceMesh& mesh = surface.levels[level];
  Field field = handOver(surface.levels[level + 1], mesh, options.symmetry);
  if (options.fineSweeps > 0) {
    const VertexGraph graph = buildVertexGraph(mesh);
    const Connection connection = buildConnection(mesh, graph, field.axes);
    const FieldGraph smooth = fieldGraph(graph, connection, options.symmetry, asked(wishes.stiffness, mesh));
    Held held = heldBy(mesh.positions.size());
    holdToValues(graph, field.values, options.fineSweeps, held);
    holdToWishes(mesh, graph, field.axes, asked(wishes.direction, mesh), shareOf(mesh, surface),
                 options.symmetry, held);
    solveField(smooth, held.hold, held.right, kDiffusionSteps, kTolerance, field.values);
  }
  writeOrientation(field, options.symmetry, mesh);
}

// Releases the constraint around pairs of opposite singularities close to each other, so that they cancel;
// otherwise they would stay as long as the texture does.
void freePairs(const SurfaceMesh& mesh, const std::vector<Singularity>& all, Held& held) {
  constexpr float kNear = 8.0f;    // spacings
  constexpr float kBeyond = 2.0f;  // spacings beyond their distance, around their midpoint
  constexpr float kLeft = 0.02f;   // on the constraint
  struct Pair {
    float distance2;
    std::uint32_t a, b;
  };
  const auto nearest2 = static_cast<float>(kNear * kNear * mesh.spacing * mesh.spacing);
  std::vector<Pair> pairs;
  for (std::uint32_t a = 0; a < all.size(); ++a)
    for (std::uint32_t b = a + 1; b < all.size(); ++b) {
      const float distance2 = (all[a].position - all[b].position).lengthSqr();
      if (all[a].turns == -all[b].turns && distance2 < nearest2) pairs.push_back({distance2, a, b});
    }
  if (pairs.empty()) return;
  std::sort(pairs.begin(), pairs.end(), [](const Pair& x, const Pair& y) {
    return std::tuple(x.distance2, x.a, x.b) < std::tuple(y.distance2, y.a, y.b);
  });
  const PointGrid grid(mesh.positions, (kNear + kBeyond) * mesh.spacing);
  std::vector<std::uint8_t> taken(all.size(), 0);
  for (const Pair& pair : pairs) {
    if (taken[pair.a] || taken[pair.b]) continue;
    taken[pair.a] = taken[pair.b] = 1;
    const Vec3f middle = (all[pair.a].position + all[pair.b].position) * 0.5f;
    const float reach = std::sqrt(pair.distance2) + kBeyond * static_cast<float>(mesh.spacing);
    grid.visitNear(middle, [&](std::uint32_t v) {
      if ((mesh.positions[v] - middle).lengthSqr() > reach * reach) return;
      held.hold[v] *= kLeft;
      held.right[v] *= kLeft;
    });
  }
}

// Later frames: the transported vectors are the axes, and the constraint, weighted by trust.
void orientCarried(Surface& surface, const Carried& carried, const OrientOptions& options,
                   const OrientWishes& wishes) {
  constexpr float kMost = 0.999f;
  SurfaceMesh& mesh = surface.levels[0];
  const std::size_t count = mesh.positions.size();
  Field field{referenceVectors(mesh.normals), std::vector<Complexf>(count, Complexf(1.0f, 0.0f))};
  forEachIndex(count, [&](std::uint32_t v) {
    field.axes[v] = tangentUnit(carried.orientation[v], mesh.normals[v], field.axes[v]);
  });
  const VertexGraph graph = buildVertexGraph(mesh);
  const Connection connection = buildConnection(mesh, graph, field.axes);
  const FieldGraph smooth = fieldGraph(graph, connection, options.symmetry, asked(wishes.stiffness, mesh));
  Held held = heldBy(count);
  forEachIndex(count, [&](std::uint32_t v) {
    const float trust = std::clamp(carried.trust[v], 0.0f, 1.0f);
    const float share = std::clamp(float(options.carriedWeight) * trust, kLeastHold, kMost);
    // Where turning costs more, transported directions count less: a singularity that came in moves on.
    const float stiffness = smooth.stiffness.empty() ? 1.0f : std::max(1.0f, smooth.stiffness[v]);
    held.hold[v] = degree(graph, v) * share / ((1.0f - share) * stiffness);
    held.right[v] = held.hold[v];
  });
  freePairs(mesh, singularities(mesh, graph, connection, options.symmetry), held);
  holdToWishes(mesh, graph, field.axes, asked(wishes.direction, mesh), 1.0, options.symmetry, held);
  solveField(smooth, held.hold, held.right, kDiffusionSteps, kTolerance, field.values);
  writeOrientation(field, options.symmetry, mesh);
}

}  // namespace

void orient(Surface& surface, const Carried& carried, const OrientOptions& options,
            const OrientWishes& wishes) {
  if (surface.empty()) return;
  auto& levels = surface.levels;
  if (options.symmetry < 1) throw std::invalid_argument("orient: the symmetry must be 1 or more");
  for (const SurfaceMesh& mesh : levels) {
    if (mesh.normals.size() != mesh.positions.size())
      throw std::invalid_argument("orient: a mesh must have one normal per vertex");
  }
  if (!carried.empty()) {
    const std::size_t count = levels[0].positions.size();
    if (carried.orientation.size() != count || carried.trust.size() != count)
      throw std::invalid_argument("orient: carried arrays must have one entry per vertex");
    orientCarried(surface, carried, options, wishes);
    for (std::size_t level = 1; level < levels.size(); ++level) {
      writeOrientation(handOver(levels[level - 1], levels[level], options.symmetry), options.symmetry,
                       levels[level]);
    }
    return;
  }
  orientCoarsest(surface, options, wishes);
  for (std::size_t level = levels.size() - 1; level-- > 0;) orientFiner(level, surface, options, wishes);
}

}  // namespace fluidtex::texture
