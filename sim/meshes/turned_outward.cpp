#include "sim/meshes/turned_outward.h"

#include "sim/meshes/inside_test.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>

namespace fluidtex::sim {
namespace {

using openvdb::Vec3I;

// A use of an edge by a triangle.
struct EdgeUse {
  std::array<openvdb::Index32, 2> edge;  // lower vertex, higher vertex
  std::uint32_t triangle;
  bool up;  // from the lower to the higher
};

// Uses in the order of edges; those of one edge are from first[n] to first[n + 1].
struct Edges {
  std::vector<EdgeUse> uses;
  std::vector<std::size_t> first;
};

Edges edgesOf(const std::vector<Vec3I>& triangles) {
  Edges edges;
  edges.uses.reserve(3 * triangles.size());
  for (std::size_t n = 0; n < triangles.size(); ++n) {
    for (int c = 0; c < 3; ++c) {
      const openvdb::Index32 a = triangles[n][c], b = triangles[n][(c + 1) % 3];
      edges.uses.push_back({{std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(n), a < b});
    }
  }
  std::sort(edges.uses.begin(), edges.uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.edge, a.triangle, a.up) < std::tie(b.edge, b.triangle, b.up);
  });
  for (std::size_t i = 0; i < edges.uses.size(); ++i)
    if (i == 0 || edges.uses[i].edge != edges.uses[i - 1].edge) edges.first.push_back(i);
  edges.first.push_back(edges.uses.size());
  return edges;
}

// Sets of triangles that are linked, and whether each is turned against the first of its set.
class Links {
 public:
  explicit Links(std::size_t count) : m_parent(count), m_turned(count, 0), m_twisted(count, 0) {
    std::iota(m_parent.begin(), m_parent.end(), std::size_t{0});
  }

  std::size_t rootOf(std::size_t n) {
    std::size_t root = n;
    bool turned = false;
    while (m_parent[root] != root) {
      turned = turned != bool(m_turned[root]);
      root = m_parent[root];
    }
    while (m_parent[n] != root && n != root) {
      const std::size_t next = m_parent[n];
      const bool step = m_turned[n];
      m_parent[n] = root;
      m_turned[n] = turned;
      turned = turned != step;
      n = next;
    }
    return root;
  }
  bool isTurned(std::size_t n) { return rootOf(n) != n && m_turned[n]; }
  // Whether what linked a set contradicts itself.
  bool isTwisted(std::size_t n) { return m_twisted[rootOf(n)]; }

  void link(std::size_t a, std::size_t b, bool opposite) {
    const std::size_t rootA = rootOf(a), rootB = rootOf(b);
    const bool turned = (isTurned(a) != isTurned(b)) != opposite;
    if (rootA == rootB) {
      m_twisted[rootA] = m_twisted[rootA] || turned;
      return;
    }
    const std::size_t low = std::min(rootA, rootB), high = std::max(rootA, rootB);
    m_parent[high] = low;
    m_turned[high] = turned;
    m_twisted[low] = m_twisted[low] || m_twisted[high];
  }

 private:
  std::vector<std::size_t> m_parent;
  std::vector<char> m_turned, m_twisted;
};

// The uses of an edge by the angle at which their triangles lie around it.
std::vector<EdgeUse> aroundEdge(const TriangleMesh& mesh, std::vector<EdgeUse> uses) {
  const Vec3d low(mesh.positions[uses[0].edge[0]]);
  Vec3d along = Vec3d(mesh.positions[uses[0].edge[1]]) - low;
  const double length = along.length();
  if (!(length > 0.0)) return uses;  // folded up there
  along /= length;
  const Vec3d e = std::abs(along.x()) < 0.6 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0);
  const Vec3d s = along.cross(e).unit(), t = along.cross(s);
  const auto angle = [&](const EdgeUse& use) {
    const Vec3I& corners = mesh.triangles[use.triangle];
    for (int c = 0; c < 3; ++c) {
      if (corners[c] == use.edge[0] || corners[c] == use.edge[1]) continue;
      const Vec3d x = Vec3d(mesh.positions[corners[c]]) - low;
      return std::atan2(x.dot(t), x.dot(s));
    }
    return 0.0;
  };
  std::stable_sort(uses.begin(), uses.end(),
                   [&](const EdgeUse& a, const EdgeUse& b) { return angle(a) < angle(b); });
  return uses;
}

// Sets of triangles that are closed by themselves, and how each triangle is turned within its own. Two faces
// at an edge are turned alike if they run along it in opposite directions; so are neighbours around an edge
// of more, since what lies between them is solid on both sides or on none.
Links closedParts(const TriangleMesh& mesh, const Edges& edges) {
  Links patches(mesh.triangles.size());
  for (std::size_t n = 0; n + 1 < edges.first.size(); ++n) {
    const EdgeUse *a = &edges.uses[edges.first[n]], *b = a + 1;
    if (edges.first[n + 1] - edges.first[n] == 2) patches.link(a->triangle, b->triangle, a->up == b->up);
  }
  // Patches that end at edges of more faces.
  std::vector<char> open(mesh.triangles.size(), 0);
  const auto forMany = [&](const auto& body) {
    for (std::size_t n = 0; n + 1 < edges.first.size(); ++n) {
      if (edges.first[n + 1] - edges.first[n] <= 2) continue;
      body(std::vector<EdgeUse>(edges.uses.begin() + std::ptrdiff_t(edges.first[n]),
                                edges.uses.begin() + std::ptrdiff_t(edges.first[n + 1])));
    }
  };
  forMany([&](const std::vector<EdgeUse>& uses) {
    for (const EdgeUse& use : uses) {
      const std::size_t patch = patches.rootOf(use.triangle);
      const auto same = std::count_if(uses.begin(), uses.end(), [&](const EdgeUse& other) {
        return patches.rootOf(other.triangle) == patch;
      });
      if (same % 2 != 0) open[patch] = 1;
    }
  });
  // As the file has them, where every edge is run along as often one way as the other.
  std::vector<char> uneven(mesh.triangles.size(), 0);
  forMany([&](const std::vector<EdgeUse>& uses) {
    int sum = 0;
    for (const EdgeUse& use : uses)
      if (open[patches.rootOf(use.triangle)]) sum += use.up ? 1 : -1;
    for (const EdgeUse& use : uses)
      if (sum != 0) uneven[patches.rootOf(use.triangle)] = 1;
  });
  Links parts = patches;
  Links groups(mesh.triangles.size());
  forMany([&](const std::vector<EdgeUse>& uses) {
    const EdgeUse* last = nullptr;
    for (const EdgeUse& use : uses) {
      if (!open[patches.rootOf(use.triangle)]) continue;
      if (last != nullptr) groups.link(patches.rootOf(last->triangle), patches.rootOf(use.triangle), false);
      last = &use;
    }
  });
  std::vector<char> unevenGroup(mesh.triangles.size(), 0);
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    const std::size_t patch = patches.rootOf(n);
    // A patch that has turned triangles is not as the file has it.
    if (uneven[patch] || patches.isTurned(n)) unevenGroup[groups.rootOf(patch)] = 1;
  }
  forMany([&](std::vector<EdgeUse> uses) {
    std::erase_if(uses, [&](const EdgeUse& use) { return !open[patches.rootOf(use.triangle)]; });
    if (uses.empty()) return;
    const bool asGiven = !unevenGroup[groups.rootOf(patches.rootOf(uses[0].triangle))];
    if (!asGiven) uses = aroundEdge(mesh, std::move(uses));
    for (std::size_t i = 0; i + 1 < uses.size(); ++i)
      parts.link(uses[i].triangle, uses[i + 1].triangle, !asGiven && uses[i].up == uses[i + 1].up);
  });
  return parts;
}

// One part, with what is needed to tell what lies within it.
struct Part {
  TriangleMesh mesh;  // only its triangles, all the positions they use
  std::vector<std::size_t> members;
  openvdb::BBoxd bounds;
  double volume = 0.0;
  bool inward = false;  // before it was turned
};

double volumeOf(const TriangleMesh& mesh) {
  if (mesh.positions.empty()) return 0.0;
  const Vec3d origin(mesh.positions[0]);
  double sixfold = 0.0;
  for (const Vec3I& t : mesh.triangles) {
    const Vec3d a = Vec3d(mesh.positions[t[0]]) - origin, b = Vec3d(mesh.positions[t[1]]) - origin,
                c = Vec3d(mesh.positions[t[2]]) - origin;
    sixfold += a.dot(b.cross(c));
  }
  return sixfold / 6.0;
}

// All parts turned outward by themselves.
std::vector<Part> partsOf(const TriangleMesh& mesh, Links& links) {
  std::vector<std::size_t> partOf(mesh.triangles.size());
  std::vector<Part> parts;
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n) {
    const std::size_t root = links.rootOf(n);
    if (root == n) {
      partOf[n] = parts.size();
      parts.emplace_back();
    }
    parts[partOf[root]].members.push_back(n);
  }
  std::vector<openvdb::Index32> place(mesh.positions.size());
  std::vector<std::size_t> lastPart(mesh.positions.size(), parts.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    Part& part = parts[p];
    for (const std::size_t n : part.members) {
      Vec3I t = mesh.triangles[n];
      if (links.isTurned(n)) std::swap(t[1], t[2]);
      for (int c = 0; c < 3; ++c) {
        const openvdb::Index32 v = t[c];
        if (lastPart[v] != p) {
          lastPart[v] = p;
          place[v] = static_cast<openvdb::Index32>(part.mesh.positions.size());
          part.mesh.positions.push_back(mesh.positions[v]);
          part.bounds.expand(Vec3d(mesh.positions[v]));
        }
        t[c] = place[v];
      }
      part.mesh.triangles.push_back(t);
    }
    part.volume = std::abs(volumeOf(part.mesh));
    part.inward = volumeOf(part.mesh) < 0.0;
    if (part.inward)
      for (Vec3I& t : part.mesh.triangles) std::swap(t[1], t[2]);
  }
  return parts;
}

// Whether all of a part lies within another one, by the middles of some of its triangles.
bool isWithin(const Part& part, const InsideTest& other) {
  constexpr std::size_t kSome = 64;
  const std::size_t count = part.mesh.triangles.size(), step = (count + kSome - 1) / kSome;
  for (std::size_t n = 0; n < count; n += step) {
    const Vec3I& t = part.mesh.triangles[n];
    Vec3d middle(0.0);
    for (int c = 0; c < 3; ++c) middle += Vec3d(part.mesh.positions[t[c]]) / 3.0;
    if (other.winding(middle) <= 0) return false;
  }
  return true;
}

// For each part, how many others it lies within.
std::vector<int> depthsOf(const std::vector<Part>& parts) {
  std::vector<int> depth(parts.size(), 0);
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  // By their low x, so that only parts that begin later are looked at.
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::make_pair(parts[a].bounds.min().x(), a) < std::make_pair(parts[b].bounds.min().x(), b);
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Part& outer = parts[order[i]];
    std::optional<InsideTest> test;
    const auto look = [&](std::size_t k) {
      const Part& inner = parts[order[k]];
      if (k == i || inner.volume >= outer.volume || !outer.bounds.isInside(inner.bounds)) return;
      if (!test) test.emplace(outer.mesh);
      if (isWithin(inner, *test)) ++depth[order[k]];
    };
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      if (parts[order[k]].bounds.min().x() > outer.bounds.max().x()) break;
      look(k);
    }
  }
  return depth;
}

}  // namespace

std::optional<std::vector<Vec3I>> turnedOutward(const TriangleMesh& mesh) {
  Links links = closedParts(mesh, edgesOf(mesh.triangles));
  for (std::size_t n = 0; n < mesh.triangles.size(); ++n)
    if (links.isTwisted(n)) return std::nullopt;
  const std::vector<Part> parts = partsOf(mesh, links);
  const std::vector<int> depth = depthsOf(parts);
  std::vector<Vec3I> triangles = mesh.triangles;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const bool turned = parts[p].inward != (depth[p] % 2 != 0);
    for (const std::size_t n : parts[p].members)
      if (links.isTurned(n) != turned) std::swap(triangles[n][1], triangles[n][2]);
  }
  return triangles;
}

}  // namespace fluidtex::sim
