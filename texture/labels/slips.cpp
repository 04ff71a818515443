#include "texture/labels/slips.h"

#include "texture/loops/complex.h"
#include "texture/loops/parallel.h"

#include <array>

namespace fluidtex::texture {
namespace {

// Spreads a slip of half a texel over about two rings to each side. With 16 sweeps and four rings as much
// texture is stretched by 1.4, and more windows are unlike the exemplar's
// (docs/notebook/2026-11-23-synthesis-variants.md).
constexpr int kSweeps = 4;
// Regularisation: the former Jacobian weighs as much as this share of an edge of one pixel in each direction.
constexpr float kInertia = 0.5f;

// Of an edge from v to u: the texel that u's label predicts at v minus v's own, and whether the labels
// continue each other.
struct Slip {
  Vec2f offset{0.0f, 0.0f};
  bool continues = false;
};

std::vector<Slip> slipsOf(const SeamModel& model, const std::vector<std::uint32_t>& members,
                          const Labels& labels) {
  const MeshView& view = model.view;
  std::vector<Slip> slips(view.graph.neighbor.size());
  forEachIndex(members.size(), [&](std::uint32_t i) {
    const std::uint32_t v = members[i];
    for (std::uint32_t h = view.graph.first[v]; h < view.graph.first[v + 1]; ++h) {
      const Label& other = labels[view.graph.neighbor[h]];
      const Vec2f here = other.at(-conjugateProduct(view.connection.rotation[h], view.connection.edge[h]));
      slips[h] = {texelDifference(model.image, here, labels[v].texel), continues(model, labels[v], other, h)};
    }
  });
  return slips;
}

// Regularised least-squares fit of the Jacobian to the edges that continue.
void refit(const SeamModel& model, std::uint32_t v, const std::vector<Slip>& slips, const Labels& labels,
           std::array<float, 4>& jacobian) {
  const MeshView& view = model.view;
  float xx = kInertia, xy = 0.0f, yy = kInertia;
  Vec2f right[2] = {{0.0f, 0.0f}, {0.0f, 0.0f}};  // right-hand sides, for the residual
  for (std::uint32_t h = view.graph.first[v]; h < view.graph.first[v + 1]; ++h) {
    if (!slips[h].continues) continue;
    const Complexf& edge = view.connection.edge[h];
    const Vec2f off = texelDifference(model.image, labels[view.graph.neighbor[h]].texel, labels[v].at(edge));
    xx += edge.real() * edge.real(), xy += edge.real() * edge.imag(), yy += edge.imag() * edge.imag();
    right[0] += off * edge.real(), right[1] += off * edge.imag();
  }
  const float det = xx * yy - xy * xy;
  for (int row = 0; row < 2; ++row) {
    jacobian[std::size_t(2 * row)] += (right[0][row] * yy - right[1][row] * xy) / det;
    jacobian[std::size_t(2 * row + 1)] += (right[1][row] * xx - right[0][row] * xy) / det;
  }
}

}  // namespace

void closeSlips(const SeamModel& model, const std::vector<std::uint8_t>& free, Labels& labels) {
  const VertexGraph& graph = model.view.graph;
  std::vector<std::uint32_t> members;
  for (std::uint32_t v = 0; v < labels.size(); ++v)
    if (free.empty() || free[v]) members.push_back(v);
  if (members.empty()) return;
  const std::vector<Slip> slips = slipsOf(model, members, labels);

  std::vector<Vec2f> shift(labels.size(), Vec2f(0.0f, 0.0f)), next = shift;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    forEachIndex(members.size(), [&](std::uint32_t i) {
      const std::uint32_t v = members[i];
      Vec2f sum = shift[v];
      float count = 1.0f;
      for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h) {
        if (!slips[h].continues) continue;
        sum += shift[graph.neighbor[h]] + slips[h].offset;
        count += 1.0f;
      }
      next[v] = sum / count;
    });
    shift.swap(next);
  }
  forEachIndex(members.size(), [&](std::uint32_t i) {
    labels[members[i]].texel = model.image.brought(labels[members[i]].texel + shift[members[i]]);
  });
  // Reads only the texels of neighbours, so the order does not matter.
  forEachIndex(members.size(), [&](std::uint32_t i) {
    refit(model, members[i], slips, labels, labels[members[i]].jacobian);
  });
}

}  // namespace fluidtex::texture
