#include "transport/inflow.h"

#include "texture/joints/places.h"
#include "texture/labels/fresh.h"
#include "texture/loops/parallel.h"
#include "texture/orientation/tangent.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::transport {
namespace {

constexpr double kBeyond = 0.1;        // over the spacing
constexpr double kFarthest = 1.25;     // over the way moved
constexpr double kMostAcross = 0.5;    // sine of the angle between motion and surface: 30 degrees
constexpr double kInwards = -0.15;     // of the motion, at the landing, more than at the vertex
constexpr double kLeftBehind = 0.5;    // over the motion across the surface
constexpr double kMostInside = -0.25;  // over the distance: what lies in the liquid is exposed, not given out

Vec3d planar(const Vec3d& x, const Vec3f& normal) {
  const Vec3d n(normal);
  return x - n * n.dot(x);
}

// x as at normal `from`, as it is at `to`.
TexelGradient turned(const TexelGradient& g, const Vec3f& from, const Vec3f& to) {
  if (from.dot(to) <= -0.9f) return g;
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
  carried.age[v] = 0.0f;
  carried.trust[v] = carried.trust[u];
}

bool crosses(const TracedVertex& vertex) {
  const Vec3d way = vertex.position - vertex.origin;
  return std::abs(way.dot(Vec3d(vertex.normal))) > kMostAcross * way.length();
}

// #V, of the vertices in the mask: how many are of the same piece of texture.
std::vector<std::uint32_t> sizesOfPieces(const texture::SurfaceMesh& mesh, const texture::Torus& torus,
                                         const texture::VertexGraph& graph,
                                         const std::vector<std::uint8_t>& mask,
                                         const texture::Carried& carried) {
  std::vector<std::uint32_t> size(mask.size(), 0), piece;
  std::vector<std::uint8_t> seen(mask.size(), 0);
  for (std::uint32_t start = 0; start < mask.size(); ++start) {
    if (!mask[start] || seen[start]) continue;
    piece.assign(1, start);
    seen[start] = 1;
    for (std::size_t i = 0; i < piece.size(); ++i)
      for (const std::uint32_t u : graph.around(piece[i])) {
        if (!mask[u] || seen[u] ||
            !onePiece(torus, mesh.positions, carried.coordinate, carried.gradient, piece[i], u))
          continue;
        seen[u] = 1;
        piece.push_back(u);
      }
    for (const std::uint32_t v : piece) size[v] = std::uint32_t(piece.size());
  }
  return size;
}

}  // namespace

bool cameOut(const TracedVertex& vertex, const Landing& landing) {
  const Vec3d off = vertex.origin - landing.point.position, way = vertex.position - vertex.origin;
  const double distance = off.length(), moved = way.length();
  if (crosses(vertex) || distance > kFarthest * moved) return false;
  if (off.dot(Vec3d(landing.normal)) < kMostInside * distance) return false;
  const double turned = way.dot(Vec3d(landing.normal - vertex.carriedNormal));
  return planar(off, vertex.carriedNormal).length() > kBeyond * vertex.spacing || turned < kInwards * moved;
}

bool goesThrough(const TracedVertex& vertex, const Landing& landing) {
  const Vec3d way = vertex.position - vertex.origin;
  return crosses(vertex) && landing.point.distance > kLeftBehind * std::abs(way.dot(Vec3d(vertex.normal)));
}

void drawOut(const texture::SurfaceMesh& mesh, const texture::Torus& torus,
             const std::vector<std::uint8_t>& out, const std::vector<std::uint8_t>& stays,
             const std::vector<Vec3f>& way, texture::Carried& carried) {
  const texture::VertexGraph graph = texture::buildVertexGraph(mesh);
  std::vector<std::uint8_t> placed(out.size(), 0);
  for (std::uint32_t v = 0; v < out.size(); ++v)
    placed[v] = !out[v] && !stays[v] && carried.trust[v] >= texture::kLowTrust;
  std::vector<std::uint32_t> pieceSize = sizesOfPieces(mesh, torus, graph, placed, carried);

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
      std::uint32_t from = texture::kNone, size = 0;
      float nearest = 0.0f;
      for (const std::uint32_t u : graph.around(v)) {
        if (!placed[u]) continue;
        const float distance = (mesh.positions[u] - mesh.positions[v]).lengthSqr();
        if (from != texture::kNone && (pieceSize[u] < size || (pieceSize[u] == size && distance >= nearest)))
          continue;
        from = u, size = pieceSize[u], nearest = distance;
      }
      drawOutAt(mesh, from, v, way[v], carried);
      pieceSize[v] = size;
    }
    for (const std::uint32_t v : next) placed[v] = 1;
    front.swap(next);
  }
}

}  // namespace fluidtex::transport
