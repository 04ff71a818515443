// Polar maps after Zhang, Mischaikow, Turk: Vector Field Design on Surfaces (2004), and the connection that
// they induce (as in Knoeppel et al. 2013, sec. 3).
#include "texture/orientation/tangent.h"

#include "texture/loops/complex.h"
#include "texture/loops/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::texture {
namespace {

double angleBetween(const openvdb::Vec3d& a, const openvdb::Vec3d& b) {
  return std::atan2(a.cross(b).length(), a.dot(b));
}

using Complexd = std::complex<double>;

// Workspace of polarDirections().
struct Fan {
  std::vector<openvdb::Vec3d> edges;
  std::vector<double> angles;  // from each edge to the next one around
};

// Unit directions of the edges around a vertex in its polar map. Angles between neighbouring edges are the
// face angles scaled to sum to 2 pi. The rotation of the whole fan against d is the one that fits the edges'
// projections on the tangent plane best; fitting all edges keeps the map stable when the mesh changes.
void polarDirections(const SurfaceMesh& mesh, std::uint32_t v, std::span<const std::uint32_t> ring,
                     const Vec3f& axis, Fan& fan, std::span<Complexf> directions) {
  const std::size_t count = ring.size();
  const openvdb::Vec3d origin(mesh.positions[v]), d(axis), b(rowAxis(axis, mesh.normals[v]));
  fan.edges.resize(count);
  fan.angles.resize(count);
  for (std::size_t i = 0; i < count; ++i) fan.edges[i] = openvdb::Vec3d(mesh.positions[ring[i]]) - origin;
  double theta = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    fan.angles[i] = angleBetween(fan.edges[i], fan.edges[(i + 1) % count]);
    theta += fan.angles[i];
  }
  if (!(theta > 0.0)) {  // degenerate triangles have no angles: spread the edges evenly
    std::fill(fan.angles.begin(), fan.angles.end(), 1.0);
    theta = double(count);
  }

  Complexd turn(0.0, 0.0);
  double angle = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const Complexd inMap = std::polar(1.0, -angle);  // counter-clockwise order: the angle in (d, b) falls
    const Complexd projected(fan.edges[i].dot(d), fan.edges[i].dot(b));
    turn += product(projected, std::conj(inMap)) / std::max(fan.edges[i].length(), 1e-300);
    directions[i] = Complexf(inMap);
    angle += fan.angles[i] * (2.0 * std::numbers::pi / theta);
  }
  const double size = std::abs(turn);
  const Complexd unitTurn = size > 0.0 ? turn / size : Complexd(1.0, 0.0);
  for (Complexf& direction : directions) direction = Complexf(product(unitTurn, Complexd(direction)));
}

}  // namespace

Vec3f nearestTurn(const Vec3f& x, const Vec3f& n, const Vec3f& to, int symmetry) {
  const Vec3f across = rowAxis(x, n);
  Vec3f best = x;
  for (int k = 1; k < symmetry; ++k) {
    const auto angle = static_cast<float>(2.0 * std::numbers::pi * k / symmetry);
    const Vec3f turned = x * std::cos(angle) + across * std::sin(angle);
    if (turned.dot(to) > best.dot(to)) best = turned;
  }
  return best;
}

Connection buildConnection(const SurfaceMesh& mesh, const VertexGraph& graph,
                           const std::vector<Vec3f>& axes) {
  const std::size_t vertexCount = mesh.positions.size(), edgeCount = graph.neighbor.size();
  Connection connection;
  connection.edge.resize(edgeCount);
  connection.rotation.resize(edgeCount);

  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, vertexCount, kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      Fan fan;
                      for (std::size_t i = range.begin(); i != range.end(); ++i) {
                        const auto v = std::uint32_t(i);
                        const std::span<Complexf> directions(connection.edge.data() + graph.first[v],
                                                             connection.edge.data() + graph.first[v + 1]);
                        polarDirections(mesh, v, graph.around(v), axes[v], fan, directions);
                      }
                    });

  forEachIndex(vertexCount, [&](std::uint32_t v) {
    for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h) {
      const std::uint32_t u = graph.neighbor[h];
      std::uint32_t back = graph.first[u];
      while (graph.neighbor[back] != v) ++back;
      // The edge is directions[h] in v's axes and -directions[back] in u's.
      const Complexd rotation =
          -product(Complexd(connection.edge[h]), std::conj(Complexd(connection.edge[back])));
      connection.rotation[h] = Complexf(rotation / std::abs(rotation));
    }
  });

  forEachIndex(vertexCount, [&](std::uint32_t v) {
    for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h) {
      const std::uint32_t u = graph.neighbor[h];
      const float length = (mesh.positions[u] - mesh.positions[v]).length();
      const double pixel = 0.5 * (mesh.spacingAt(v) + mesh.spacingAt(u));
      connection.edge[h] *= length * float(1.0 / pixel);
    }
  });
  return connection;
}

std::vector<Vec3f> referenceVectors(const std::vector<Vec3f>& normals) {
  // cos 25 degrees: the projection of the first axis is at least 0.42 long wherever it is used.
  constexpr float kNearlyNormal = 0.906f;
  std::vector<Vec3f> axes(normals.size());
  forEachIndex(normals.size(), [&](std::uint32_t v) {
    const Vec3f& n = normals[v];
    const Vec3f world = std::abs(n.x()) < kNearlyNormal ? Vec3f(1, 0, 0) : Vec3f(0, 1, 0);
    Vec3f axis = world - n * n.dot(world);
    axis.normalize();
    axes[v] = axis;
  });
  return axes;
}

}  // namespace fluidtex::texture
