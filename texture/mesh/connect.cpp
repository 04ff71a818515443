// Based on: Turk, "Re-tiling polygonal surfaces" (1992). Two departures: a vertex of the old mesh that lies
// next to a point moves there instead of being removed while the point is inserted; and removal is by edge
// collapse.
#include "texture/mesh/connect.h"

#include "texture/loops/parallel.h"
#include "texture/loops/point_grid.h"
#include "texture/mesh/patches.h"
#include "texture/mesh/remesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fluidtex::texture {
namespace {

// Nearest vertex within half a cell; vertices are sorted into hashed cells.
class VertexGrid {
 public:
  VertexGrid(const std::vector<Vec3f>& positions, float cell) : m_inverse(1.0f / cell) {
    std::size_t capacity = 64;
    while (capacity < 2 * positions.size()) capacity *= 2;
    m_mask = capacity - 1;
    m_first.assign(capacity + 1, 0);
    std::vector<std::uint32_t> slots(positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const Vec3f p = positions[i] * m_inverse;
      slots[i] = slot(cellAlong(p.x()), cellAlong(p.y()), cellAlong(p.z()));
      ++m_first[slots[i] + 1];
    }
    std::partial_sum(m_first.begin(), m_first.end(), m_first.begin());
    m_items.resize(positions.size());
    std::vector<std::uint32_t> cursor(m_first.begin(), m_first.end() - 1);
    for (std::uint32_t i = 0; i < positions.size(); ++i) m_items[cursor[slots[i]]++] = {positions[i], i};
  }
  template <class Accept>
  std::uint32_t nearest(const Vec3f& at, const Accept& accept) const {
    const Vec3f p = at * m_inverse - Vec3f(0.5f);
    const int x = cellAlong(p.x()), y = cellAlong(p.y()), z = cellAlong(p.z());
    std::uint32_t best = kNone;
    float bestDistance = 1e30f;
    for (int n = 0; n < 8; ++n) {
      const std::uint32_t s = slot(x + (n & 1), y + (n >> 1 & 1), z + (n >> 2));
      for (std::uint32_t k = m_first[s]; k < m_first[s + 1]; ++k) {
        const float distance = (m_items[k].position - at).lengthSqr();
        const std::uint32_t v = m_items[k].vertex;
        if (distance > bestDistance || (distance == bestDistance && v > best) || !accept(v)) continue;
        best = v;
        bestDistance = distance;
      }
    }
    return best;
  }

 private:
  struct Item {
    Vec3f position;
    std::uint32_t vertex;
  };
  std::uint32_t slot(int x, int y, int z) const { return std::uint32_t(nearbySlot(x, y, z, m_mask)); }
  float m_inverse;
  std::size_t m_mask = 0;
  std::vector<std::uint32_t> m_first;
  std::vector<Item> m_items;
};

// The half-edge whose triangle contains the projection of p, found by walking across edges from a nearby
// vertex. `smallest`: the least barycentric weight, that of the corner opposite to the edge.
struct Place {
  std::uint32_t edge = kNone;
  float smallest = -1e30f;
};

Place locate(const EditableMesh& mesh, std::uint32_t start, const Vec3f& p) {
  constexpr int kSteps = 24;
  Place best;
  std::uint32_t h = mesh.outgoing[start];
  std::uint32_t came = kNone;
  for (int step = 0; step < kSteps; ++step) {
    const std::uint32_t corner[3] = {h, EditableMesh::next(h), EditableMesh::previous(h)};
    const Vec3f a = mesh.position[mesh.origin[corner[0]]], b = mesh.position[mesh.origin[corner[1]]],
                c = mesh.position[mesh.origin[corner[2]]];
    const Vec3f normal = (b - a).cross(c - a);
    const float area2 = normal.lengthSqr();
    if (area2 <= 0.0f) break;
    const float wc = normal.dot((b - a).cross(p - a)) / area2;  // of the corner opposite to corner[0]'s edge
    const float wa = normal.dot((c - b).cross(p - b)) / area2;
    const float wb = 1.0f - wa - wc;
    const float w[3] = {wc, wa, wb};
    const int out = int(std::min_element(w, w + 3) - w);
    if (w[out] > best.smallest) best = {corner[out], w[out]};
    if (w[out] >= 0.0f) break;
    const std::uint32_t across = mesh.twin[corner[out]];
    if (across / 3 == came) break;  // back and forth over a crease: p is nearest to that edge
    came = h / 3;
    h = across;
  }
  return best;
}

// Inserts p into the triangle or on the edge it lies in. kNone if that would fold the mesh.
std::uint32_t insertPoint(EditableMesh& mesh, std::uint32_t start, const Vec3f& p, const Vec3f& n,
                          float minDistance, const std::vector<std::uint8_t>& keep) {
  constexpr float kOnEdge = 0.08f;  // barycentric: nearer to an edge than this the edge is split
  constexpr float kTooFar = -0.5f;  // barycentric: the walk has not found the point's foot
  const Place place = locate(mesh, start, p);
  if (place.edge == kNone || place.smallest < kTooFar) return kNone;
  const std::uint32_t h = place.edge, t = mesh.twin[h];
  for (std::uint32_t v : {mesh.origin[h], mesh.target(h), mesh.opposite(h)}) {
    if (keep[v] && (mesh.position[v] - p).lengthSqr() < minDistance * minDistance) return kNone;
  }
  const std::uint32_t a = mesh.origin[h], b = mesh.target(h), c = mesh.opposite(h), d = mesh.opposite(t);
  const auto faces = [&](std::uint32_t i, std::uint32_t j, const Vec3f& last, const Vec3f& lastNormal) {
    const Vec3f corners[3] = {mesh.position[i], mesh.position[j], last};
    const Vec3f normals[3] = {mesh.normal[i], mesh.normal[j], lastNormal};
    return facing(corners, normals);
  };
  const float inside = faces(a, b, mesh.position[c], mesh.normal[c]);
  if (place.smallest >= kOnEdge &&
      mayFace(std::min({faces(a, b, p, n), faces(b, c, p, n), faces(c, a, p, n)}), inside)) {
    return mesh.splitTriangle(h / 3, p, n);
  }
  const float both = std::min(inside, faces(b, a, mesh.position[d], mesh.normal[d]));
  if (mayFace(std::min({faces(b, c, p, n), faces(c, a, p, n), faces(a, d, p, n), faces(d, b, p, n)}), both)) {
    return mesh.splitEdge(h, p, n);
  }
  return kNone;
}

// Quality of a triangle: 1 equilateral, 0 degenerate.
float shape(const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  const float sum = (b - a).lengthSqr() + (c - b).lengthSqr() + (a - c).lengthSqr();
  return sum > 0.0f ? 3.4641016f * (b - a).cross(c - a).length() / sum : 0.0f;
}

float leastScale(const EditableMesh& mesh) {
  return mesh.scale.empty() ? 1.0f : *std::min_element(mesh.scale.begin(), mesh.scale.end());
}
float largestScale(const EditableMesh& mesh) {
  return mesh.scale.empty() ? 1.0f : *std::max_element(mesh.scale.begin(), mesh.scale.end());
}

bool removeVertex(EditableMesh& mesh, std::uint32_t v, std::vector<std::uint32_t>& freed) {
  constexpr std::size_t kMost = 32;
  std::uint32_t edges[kMost];
  std::size_t count = 0;
  mesh.around(v, [&](std::uint32_t h) {
    if (count < kMost) edges[count++] = h;
  });
  std::pair<float, std::uint32_t> ranked[kMost];
  for (std::size_t k = 0; k < count; ++k) {
    const std::uint32_t u = mesh.target(edges[k]);
    const Vec3f& at = mesh.position[u];
    float worst = 1.0f;
    for (std::size_t j = 0; j < count; ++j) {
      const std::uint32_t b = mesh.target(edges[j]), c = mesh.opposite(edges[j]);
      if (b != u && c != u) worst = std::min(worst, shape(at, mesh.position[b], mesh.position[c]));
    }
    ranked[k] = {-worst, edges[k]};
  }
  std::sort(ranked, ranked + count);
  for (std::size_t k = 0; k < count; ++k) {
    if (tryCollapse(mesh, ranked[k].second, freed)) return true;
  }
  return false;
}

// Removes the vertices with `keep` 0, where possible, after [Turk92].
void removeVertices(EditableMesh& mesh, const Patches& patches, const std::vector<std::uint8_t>& keep) {
  constexpr int kRounds = 2;  // what is stuck may come free after its surroundings have gone
  struct Left {
    std::vector<std::uint32_t> vertices, freed;
  };
  std::vector<Left> left(patches.count());
  forEachPatch(patches, [&](std::uint32_t patch) {
    for (std::uint32_t i = patches.first[patch]; i < patches.first[patch + 1]; ++i) {
      const std::uint32_t v = patches.vertex[i];
      if (keep[v]) continue;
      if (!patches.ownsRing(mesh, patch, v) || !removeVertex(mesh, v, left[patch].freed))
        left[patch].vertices.push_back(v);
    }
    flipToDelaunay(mesh, patches, patch);
  });
  std::vector<std::uint32_t> rest;
  for (const Left& one : left) {
    rest.insert(rest.end(), one.vertices.begin(), one.vertices.end());
    mesh.free.insert(mesh.free.end(), one.freed.begin(), one.freed.end());
  }
  flipToDelaunay(mesh);
  for (int round = 0; round < kRounds && !rest.empty(); ++round) {
    const auto stuck = std::remove_if(rest.begin(), rest.end(),
                                      [&](std::uint32_t v) { return removeVertex(mesh, v, mesh.free); });
    rest.erase(stuck, rest.end());
    flipToDelaunay(mesh);
  }
}

// Moves each old vertex to the point that it was assigned, where that folds nothing; sets owner to kNone
// there.
void moveToPoints(EditableMesh& mesh, const LevelSet& phi, const Patches& patches, const PointSet& points,
                  std::vector<std::uint32_t>& owner) {
  const auto move = [&](std::uint32_t v) {
    const std::uint32_t i = owner[v];
    if (!mayFace(worstFacingAt(mesh, v, points.position[i], points.normal[i]), worstFacing(mesh, v))) {
      owner[v] = kNone;
      return;
    }
    mesh.position[v] = points.position[i];
    mesh.normal[v] = points.normal[i];
    if (phi.scaled()) mesh.scale[v] = phi.scale(mesh.position[v]);
  };
  std::vector<std::vector<std::uint32_t>> left(patches.count());
  forEachPatch(patches, [&](std::uint32_t patch) {
    for (std::uint32_t i = patches.first[patch]; i < patches.first[patch + 1]; ++i) {
      const std::uint32_t v = patches.vertex[i];
      if (owner[v] == kNone) continue;
      if (patches.ownsRing(mesh, patch, v)) {
        move(v);
      } else {
        left[patch].push_back(v);
      }
    }
  });
  for (const std::vector<std::uint32_t>& vertices : left)
    for (std::uint32_t v : vertices) move(v);
}

// Projects the iso-surface's vertices onto the smooth level set while its edges are long: vertices closer to
// each other than to it could only get there all at once.
void settleOnSurface(EditableMesh& mesh, const LevelSet& phi) {
  std::vector<LevelSet::Projection> found(mesh.vertexCount());
  forEachIndex(mesh.vertexCount(),
               [&](std::uint32_t v) { found[v] = phi.project(mesh.position[v], reachFor(0.0f)); });
  for (std::uint32_t v = 0; v < mesh.vertexCount(); ++v) {
    const LevelSet::Projection& p = found[v];
    if (!p.known || !mayFace(worstFacingAt(mesh, v, p.position, p.normal), worstFacing(mesh, v))) continue;
    mesh.position[v] = p.position;
    mesh.normal[v] = p.normal;
  }
}

}  // namespace

EditableMesh connectPoints(const LevelSet& phi, const IsoSurface& surface, const PointSet& points,
                           float spacing) {
  // Old vertices must be at least as dense as the points, so that most points find one of their own.
  constexpr float kLongest = 1.6f;  // edges of the old mesh, in mean edge lengths
  constexpr float kTooNear = 0.4f;  // spacings: two points in one place
  constexpr float kPatch = 40.0f;   // a patch's side, in edges of the old mesh or somewhat less
  EditableMesh mesh = makeEditableMesh(surface.positions, surface.triangles);
  forEachIndex(mesh.vertexCount(), [&](std::uint32_t v) {
    const Vec3f gradient = phi.sample(mesh.position[v]).gradient;
    const float length = gradient.length();
    if (length > 0.0f) mesh.normal[v] = gradient / length;
  });
  takeScale(mesh, phi);
  const float least = leastScale(mesh), largest = largestScale(mesh);
  if (kLongest * kEdgePerSpacing * spacing * least < 1.7f) {
    settleOnSurface(mesh, phi);
    splitLongEdges(mesh, phi, kLongest * kEdgePerSpacing * spacing);
  }

  const VertexGrid grid(mesh.position, 2.0f * std::min(1.0f, kLongest * spacing * largest));
  const std::size_t count = points.position.size();
  std::vector<std::uint32_t> nearest(count);
  forEachIndex(count, [&](std::uint32_t i) {
    nearest[i] = grid.nearest(points.position[i],
                              [&](std::uint32_t v) { return mesh.normal[v].dot(points.normal[i]) > 0.0f; });
  });
  std::vector<std::uint32_t> owner(mesh.vertexCount(), kNone);
  const auto distance = [&](std::uint32_t i, std::uint32_t v) {
    return (points.position[i] - mesh.position[v]).lengthSqr();
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t v = nearest[i];
    if (v != kNone && (owner[v] == kNone || distance(i, v) < distance(owner[v], v))) owner[v] = i;
  }
  Patches patches = patchesOf(mesh, kPatch * std::min(1.0f, spacing * least), Vec3f(0.0f));
  moveToPoints(mesh, phi, patches, points, owner);
  std::vector<std::uint8_t> keep(mesh.vertexCount());
  forEachIndex(keep.size(), [&](std::uint32_t v) { keep[v] = owner[v] != kNone; });
  std::vector<std::uint32_t> left;  // points that have no place yet
  const auto insert = [&](std::uint32_t i, std::uint32_t near) {
    const std::uint32_t added = insertPoint(mesh, near, points.position[i], points.normal[i],
                                            kTooNear * spacing * phi.scale(points.position[i]), keep);
    if (added == kNone) return false;
    keep.push_back(1);
    patches.of.push_back(patches.of[near]);
    return true;
  };
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t v = nearest[i];
    if (v != kNone && owner[v] != i && !insert(i, v)) left.push_back(i);
  }
  removeVertices(mesh, patches, keep);
  mesh.compact(surface.positions.size());
  if (left.empty()) return mesh;

  // Without the old vertices there may be room for them.
  keep.assign(mesh.vertexCount(), 1);
  const VertexGrid rest(mesh.position, 2.0f * spacing * largest);
  for (std::uint32_t i : left) {
    const std::uint32_t v = rest.nearest(
        points.position[i], [&](std::uint32_t u) { return mesh.normal[u].dot(points.normal[i]) > 0.0f; });
    if (v != kNone) insert(i, v);
  }
  flipToDelaunay(mesh);
  return mesh;
}

}  // namespace fluidtex::texture
