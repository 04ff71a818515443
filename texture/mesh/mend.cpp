// Local hill climbing after Hoppe et al., "Mesh optimization" (1993), with the faults of triangles as energy.
#include "texture/mesh/mend.h"

#include "texture/loops/parallel.h"
#include "texture/mesh/remesh.h"

#include <algorithm>
#include <cmath>
#include <deque>

namespace fluidtex::texture {
namespace {

struct Mender {
  EditableMesh& mesh;
  const LevelSet& phi;
  float spacing;  // voxels

  // Voxels: the larger of voxel and spacing.
  float unitAt(const Vec3f& x) const { return std::max(1.0f, spacing * phi.scale(x)); }

  // Badness of a triangle; 0 for one without faults.
  float badness(const Vec3f& a, const Vec3f& b, const Vec3f& c) const {
    constexpr float kFar = 0.4f;       // units
    constexpr float kSlim = 0.1325f;   // the square of the sine of a little more than 20 degrees
    constexpr float kFlat = 0.05f;     // a gradient smaller than this points nowhere
    constexpr float kOutward = 0.05f;  // cosine
    constexpr float kLong = 2.0f;      // spacings
    constexpr float kFoldWeight = 4.0f, kFarWeight = 2.0f, kSlimWeight = 1.0f, kLongWeight = 0.5f;
    const Vec3f u = b - a, v = c - a, w = c - b;
    const Vec3f normal = u.cross(v);
    const float area2 = normal.lengthSqr();
    const float uu = u.lengthSqr(), vv = v.lengthSqr(), ww = w.lengthSqr();
    float bad = 0.0f;
    // The smallest angle lies between the two longest sides.
    const float sides = uu * vv * ww / std::min({uu, vv, ww});
    const float sine2 = sides > 0.0f ? area2 / sides : 0.0f;
    if (sine2 < kSlim) bad += kSlimWeight * (0.5f + 0.5f * (1.0f - sine2 / kSlim));
    const float most = kLong * spacing * phi.scale(a), longest2 = std::max({uu, vv, ww});
    if (longest2 > most * most) bad += kLongWeight * std::sqrt(longest2) / most;
    const Vec3f centre = (a + b + c) / 3.0f;
    const LevelSet::Sample s = phi.sample(centre);
    if (!s.known) return bad + kFoldWeight;
    const float unit = unitAt(centre);
    const float slope = s.gradient.length(), away = std::abs(s.value) / unit;
    if (slope > kFlat) {
      const float facing = area2 > 0.0f ? normal.dot(s.gradient) / (std::sqrt(area2) * slope) : -1.0f;
      if (facing < kOutward) bad += kFoldWeight * (1.0f + kOutward - facing);
    }
    if (away > kFar) bad += kFarWeight * (1.0f + away / kFar);
    for (const Vec3f* corner : {&a, &b, &c}) {
      const LevelSet::Sample at = phi.sample(*corner);
      const float off = at.known ? std::abs(at.value) / unit : 1.0f;
      if (off > kFar) bad += kFarWeight * (1.0f + off / kFar);
    }
    return bad;
  }
  float badness(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return badness(mesh.position[a], mesh.position[b], mesh.position[c]);
  }
  float badnessOf(std::uint32_t h) const { return badness(mesh.origin[h], mesh.target(h), mesh.opposite(h)); }
  // Badness of the triangles around v if it were at `at`, without those that also touch `except`.
  float around(std::uint32_t v, const Vec3f& at, std::uint32_t except = kNone) const {
    float sum = 0.0f;
    mesh.around(v, [&](std::uint32_t h) {
      const std::uint32_t b = mesh.target(h), c = mesh.opposite(h);
      if (b != except && c != except) sum += badness(at, mesh.position[b], mesh.position[c]);
    });
    return sum;
  }

  struct Step {
    enum Kind { none, flip, collapse, split, move } kind = none;
    float gain = 1e-3f;  // no step is worth less
    std::uint32_t h = kNone;
    Vec3f at{0.0f};
  };

  void offer(Step& best, const Step& step) const {
    if (step.gain > best.gain) best = step;
  }

  void tryEdge(std::uint32_t h, Step& best) const {
    const std::uint32_t t = mesh.twin[h];
    const std::uint32_t a = mesh.origin[h], b = mesh.origin[t], c = mesh.opposite(h), d = mesh.opposite(t);
    const float both = badness(a, b, c) + badness(b, a, d);
    if (mesh.canFlip(h))
      offer(best, {Step::flip, both - badness(a, d, c) - badness(d, b, c), h, Vec3f(0.0f)});
    const Vec3f middle = (mesh.position[a] + mesh.position[b]) * 0.5f;
    const LevelSet::Projection p = phi.project(middle, 0.5f * unitAt(middle));
    const Vec3f m = p.known ? p.position : middle;
    const Vec3f &pa = mesh.position[a], &pb = mesh.position[b], &pc = mesh.position[c],
                &pd = mesh.position[d];
    offer(best,
          {Step::split,
           both - badness(m, pb, pc) - badness(m, pc, pa) - badness(m, pa, pd) - badness(m, pd, pb), h, m});
    for (const std::uint32_t e : {h, t}) {
      if (!mesh.canCollapse(e)) continue;
      const std::uint32_t gone = mesh.origin[e], left = mesh.target(e);
      offer(best,
            {Step::collapse, around(gone, mesh.position[gone]) - around(gone, mesh.position[left], left), e,
             mesh.position[left]});
    }
  }

  void tryVertex(std::uint32_t h, Step& best) const {
    const std::uint32_t v = mesh.origin[h];
    Vec3f sum(0.0f);
    int count = 0;
    mesh.around(v, [&](std::uint32_t e) {
      sum += mesh.position[mesh.target(e)];
      ++count;
    });
    const float now = around(v, mesh.position[v]);
    const Vec3f mean = sum / float(count);
    const float unit = unitAt(mesh.position[v]);
    for (const float share : {1.0f, 0.5f, 0.0f}) {
      const LevelSet::Projection p = phi.project(mesh.position[v] + (mean - mesh.position[v]) * share, unit);
      if (p.known) offer(best, {Step::move, now - around(v, p.position), h, p.position});
    }
  }

  Vec3f normalAt(const Vec3f& at, const Vec3f& otherwise) const {
    const Vec3f gradient = phi.sample(at).gradient;
    const float length = gradient.length();
    return length > 0.0f ? gradient / length : otherwise;
  }

  // Applies the best step at the triangle of h. Returns a vertex all of whose triangles may have changed.
  std::uint32_t improve(std::uint32_t h) {
    Step best;
    std::uint32_t corner = h - h % 3;
    for (int k = 0; k < 3; ++k, ++corner) {
      tryEdge(corner, best);
      tryVertex(corner, best);
    }
    switch (best.kind) {
      case Step::none:
        return kNone;
      case Step::flip:
        mesh.flip(best.h);
        return mesh.origin[best.h];
      case Step::split: {
        const Vec3f otherwise = mesh.normal[mesh.origin[best.h]];
        return mesh.splitEdge(best.h, best.at, normalAt(best.at, otherwise));
      }
      case Step::collapse: {
        const std::uint32_t left = mesh.target(best.h);
        mesh.collapse(best.h);
        return left;
      }
      case Step::move: {
        const std::uint32_t v = mesh.origin[best.h];
        mesh.position[v] = best.at;
        mesh.normal[v] = normalAt(best.at, mesh.normal[v]);
        return v;
      }
    }
    return kNone;
  }
};

}  // namespace

void mend(EditableMesh& mesh, const LevelSet& phi, float spacing) {
  // Triangles whose corner normals agree that well follow the surface and need not be sampled.
  constexpr float kSmooth = 0.9f;
  constexpr std::size_t kStepsPerTriangle = 12;
  Mender mender{mesh, phi, spacing};
  const auto isBad = [&](std::uint32_t h) { return mender.badnessOf(h) > 0.0f; };
  using HalfEdges = std::vector<std::uint32_t>;
  const HalfEdges bad =
      gathered<std::uint32_t>(mesh.halfEdgeCount() / 3, [&](std::uint32_t t, HalfEdges& found) {
        constexpr float kRound = 0.25f;  // squared sine of an angle that is far from slim
        const std::uint32_t h = 3 * t;
        if (!mesh.alive(h)) return;
        const std::uint32_t a = mesh.origin[h], b = mesh.target(h), c = mesh.opposite(h);
        const Vec3f u = mesh.position[b] - mesh.position[a], v = mesh.position[c] - mesh.position[a],
                    w = v - u;
        const Vec3f normal = u.cross(v);
        const float uu = u.lengthSqr(), vv = v.lengthSqr(), ww = w.lengthSqr(), area2 = normal.lengthSqr();
        const float worst =
            std::min({normal.dot(mesh.normal[a]), normal.dot(mesh.normal[b]), normal.dot(mesh.normal[c])});
        if (worst > 0.0f && worst * worst > kSmooth * kSmooth * area2 &&
            area2 * std::min({uu, vv, ww}) > kRound * uu * vv * ww)
          return;
        if (isBad(h)) found.push_back(h);
      });
  std::deque<std::uint32_t> queue(bad.begin(), bad.end());
  std::size_t budget = kStepsPerTriangle * bad.size();
  while (!queue.empty() && budget > 0) {
    const std::uint32_t h = queue.front();
    queue.pop_front();
    if (!mesh.alive(h) || !isBad(h)) continue;
    --budget;
    const std::uint32_t v = mender.improve(h);
    if (v == kNone) continue;
    mesh.around(v, [&](std::uint32_t e) {
      if (isBad(e)) queue.push_back(e - e % 3);
    });
  }
}

}  // namespace fluidtex::texture
