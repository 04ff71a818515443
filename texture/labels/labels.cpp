#include "texture/labels/labels.h"

#include "numerics/random.h"
#include "texture/labels/guidance.h"
#include "texture/labels/ways.h"
#include "texture/loops/complex.h"
#include "texture/loops/parallel.h"
#include "texture/loops/point_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fluidtex::texture {
namespace {

constexpr std::uint64_t kGuidedPlaces =
    32;  // random places tried per block until its centre has the wanted level
constexpr std::uint64_t kWayOfBlock = 1ull << 40;  // keys apart from those of the places

}  // namespace

Lay layOf(const Label& label, const Ways& ways) {
  const std::array<float, 4>& j = label.jacobian;
  // Conformal and anticonformal part of the Jacobian: the nearest rotation, and the nearest reflection.
  const Complexf keep(j[0] + j[3], j[2] - j[1]), flip(j[3] - j[0], -j[1] - j[2]);
  const bool mirrored = ways.mirrored && isMirrored(label);
  const Complexf& part = mirrored ? flip : keep;
  const float size = std::abs(part);
  return size > 1e-6f ? Lay{part / size, mirrored} : Lay{};
}

Label unstretched(const Vec2f& texel, const Lay& lay) {
  const float c = lay.turn.real(), s = lay.turn.imag();
  return lay.mirrored ? Label{texel, {-c, -s, -s, c}} : Label{texel, {c, -s, s, c}};
}

namespace {

// Of singular values.
float stretch(float largest, float smallest) {
  constexpr float kTorn = 1e3f;
  if (!(smallest > 1.0f / kTorn) || !(largest < kTorn)) return kTorn;
  return std::max(largest, 1.0f / smallest);
}

}  // namespace

float stretch(const Label& label) {
  const std::array<float, 4>& j = label.jacobian;
  // Singular values from the conformal and the anticonformal part.
  const float keep = std::hypot(j[0] + j[3], j[2] - j[1]), flip = std::hypot(j[0] - j[3], j[1] + j[2]);
  return stretch(0.5f * (keep + flip), 0.5f * std::abs(keep - flip));
}

float stretch(const TexelGradient& gradient, double spacing) {
  // Of the 2 x 3 matrix J of rows s and t: the eigenvalues of J J^T.
  const float ss = gradient.s.lengthSqr(), tt = gradient.t.lengthSqr(), st = gradient.s.dot(gradient.t);
  const float mean = 0.5f * (ss + tt), spread = std::hypot(0.5f * (ss - tt), st);
  const auto scale = float(spacing);
  return stretch(std::sqrt(mean + spread) * scale, std::sqrt(std::max(mean - spread, 0.0f)) * scale);
}

Label labelOf(const SurfaceMesh& mesh, std::uint32_t v, const Vec2f& coordinate,
              const TexelGradient& gradient) {
  const auto scale = float(mesh.spacingAt(v));
  const Vec3f &d = mesh.orientation[v], b = rowAxis(d, mesh.normals[v]);
  return {coordinate,
          {gradient.s.dot(d) * scale, gradient.s.dot(b) * scale, gradient.t.dot(d) * scale,
           gradient.t.dot(b) * scale}};
}

Labels labelsOf(const SurfaceMesh& mesh, const std::vector<Vec2f>& coordinate,
                const std::vector<TexelGradient>& gradient) {
  Labels labels(coordinate.size());
  forEachIndex(labels.size(),
               [&](std::uint32_t v) { labels[v] = labelOf(mesh, v, coordinate[v], gradient[v]); });
  return labels;
}

TexelGradient gradientOf(const Label& label, const Vec3f& orientation, const Vec3f& normal, double spacing) {
  const Vec3f b = rowAxis(orientation, normal);
  const auto scale = float(1.0 / spacing);
  return {(orientation * label.jacobian[0] + b * label.jacobian[1]) * scale,
          (orientation * label.jacobian[2] + b * label.jacobian[3]) * scale};
}

Values lookUp(const TexelImage& image, const Labels& labels) {
  Values values(labels.size());
  forEachIndex(labels.size(), [&](std::uint32_t v) { values[v] = image.sample(labels[v].texel); });
  return values;
}

Labels blockLabels(const MeshView& view, const TexelImage& image, float size, std::uint64_t seed) {
  // Seeds lie about 0.7 sizes apart; no part reaches much farther than `reach` from its seed.
  const float reach = 0.55f * size;
  const std::vector<std::uint32_t> seeds = selectCenters(view, reach);
  const std::size_t count = view.mesh.positions.size();
  Labels labels(count);
  std::vector<std::uint32_t> part(count, kNone), ring(count, kNone), queue;
  for (std::uint32_t i = 0; i < seeds.size(); ++i) {
    const auto place = [&](std::uint64_t key) {
      const Vec2f random(float(randomUnit(key, 2 * i)) * float(image.width - 1),
                         float(randomUnit(key, 2 * i + 1)) * float(image.height - 1));
      return image.centerFor(random, reach);
    };
    Vec2f chosen = place(seed);
    if (isGuided(image, view.mesh)) {
      const auto cost = [&](const Vec2f& texel) { return guidanceCost(image, view.mesh, texel, seeds[i]); };
      for (std::uint64_t k = 1; k < kGuidedPlaces && cost(chosen) > 0.0f; ++k) {
        const Vec2f other = place(randomBits(seed, k));
        if (cost(other) < cost(chosen)) chosen = other;
      }
    }
    const auto way = int(randomBits(seed, kWayOfBlock + i) % std::uint64_t(countOf(image.ways)));
    labels[seeds[i]] = unstretched(chosen, layOf(wayAt(image.ways, way)));
    part[seeds[i]] = i;
    ring[seeds[i]] = 0;
    queue.push_back(seeds[i]);
  }
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const std::uint32_t v = queue[i];
    for (std::uint32_t h = view.graph.first[v]; h < view.graph.first[v + 1]; ++h) {
      const std::uint32_t u = view.graph.neighbor[h];
      if (ring[u] != kNone) continue;
      ring[u] = ring[v] + 1;
      part[u] = part[v];
      queue.push_back(u);
    }
  }
  // Ring by ring: a vertex takes the mean of the predictions of its placed neighbours of the same part.
  for (std::size_t i = seeds.size(); i < queue.size(); ++i) {
    const std::uint32_t v = queue[i];
    Vec2f texel(0.0f, 0.0f);
    Complexf turn(0.0f);
    bool mirrored = false;  // the same all over the part
    int found = 0;
    for (std::uint32_t h = view.graph.first[v]; h < view.graph.first[v + 1]; ++h) {
      const std::uint32_t u = view.graph.neighbor[h];
      if (part[u] != part[v] || ring[u] >= ring[v]) continue;
      const Complexf& rotation = view.connection.rotation[h];
      texel += labels[u].at(-conjugateProduct(rotation, view.connection.edge[h]));
      const Lay lay = seenFrom(layOf(labels[u], image.ways), std::conj(rotation));
      turn += lay.turn;
      mirrored = lay.mirrored;
      ++found;
    }
    const float norm = std::abs(turn);
    labels[v] = unstretched(texel / float(found), {norm > 1e-6f ? turn / norm : Complexf(1.0f), mirrored});
  }
  for (Label& label : labels) label.texel = image.brought(label.texel);
  return labels;
}

Labels refineLabels(const SurfaceMesh& coarse, const Labels& labels, const SurfaceMesh& fine,
                    const TexelImage& fineImage) {
  // A fine vertex searches the 27 cells around it, then everywhere.
  double cell = 1.5 * coarse.spacing;
  if (!coarse.scale.empty()) cell *= *std::max_element(coarse.scale.begin(), coarse.scale.end());
  const PointGrid grid(coarse.positions, cell);
  Labels result(fine.positions.size());
  forEachIndex(result.size(), [&](std::uint32_t v) {
    const Vec3f& x = fine.positions[v];
    std::uint32_t best = kNone;
    float bestDistance = std::numeric_limits<float>::max();
    const auto offer = [&](std::uint32_t u) {
      float distance = (coarse.positions[u] - x).lengthSqr();
      if (coarse.normals[u].dot(fine.normals[v]) < 0.3f) distance += float(9.0 * cell * cell);
      if (distance < bestDistance) bestDistance = distance, best = u;
    };
    grid.visitNear(x, offer);
    if (best == kNone)  // a drop that the coarser level has lost
      for (std::uint32_t u = 0; u < coarse.positions.size(); ++u) offer(u);
    if (best == kNone) return;

    const Vec3f &d = coarse.orientation[best], b = rowAxis(d, coarse.normals[best]);
    const Vec3f way = x - coarse.positions[best];
    const auto scale = float(1.0 / coarse.spacingAt(best));
    const Vec2f texel = labels[best].at(Complexf(way.dot(d) * scale, way.dot(b) * scale));
    Complexf turn(fine.orientation[v].dot(d),
                  fine.orientation[v].dot(b));  // from the fine vertex's axes to the coarse one's
    const float norm = std::abs(turn);
    turn = norm > 1e-6f ? turn / norm : Complexf(1.0f);
    const std::array<float, 4>& j = labels[best].jacobian;
    const float c = turn.real(), s = turn.imag();
    // Halving averages texels 2i and 2i + 1: the centre of texel i lies at 2i + 1/2.
    result[v].texel = fineImage.brought(texel * 2.0f + Vec2f(0.5f, 0.5f));
    result[v].jacobian = {j[0] * c + j[1] * s, j[1] * c - j[0] * s, j[2] * c + j[3] * s, j[3] * c - j[2] * s};
  });
  return result;
}

Label continued(const TexelImage& image, const Label& label, const Complexf& edge, const Complexf& rotation) {
  // In the label's axes the edge is conj(rotation) * edge; the vector to the neighbour is its negative.
  Label result;
  result.texel = image.brought(label.at(-conjugateProduct(rotation, edge)));
  const std::array<float, 4>& j = label.jacobian;
  const float c = rotation.real(), s = -rotation.imag();  // conj(rotation) as the matrix (c, -s; s, c)
  result.jacobian = {j[0] * c + j[1] * s, j[1] * c - j[0] * s, j[2] * c + j[3] * s, j[3] * c - j[2] * s};
  return result;
}

void handOn(const TexelImage& image, const MeshView& view, const std::vector<std::uint8_t>& wanted,
            std::vector<std::uint8_t> placed, Labels& labels, HandOn how) {
  std::vector<std::uint32_t> front, next;
  std::vector<std::uint8_t> reached = placed;
  const auto mayTake = [&](std::uint32_t h) {
    const Label& label = labels[view.graph.neighbor[h]];
    return how == HandOn::everywhere ||
           liesOn(image, label.at(-conjugateProduct(view.connection.rotation[h], view.connection.edge[h])));
  };
  for (std::uint32_t v = 0; v < placed.size(); ++v)
    if (placed[v]) front.push_back(v);
  while (!front.empty()) {
    next.clear();
    for (const std::uint32_t v : front)
      for (const std::uint32_t u : view.graph.around(v)) {
        if (reached[u] || !wanted[u]) continue;
        reached[u] = 1;
        next.push_back(u);
      }
    front.clear();
    for (const std::uint32_t v : next) {
      float nearest = std::numeric_limits<float>::infinity();
      std::uint32_t from = 0;
      for (std::uint32_t h = view.graph.first[v]; h < view.graph.first[v + 1]; ++h) {
        const float distance = std::norm(view.connection.edge[h]);
        if (placed[view.graph.neighbor[h]] && distance < nearest && mayTake(h)) nearest = distance, from = h;
      }
      if (nearest == std::numeric_limits<float>::infinity()) {
        reached[v] = 0;  // may be reached later from another side
        continue;
      }
      labels[v] = continued(image, labels[view.graph.neighbor[from]], view.connection.edge[from],
                            view.connection.rotation[from]);
      front.push_back(v);
    }
    for (const std::uint32_t v : front) placed[v] = 1;
  }
}

}  // namespace fluidtex::texture
