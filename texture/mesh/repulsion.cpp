#include "texture/mesh/repulsion.h"

#include "texture/loops/parallel.h"
#include "texture/mesh/remesh.h"

#include <algorithm>
#include <atomic>
#include <cmath>

namespace fluidtex::texture {

// Displacement of a vertex in one sweep, tangent to the surface.
Vec3f Repulsion::push(std::uint32_t v) const {
  constexpr float kStep = 0.2f;  // of the distance that would undo the overlap: stable for six neighbours
  const float own = m_mesh.scaleAt(v);
  const Vec3f at = m_mesh.position[v];
  Vec3f sum(0.0f);
  m_mesh.around(v, [&](std::uint32_t h) {
    const std::uint32_t u = m_mesh.target(h);
    const float range = kRepulsionRange * m_edge * 0.5f * (own + m_mesh.scaleAt(u));
    const Vec3f away = at - m_mesh.position[u];
    const float distance2 = away.lengthSqr();
    if (distance2 > 0.0f && distance2 < range * range) sum += away * (range / std::sqrt(distance2) - 1.0f);
  });
  sum *= kStep;
  sum -= m_mesh.normal[v] * m_mesh.normal[v].dot(sum);
  return sum;
}

void Repulsion::sweep(std::vector<std::uint32_t>& active, float wake, float sleep) {
  // Share of the last displacement: halves the number of sweeps that long waves of density take to level out.
  constexpr float kMomentum = 0.5f;
  m_last.resize(m_mesh.vertexCount(), Vec3f(0.0f));
  // Where the movers go; then where they were.
  m_position.resize(active.size());
  m_normal.resize(active.size());
  forEachIndex(active.size(), [&](std::uint32_t i) {
    const std::uint32_t v = active[i];
    const Vec3f from = m_mesh.position[v];
    Vec3f move = push(v);
    const float edge = m_edge * m_mesh.scaleAt(v), longest = kLongestMove * edge, asleep = sleep * edge;
    const float limit = awake[v] ? asleep : wake * edge;
    awake[v] = move.lengthSqr() > limit * limit;
    if (awake[v]) {
      move += m_last[v] * kMomentum;
      const float size = move.length();
      if (size > longest) move *= longest / size;
      const LevelSet::Projection p = m_phi.slide(from + move, reachFor(edge));
      // At a crease a displacement may move nothing: such vertices are at rest as well.
      awake[v] = p.known && (p.position - from).lengthSqr() > asleep * asleep;
      m_position[i] = p.position;
      m_normal[i] = p.normal;
    }
    m_last[v] = awake[v] ? m_position[i] - from : Vec3f(0.0f);
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < active.size(); ++i) {
    if (!awake[active[i]]) continue;
    if (kept != i) {
      active[kept] = active[i];
      m_position[kept] = m_position[i];
      m_normal[kept] = m_normal[i];
    }
    ++kept;
  }
  active.resize(kept);
  forEachIndex(kept, [&](std::uint32_t i) {
    std::swap(m_mesh.position[active[i]], m_position[i]);
    std::swap(m_mesh.normal[active[i]], m_normal[i]);
    if (m_phi.scaled()) m_mesh.scale[active[i]] = m_phi.scale(m_mesh.position[active[i]]);
  });
  if (revertFolds(active))
    active.erase(std::remove_if(active.begin(), active.end(), [&](std::uint32_t v) { return !awake[v]; }),
                 active.end());
}

// Reverts moves until no triangle is folded that was not before. Terminates: at worst all are reverted.
// Reverted vertices fall asleep. Returns whether there were any.
bool Repulsion::revertFolds(const std::vector<std::uint32_t>& movers) {
  m_undo.resize(m_mesh.vertexCount(), 0);
  const auto raise = [&](std::uint32_t v) {
    std::atomic_ref<std::uint8_t>(m_undo[v]).store(1, std::memory_order_relaxed);
  };
  // Each triangle is checked by the first of its corners that moves.
  const auto inspect = [&](std::uint32_t v) {
    m_mesh.around(v, [&](std::uint32_t h) {
      const std::uint32_t b = m_mesh.target(h), c = m_mesh.opposite(h);
      if ((b < v && awake[b]) || (c < v && awake[c]) || facesOutward(m_mesh, v, b, c)) return;
      raise(v);
      if (awake[b]) raise(b);
      if (awake[c]) raise(c);
    });
  };
  forEachIndex(movers.size(), [&](std::uint32_t i) { inspect(movers[i]); });
  bool any = false;
  while (true) {
    std::vector<std::uint32_t> reverted;  // numbers in movers
    for (std::uint32_t i = 0; i < movers.size(); ++i) {
      if (m_undo[movers[i]] == 1) reverted.push_back(i);
    }
    if (reverted.empty()) break;
    any = true;
    for (std::uint32_t i : reverted) {
      const std::uint32_t v = movers[i];
      m_mesh.position[v] = m_position[i];
      m_mesh.normal[v] = m_normal[i];
      if (m_phi.scaled()) m_mesh.scale[v] = m_phi.scale(m_mesh.position[v]);
      m_undo[v] = 2;
    }
    // Its neighbours may fold now.
    for (std::uint32_t i : reverted) {
      const std::uint32_t v = movers[i];
      m_mesh.around(v, [&](std::uint32_t h) {
        const std::uint32_t b = m_mesh.target(h), c = m_mesh.opposite(h);
        if (facesOutward(m_mesh, v, b, c)) return;
        for (std::uint32_t u : {b, c}) {
          if (awake[u] && m_undo[u] == 0) m_undo[u] = 1;
        }
      });
    }
  }
  if (!any) return false;
  for (std::uint32_t v : movers) {
    if (m_undo[v] == 2) {
      awake[v] = 0;
      m_last[v] = Vec3f(0.0f);
    }
    m_undo[v] = 0;
  }
  return true;
}

}  // namespace fluidtex::texture
