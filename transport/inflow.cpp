#include "transport/inflow.h"

#include "texture/joints/places.h"
#include "texture/labels/fresh.h"
#include "texture/labels/pieces.h"
#include "texture/loops/parallel.h"
#include "texture/mesh/vertex_graph.h"
#include "texture/orientation/tangent.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::transport {
namespace {

constexpr float kOpposite = -0.9f;  // normals between which there is no parallel transport
constexpr float kUpright = 0.35f;   // radians
constexpr double kBeyond = 0.25;    // over the spacing
constexpr double kUpstream = 0.7;   // cosine
constexpr int kRimRings = 4;
constexpr double kFarthest = 1.25;   // over the way moved
constexpr double kMostAcross = 0.5;  // sine of the angle between motion and surface: 30 degrees
constexpr double kInwards = -0.15;   // of the motion, at the landing, more than at the vertex
constexpr float kOtherFace = 0.5f;   // cosine between normals, 60 degrees
constexpr double kLeftBehind = 0.5;  // over the motion across the surface
constexpr double kStayed = 0.25;     // over the motion across the surface
constexpr double kMostInside =
    -0.25;  // over the distance, or the spacing: what lies deeper in the liquid was laid open

Vec3d planar(const Vec3d& x, const Vec3f& normal) {
  const Vec3d n(normal);
  return x - n * n.dot(x);
}

// x as at normal `from`, as it is at `to`.
TexelGradient turned(const TexelGradient& g, const Vec3f& from, const Vec3f& to) {
  if (from.dot(to) <= kOpposite) return g;
  return {texture::turnedTangent(g.s, from, to), texture::turnedTangent(g.t, from, to)};
}

// The gradient kept across `along` (unit, tangent), and made one texel per spacing along it, at a right angle
// to the other in the exemplar; mirrored as it is.
TexelGradient laidAlong(const TexelGradient& g, const Vec3f& along, const Vec3f& normal, double spacing) {
  const Vec3f across = normal.cross(along);
  const Vec2f kept(g.s.dot(across), g.t.dot(across)), now(g.s.dot(along), g.t.dot(along));
  const float length = kept.length();
  if (!(length > 0.0f)) return g;
  Vec2f fresh(kept[1], -kept[0]);
  fresh *= float(1.0 / spacing) / length;
  if (fresh.dot(now) < 0.0f) fresh = -fresh;
  return {across * kept[0] + along * fresh[0], across * kept[1] + along * fresh[1]};
}

Texel continuedTo(const texture::SurfaceMesh& mesh, const Texel& from, std::uint32_t u, std::uint32_t v) {
  const Vec3f edge = mesh.positions[v] - mesh.positions[u];
  const TexelGradient g = turned(from.gradient, mesh.normals[u], mesh.normals[v]);
  // The edge lies half in each plane.
  const Vec2f step(0.5f * (from.gradient.s + g.s).dot(edge), 0.5f * (from.gradient.t + g.t).dot(edge));
  return {from.coordinate + step, g};
}

void drawOutAt(const texture::SurfaceMesh& mesh, std::uint32_t u, std::uint32_t v, const Vec3f& way,
               texture::Carried& carried) {
  const Texel texel = continuedTo(mesh, {carried.coordinate[u], carried.gradient[u]}, u, v);
  const Vec3f along = texture::tangentUnit(way, mesh.normals[v], Vec3f(0.0f));
  const bool moves = along.lengthSqr() > 0.0f;
  const auto laid = [&](const TexelGradient& g) {
    return moves ? laidAlong(g, along, mesh.normals[v], mesh.spacingAt(v)) : g;
  };
  carried.coordinate[v] = texel.coordinate;
  carried.gradient[v] = laid(texel.gradient);
  texture::Fading& fading = carried.fading;
  fading.weight[v] = fading.weight[u];
  fading.speed[v] = fading.speed[u];
  if (fading.weight[u] > 0.0f) {
    const Texel former = continuedTo(mesh, {fading.coordinate[u], fading.gradient[u]}, u, v);
    fading.coordinate[v] = former.coordinate;
    fading.gradient[v] = laid(former.gradient);
  }
  const Vec3f& d = carried.orientation[u];
  carried.orientation[v] =
      texture::tangentUnit(mesh.normals[u].dot(mesh.normals[v]) > kOpposite
                               ? texture::turnedTangent(d, mesh.normals[u], mesh.normals[v])
                               : d,
                           mesh.normals[v], carried.orientation[v]);
  carried.age[v] = 0.0f;
  carried.trust[v] = carried.trust[u];
}

double movedAcross(const TracedVertex& vertex) {
  return std::abs((vertex.position - vertex.origin).dot(Vec3d(vertex.normal)));
}

bool crosses(const TracedVertex& vertex) {
  return movedAcross(vertex) > kMostAcross * (vertex.position - vertex.origin).length();
}

// Whether the texture lies along the orientation, or turned against it as its symmetry allows, within 20
// degrees.
bool liesUpright(const TexelGradient& g, const Vec3f& d, const Vec3f& normal, int symmetry) {
  const Vec3f b = texture::rowAxis(d, normal);
  const float ss = g.s.dot(d), st = g.s.dot(b), ts = g.t.dot(d), tt = g.t.dot(b);
  const bool mirrored = ss * tt < st * ts;
  const float angle = mirrored ? std::atan2(st + ts, ss - tt) : std::atan2(st - ts, ss + tt);
  return std::cos(float(symmetry) * angle) > std::cos(float(symmetry) * kUpright);
}

// #V, 1 where something has come out, and on the rims beside that.
std::vector<std::uint8_t> outWithRims(const texture::VertexGraph& graph, const std::vector<Inflow>& inflow) {
  std::vector<std::uint8_t> out(inflow.size(), 0);
  std::vector<std::uint32_t> front, next;
  for (std::uint32_t v = 0; v < inflow.size(); ++v) {
    out[v] = inflow[v] == Inflow::out;
    if (out[v]) front.push_back(v);
  }
  for (int ring = 0; ring < kRimRings && !front.empty(); ++ring) {
    next.clear();
    for (const std::uint32_t v : front)
      for (const std::uint32_t u : graph.around(v)) {
        if (out[u] || inflow[u] != Inflow::rim) continue;
        out[u] = 1;
        next.push_back(u);
      }
    front.swap(next);
  }
  return out;
}

// #V, of the vertices in the mask: how many are upright in the same piece of texture.
std::vector<std::uint32_t> uprightInPieces(const texture::SurfaceMesh& mesh, const texture::Torus& torus,
                                           const texture::VertexGraph& graph,
                                           const std::vector<std::uint8_t>& mask,
                                           const texture::Carried& carried, int symmetry) {
  std::vector<std::uint32_t> upright(mask.size(), 0);
  const auto joined = [&](std::uint32_t v, std::uint32_t h) {
    return onePiece(torus, mesh.positions, carried.coordinate, carried.gradient, v, graph.neighbor[h]);
  };
  texture::forEachPiece(graph, mask, joined, [&](const std::vector<std::uint32_t>& piece) {
    const auto count = std::count_if(piece.begin(), piece.end(), [&](std::uint32_t v) {
      return liesUpright(carried.gradient[v], carried.orientation[v], mesh.normals[v], symmetry);
    });
    for (const std::uint32_t v : piece) upright[v] = std::uint32_t(count);
  });
  return upright;
}

}  // namespace

Inflow inflowAt(const TracedVertex& vertex, const Landing& landing) {
  const Vec3d off = vertex.origin - landing.point.position, way = vertex.position - vertex.origin;
  const double distance = off.length(), moved = way.length();
  if (crosses(vertex) || distance > kFarthest * moved) return Inflow::none;
  if (off.dot(Vec3d(landing.normal)) < kMostInside * std::max(distance, vertex.spacing)) return Inflow::none;
  const bool upstream = off.dot(way) < -kUpstream * distance * moved;
  if (upstream && planar(off, vertex.carriedNormal).length() > kBeyond * vertex.spacing) return Inflow::out;
  const double turned = way.dot(Vec3d(landing.normal - vertex.carriedNormal));
  return turned < kInwards * moved ? Inflow::rim : Inflow::none;
}

bool goesThrough(const TracedVertex& vertex, const Landing& landing) {
  if (!crosses(vertex) || landing.point.distance < kBeyond * vertex.spacing) return false;
  return landing.normal.dot(vertex.carriedNormal) < kOtherFace ||
         landing.point.distance > kLeftBehind * movedAcross(vertex);
}

bool hasStayed(const TracedVertex& vertex, const Landing& here) {
  return here.point.distance < kStayed * movedAcross(vertex);
}

bool anyOut(const std::vector<Inflow>& inflow) {
  return std::find(inflow.begin(), inflow.end(), Inflow::out) != inflow.end();
}

void drawOut(const texture::SurfaceMesh& mesh, const texture::VertexGraph& graph, const texture::Torus& torus,
             const std::vector<Inflow>& inflow, const std::vector<Vec3f>& way, int symmetry,
             texture::Carried& carried) {
  if (!anyOut(inflow)) return;
  const std::vector<std::uint8_t> out = outWithRims(graph, inflow);
  std::vector<std::uint8_t> placed(out.size(), 0);
  for (std::uint32_t v = 0; v < out.size(); ++v)
    placed[v] = !out[v] && !carried.stays[v] && carried.trust[v] >= texture::kLowTrust;
  std::vector<std::uint32_t> upright = uprightInPieces(mesh, torus, graph, placed, carried, symmetry);

  std::vector<std::uint8_t> reached = placed;
  std::vector<std::uint32_t> front =
      texture::gathered<std::uint32_t>(out.size(), [&](std::uint32_t v, auto& list) {
        if (placed[v]) list.push_back(v);
      });
  std::vector<std::uint32_t> next;
  while (!front.empty()) {
    next.clear();
    for (const std::uint32_t v : front)
      for (const std::uint32_t u : graph.around(v)) {
        if (reached[u] || !out[u]) continue;
        reached[u] = 1;
        next.push_back(u);
      }
    for (const std::uint32_t v : next) {
      std::uint32_t from = texture::kNone, most = 0;
      float nearest = 0.0f;
      for (const std::uint32_t u : graph.around(v)) {
        if (!placed[u]) continue;
        const float distance = (mesh.positions[u] - mesh.positions[v]).lengthSqr();
        if (from != texture::kNone && (upright[u] < most || (upright[u] == most && distance >= nearest)))
          continue;
        from = u, most = upright[u], nearest = distance;
      }
      drawOutAt(mesh, from, v, way[v], carried);
      upright[v] = most;
    }
    for (const std::uint32_t v : next) placed[v] = 1;
    front.swap(next);
  }
}

}  // namespace fluidtex::transport
