// Half-edge operations after Botsch et al., "Polygon Mesh Processing" (2010), sec. 2 and 7; link condition
// after Dey, Edelsbrunner, Guha, Nekhayev, "Topology preserving edge contraction" (1999).
#include "texture/mesh/editable_mesh.h"

#include "texture/loops/parallel.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace fluidtex::texture {

bool EditableMesh::connected(std::uint32_t a, std::uint32_t b) const {
  bool found = false;
  around(a, [&](std::uint32_t h) { found = found || target(h) == b; });
  return found;
}

bool EditableMesh::canFlip(std::uint32_t h) const {
  const std::uint32_t t = twin[h];
  const std::uint32_t c = opposite(h), d = opposite(t);
  return c != d && valence(origin[h]) > 3 && valence(origin[t]) > 3 && !connected(c, d);
}

//        c                c
//      / | \            /   \ .
//     a--h-->b   ->    a     b      h: a->b becomes a->d, next(h): d->c
//      \ | /            \   /
//        d                d
void EditableMesh::flip(std::uint32_t h) {
  const std::uint32_t t = twin[h];
  const std::uint32_t hn = next(h), hp = previous(h), tn = next(t), tp = previous(t);
  const std::uint32_t a = origin[h], b = origin[t], c = origin[hp], d = origin[tp];
  const std::uint32_t bc = twin[hn], ad = twin[tn];
  origin[hn] = d;
  origin[tn] = c;
  link(h, ad);
  link(t, bc);
  link(hn, tn);
  outgoing[a] = h;
  outgoing[b] = t;
  outgoing[c] = hp;
  outgoing[d] = tp;
}

std::uint32_t EditableMesh::newTriangle() {
  if (!free.empty()) {
    const std::uint32_t t = free.back();
    free.pop_back();
    return 3 * t;
  }
  const std::size_t h = origin.size();
  origin.resize(h + 3);
  twin.resize(h + 3);
  return std::uint32_t(h);
}

std::uint32_t EditableMesh::newVertex(const Vec3f& at, const Vec3f& atNormal, std::uint32_t beside) {
  if (!scale.empty()) scale.push_back(scale[beside]);
  position.push_back(at);
  normal.push_back(atNormal);
  outgoing.push_back(kNone);
  return std::uint32_t(position.size() - 1);
}

std::uint32_t EditableMesh::splitEdge(std::uint32_t h, const Vec3f& at, const Vec3f& atNormal) {
  const std::uint32_t t = twin[h];
  const std::uint32_t hn = next(h), hp = previous(h), tn = next(t), tp = previous(t);
  const std::uint32_t a = origin[h], b = origin[t], c = origin[hp], d = origin[tp];
  const std::uint32_t bc = twin[hn], ad = twin[tn];
  const std::uint32_t m = newVertex(at, atNormal, a);
  const std::uint32_t e = newTriangle(), g = newTriangle();
  // h: a->m, hn: m->c, hp: c->a; e: m->b, b->c, c->m; t: b->m, tn: m->d, tp: d->b; g: m->a, a->d, d->m
  origin[hn] = m;
  origin[e] = m;
  origin[e + 1] = b;
  origin[e + 2] = c;
  origin[tn] = m;
  origin[g] = m;
  origin[g + 1] = a;
  origin[g + 2] = d;
  link(h, g);
  link(t, e);
  link(e + 1, bc);
  link(e + 2, hn);
  link(g + 1, ad);
  link(g + 2, tn);
  outgoing[a] = h;
  outgoing[b] = t;
  outgoing[c] = hp;
  outgoing[d] = tp;
  outgoing[m] = e;
  return m;
}

std::uint32_t EditableMesh::splitTriangle(std::uint32_t triangle, const Vec3f& at, const Vec3f& atNormal) {
  const std::uint32_t h = 3 * triangle;
  const std::uint32_t a = origin[h], b = origin[h + 1], c = origin[h + 2];
  const std::uint32_t bc = twin[h + 1], ca = twin[h + 2];
  const std::uint32_t m = newVertex(at, atNormal, a);
  const std::uint32_t e = newTriangle(), g = newTriangle();
  // h: a->b, b->m, m->a; e: b->c, c->m, m->b; g: c->a, a->m, m->c
  origin[h + 2] = m;
  origin[e] = b;
  origin[e + 1] = c;
  origin[e + 2] = m;
  origin[g] = c;
  origin[g + 1] = a;
  origin[g + 2] = m;
  link(e, bc);
  link(g, ca);
  link(h + 1, e + 2);
  link(e + 1, g + 2);
  link(g + 1, h + 2);
  outgoing[a] = h;
  outgoing[b] = e;
  outgoing[c] = g;
  outgoing[m] = h + 2;
  return m;
}

bool EditableMesh::canCollapse(std::uint32_t h) const {
  const std::uint32_t v = origin[h], u = target(h);
  const std::uint32_t a = opposite(h), b = opposite(twin[h]);
  if (a == b || valence(a) <= 3 || valence(b) <= 3) return false;
  bool ok = true;
  around(v, [&](std::uint32_t e) {
    const std::uint32_t x = target(e);
    if (ok && x != u && x != a && x != b) ok = !connected(u, x);
  });
  return ok;
}

void EditableMesh::collapse(std::uint32_t h, std::vector<std::uint32_t>& freed) {
  const std::uint32_t t = twin[h];
  const std::uint32_t v = origin[h], u = origin[t];
  const std::uint32_t hn = next(h), hp = previous(h), tn = next(t), tp = previous(t);
  const std::uint32_t a = origin[hp], b = origin[tp];
  const std::uint32_t ua = twin[hn], va = twin[hp], vb = twin[tn],
                      ub = twin[tp];  // seen from outside the two triangles
  around(v, [this, u](std::uint32_t e) { origin[e] = u; });
  link(ua, va);
  link(vb, ub);
  outgoing[u] = va;
  outgoing[a] = ua;
  outgoing[b] = vb;
  outgoing[v] = kNone;
  for (std::uint32_t base : {h - h % 3, t - t % 3}) {
    for (std::uint32_t k = 0; k < 3; ++k) origin[base + k] = twin[base + k] = kNone;
    freed.push_back(base / 3);
  }
}

void EditableMesh::removeComponent(const std::vector<std::uint32_t>& vertices) {
  for (std::uint32_t v : vertices) {
    std::vector<std::uint32_t> ring;
    around(v, [&](std::uint32_t h) { ring.push_back(h); });
    for (std::uint32_t h : ring)
      if (v < target(h) && v < opposite(h)) free.push_back(h / 3);
  }
  for (std::uint32_t v : vertices) outgoing[v] = kNone;
  for (auto t = free.rbegin(); t != free.rend() && origin[3 * *t] != kNone; ++t)
    for (std::uint32_t k = 0; k < 3; ++k) origin[3 * *t + k] = twin[3 * *t + k] = kNone;
}

void EditableMesh::append(const EditableMesh& part) {
  const auto vertices = std::uint32_t(position.size()), halfEdges = std::uint32_t(origin.size());
  position.insert(position.end(), part.position.begin(), part.position.end());
  normal.insert(normal.end(), part.normal.begin(), part.normal.end());
  scale.insert(scale.end(), part.scale.begin(), part.scale.end());
  for (std::uint32_t h : part.outgoing) outgoing.push_back(h + halfEdges);
  for (std::uint32_t v : part.origin) origin.push_back(v + vertices);
  for (std::uint32_t h : part.twin) twin.push_back(h + halfEdges);
}

void EditableMesh::compact(std::size_t firstNew) {
  const std::size_t before = position.size();
  firstNew = std::min(firstNew, before);
  // A new vertex goes behind its neighbour of lowest rank among those before it.
  std::vector<std::uint32_t> rank(before - firstNew);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> added;  // rank, old vertex
  added.reserve(rank.size());
  for (std::uint32_t v = std::uint32_t(firstNew); v < before; ++v) {
    if (outgoing[v] == kNone) continue;
    std::uint32_t& own = rank[v - firstNew];
    own = v;
    around(v, [&](std::uint32_t h) {
      const std::uint32_t u = target(h);
      if (u < v) own = std::min(own, u < firstNew ? u : rank[u - firstNew]);
    });
    added.emplace_back(own, v);
  }
  std::sort(added.begin(), added.end());

  std::vector<std::uint32_t> oldVertexOf, newVertexOf(before, kNone);
  oldVertexOf.reserve(before);
  const auto take = [&](std::uint32_t v) {
    newVertexOf[v] = std::uint32_t(oldVertexOf.size());
    oldVertexOf.push_back(v);
  };
  auto next = added.begin();
  for (std::uint32_t v = 0; v < firstNew; ++v) {
    if (outgoing[v] != kNone) take(v);
    for (; next != added.end() && next->first == v; ++next) take(next->second);
  }
  for (; next != added.end(); ++next) take(next->second);

  // A triangle goes with its first vertex, in the order around that.
  const std::size_t vertices = oldVertexOf.size();
  using HalfEdges = std::vector<std::uint32_t>;
  const HalfEdges oldTriangles = gathered<std::uint32_t>(vertices, [&](std::uint32_t v, HalfEdges& found) {
    around(oldVertexOf[v], [&](std::uint32_t h) {
      if (v < newVertexOf[target(h)] && v < newVertexOf[opposite(h)]) found.push_back(h - h % 3);
    });
  });
  std::vector<std::uint32_t> newHalfEdgeOf(origin.size());
  forEachIndex(oldTriangles.size(), [&](std::uint32_t t) {
    for (std::uint32_t k = 0; k < 3; ++k) newHalfEdgeOf[oldTriangles[t] + k] = 3 * t + k;
  });

  EditableMesh packed;
  packed.position.resize(vertices);
  packed.normal.resize(vertices);
  packed.outgoing.resize(vertices);
  if (!scale.empty()) packed.scale.resize(vertices);
  forEachIndex(vertices, [&](std::uint32_t v) {
    const std::uint32_t old = oldVertexOf[v];
    packed.position[v] = position[old];
    packed.normal[v] = normal[old];
    packed.outgoing[v] = newHalfEdgeOf[outgoing[old]];
    if (!scale.empty()) packed.scale[v] = scale[old];
  });
  packed.origin.resize(3 * oldTriangles.size());
  packed.twin.resize(3 * oldTriangles.size());
  forEachIndex(oldTriangles.size(), [&](std::uint32_t t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      packed.origin[3 * t + k] = newVertexOf[origin[oldTriangles[t] + k]];
      packed.twin[3 * t + k] = newHalfEdgeOf[twin[oldTriangles[t] + k]];
    }
  });
  *this = std::move(packed);
}

EditableMesh makeEditableMesh(std::vector<Vec3f> positions, const std::vector<Vec3I>& triangles) {
  EditableMesh mesh;
  mesh.position = std::move(positions);
  const std::size_t vertices = mesh.position.size(), halfEdges = 3 * triangles.size();
  mesh.normal.assign(vertices, Vec3f(0.0f));
  mesh.outgoing.assign(vertices, kNone);
  mesh.origin.resize(halfEdges);
  mesh.twin.assign(halfEdges, kNone);
  std::vector<std::uint32_t> first(vertices + 1, 0), starting(halfEdges);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t v = triangles[t][k];
      mesh.origin[3 * t + std::size_t(k)] = v;
      ++first[v + 1];
    }
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> cursor(first.begin(), first.end() - 1);
  for (std::uint32_t h = 0; h < halfEdges; ++h) {
    starting[cursor[mesh.origin[h]]++] = h;
    mesh.outgoing[mesh.origin[h]] = h;
  }
  forEachIndex(halfEdges, [&](std::uint32_t h) {
    const std::uint32_t a = mesh.origin[h], b = mesh.target(h);
    for (std::uint32_t k = first[b]; k < first[b + 1]; ++k) {
      if (mesh.target(starting[k]) == a) mesh.twin[h] = starting[k];
    }
    assert(mesh.twin[h] != kNone);
  });
  return mesh;
}

std::vector<Vec3I> trianglesOf(const EditableMesh& mesh) {
  assert(mesh.free.empty());
  std::vector<Vec3I> triangles(mesh.origin.size() / 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    triangles[t] = Vec3I(mesh.origin[3 * t], mesh.origin[3 * t + 1], mesh.origin[3 * t + 2]);
  }
  return triangles;
}

bool isClosedManifold(std::size_t vertices, const std::vector<Vec3I>& triangles) {
  // One-rings: around a vertex each triangle leads from one neighbour to the next.
  struct Step {
    std::uint32_t from, to;
  };
  std::vector<std::uint32_t> first(vertices + 1, 0);
  for (const Vec3I& t : triangles) {
    for (int k = 0; k < 3; ++k) {
      if (t[k] >= vertices || t[k] == t[(k + 1) % 3]) return false;
      ++first[t[k] + 1];
    }
  }
  std::partial_sum(first.begin(), first.end(), first.begin());
  std::vector<std::uint32_t> cursor(first.begin(), first.end() - 1);
  std::vector<Step> steps(3 * triangles.size());
  for (const Vec3I& t : triangles) {
    for (int k = 0; k < 3; ++k) steps[cursor[t[k]]++] = {t[(k + 1) % 3], t[(k + 2) % 3]};
  }
  for (std::size_t v = 0; v < vertices; ++v) {
    const std::size_t n = first[v + 1] - first[v];
    if (n < 3) return false;
    const Step* ring = steps.data() + first[v];
    std::size_t length = 0;
    std::uint32_t at = ring[0].from;
    do {
      const Step* found = nullptr;
      for (std::size_t k = 0; k < n; ++k) {
        if (ring[k].from != at) continue;
        if (found) return false;  // two edges between the same vertices
        found = ring + k;
      }
      if (!found) return false;
      at = found->to;
      ++length;
    } while (at != ring[0].from && length <= n);
    if (length != n) return false;
  }
  return true;
}

std::vector<std::uint32_t> components(std::size_t vertices, const std::vector<Vec3I>& triangles) {
  std::vector<std::uint32_t> root(vertices);
  std::iota(root.begin(), root.end(), 0u);
  const auto find = [&root](std::uint32_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (const Vec3I& t : triangles) {
    for (int k = 1; k < 3; ++k) {
      const std::uint32_t a = find(t[0]), b = find(t[k]);
      root[std::max(a, b)] = std::min(a, b);
    }
  }
  for (std::uint32_t v = 0; v < vertices; ++v) root[v] = find(v);
  return root;
}

}  // namespace fluidtex::texture
