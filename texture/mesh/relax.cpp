// As repulsion.cpp, but Gauss-Seidel instead of Jacobi: half as many sweeps, and in a patch that fits into
// the cache each takes half the time.
#include "texture/mesh/relax.h"

#include "numerics/lanes.h"
#include "texture/mesh/remesh.h"
#include "texture/mesh/repulsion.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

// One-ring of a vertex, in order.
struct RingLanes {
  static constexpr int kMost = 16;
  int size = 0;
  std::uint32_t vertex[kMost];
  alignas(32) float x[kMost + 8], y[kMost + 8], z[kMost + 8];
  alignas(32) float nx[kMost + 8], ny[kMost + 8], nz[kMost + 8];
  alignas(32) float scale[kMost + 8];

  // False if it is too large, or not all of it belongs to the patch.
  bool gather(const EditableMesh& mesh, const Patches& patches, std::uint32_t patch, std::uint32_t v) {
    size = 0;
    const std::uint32_t start = mesh.outgoing[v];
    std::uint32_t h = start;
    do {
      const std::uint32_t u = mesh.target(h);
      if (size == kMost || patches.of[u] != patch) return false;
      vertex[size++] = u;
      h = mesh.twin[EditableMesh::previous(h)];
    } while (h != start);
    for (int k = 0; k < size; ++k) {
      const Vec3f &p = mesh.position[vertex[k]], &n = mesh.normal[vertex[k]];
      x[k] = p.x(), y[k] = p.y(), z[k] = p.z();
      nx[k] = n.x(), ny[k] = n.y(), nz[k] = n.z();
      scale[k] = mesh.scaleAt(vertex[k]);
    }
    x[size] = x[0], y[size] = y[0], z[size] = z[0];
    nx[size] = nx[0], ny[size] = ny[0], nz[size] = nz[0];
    for (int k = size; k < ((size + 7) & ~7); ++k) scale[k] = 0.0f;
    for (int k = size + 1; k <= ((size + 7) & ~7); ++k) {
      x[k] = y[k] = z[k] = 1e9f;
      nx[k] = ny[k] = nz[k] = 0.0f;
    }
    return true;
  }
};

Float8 squareRoot8(const Float8& v) {
  Float8 root;
  for (int k = 0; k < 8; ++k) root[k] = std::sqrt(v[k]);
  return root;
}

// Displacement of the centre by its ring, for a step length of 1. range: at scale 1.
Vec3f push(const RingLanes& ring, const Vec3f& at, float ownScale, float range) {
  Float8 sx{}, sy{}, sz{};
  for (int k = 0; k < ring.size; k += 8) {
    const Float8 dx = at.x() - load8(ring.x + k), dy = at.y() - load8(ring.y + k),
                 dz = at.z() - load8(ring.z + k);
    const Float8 d2 = dx * dx + dy * dy + dz * dz;
    Float8 weight = range * 0.5f * (ownScale + load8(ring.scale + k)) / squareRoot8(d2) - 1.0f;
    weight = (d2 > 0.0f) & (weight > 0.0f) ? weight : Float8{};
    // The ring is closed: its last vertex is followed by its first.
    if (ring.size - k < 8) weight[ring.size - k] = 0.0f;
    sx += weight * dx;
    sy += weight * dy;
    sz += weight * dz;
  }
  return Vec3f(sum8(sx), sum8(sy), sum8(sz));
}

// The triangles around a vertex, if it were at p.
struct Fan {
  bool outward = true;  // all of them
  // Cotangents of the k-th triangle's angles at ring vertices k + 1 and k.
  alignas(32) float next[RingLanes::kMost], own[RingLanes::kMost];

  // Whether opposite angles at each edge from the centre sum to at most pi.
  bool delaunay(int size) const {
    float before = own[size - 1];
    bool all = true;
    for (int k = 0; k < size; ++k) {
      all = all && next[k] + before >= 0.0f;
      before = own[k];
    }
    return all;
  }
};

void look(const RingLanes& ring, const Vec3f& p, const Vec3f& n, Fan& fan) {
  fan.outward = true;
  for (int k = 0; k < ring.size; k += 8) {
    const Float8 ux = load8(ring.x + k) - p.x(), uy = load8(ring.y + k) - p.y(),
                 uz = load8(ring.z + k) - p.z();
    const Float8 vx = load8(ring.x + k + 1) - p.x(), vy = load8(ring.y + k + 1) - p.y(),
                 vz = load8(ring.z + k + 1) - p.z();
    const Float8 cx = uy * vz - uz * vy, cy = uz * vx - ux * vz, cz = ux * vy - uy * vx;
    const Float8 length2 = cx * cx + cy * cy + cz * cz;
    const Float8 a = cx * n.x() + cy * n.y() + cz * n.z();
    const Float8 b = cx * load8(ring.nx + k) + cy * load8(ring.ny + k) + cz * load8(ring.nz + k);
    const Float8 c = cx * load8(ring.nx + k + 1) + cy * load8(ring.ny + k + 1) + cz * load8(ring.nz + k + 1);
    Float8 worst = a < b ? a : b;
    worst = worst < c ? worst : c;
    const Float8 uu = ux * ux + uy * uy + uz * uz, vv = vx * vx + vy * vy + vz * vz,
                 uv = ux * vx + uy * vy + uz * vz, ww = uu + vv - 2.0f * uv;
    Float8 longest2 = uu > vv ? uu : vv;
    longest2 = longest2 > ww ? longest2 : ww;
    const auto good = (worst > 0.0f) & (worst * worst >= kFacing * kFacing * length2) &
                      (length2 > 1e-10f * longest2 * longest2);
    for (int j = 0; j < std::min(8, ring.size - k); ++j)
      if (!good[j]) fan.outward = false;
    const Float8 perArea = 1.0f / squareRoot8(length2);
    store8(fan.next + k, (vv - uv) * perArea);
    store8(fan.own + k, (uu - uv) * perArea);
  }
}

}  // namespace

void relax(EditableMesh& mesh, const LevelSet& phi, const Patches& patches, float edge, int sweeps,
           float wake, std::vector<std::uint8_t>& awake) {
  // Share of the displacement that would remove the overlap: more than twice what is stable for a Jacobi
  // sweep. At 0.9 points no longer come to rest; from 0.6 on, more of those beside a crease move on the next
  // frame.
  constexpr float kStep = 0.5f;
  constexpr float kStill = 0.005f;  // mean edge lengths: shorter moves are dropped
  forEachPatch(patches, [&](std::uint32_t patch) {
    RingLanes ring;
    Fan fan;
    std::vector<std::uint32_t> stack;
    const auto move = [&](std::uint32_t v) {
      if (!ring.gather(mesh, patches, patch, v)) return;
      const Vec3f from = mesh.position[v];
      const float scale = mesh.scaleAt(v), longest = kLongestMove * edge * scale;
      Vec3f way = push(ring, from, scale, kRepulsionRange * edge) * kStep;
      way -= mesh.normal[v] * mesh.normal[v].dot(way);
      const float size = way.length();
      awake[v] = size >= (awake[v] ? kStill : std::max(kStill, wake)) * edge * scale;
      if (!awake[v]) return;
      if (size > longest) way *= longest / size;
      const LevelSet::Projection p = phi.slide(from + way, reachFor(edge * scale));
      if (!p.known) return;
      look(ring, p.position, p.normal, fan);
      if (!fan.outward) return;
      mesh.position[v] = p.position;
      mesh.normal[v] = p.normal;
      if (phi.scaled()) mesh.scale[v] = phi.scale(p.position);
      if (!fan.delaunay(ring.size)) flipToDelaunay(mesh, patches, patch, v, stack);
    };
    for (int sweep = 0; sweep < sweeps; ++sweep)
      for (std::uint32_t i = patches.first[patch]; i < patches.first[patch + 1]; ++i) move(patches.vertex[i]);
  });
}

}  // namespace fluidtex::texture
