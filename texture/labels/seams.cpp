// Seam cost after Kwatra, Schoedl, Essa, Turk, Bobick: Graphcut Textures (2003); minimised by iterated
// conditional modes.
#include "texture/labels/seams.h"

#include "texture/labels/guidance.h"
#include "texture/loops/complex.h"
#include "texture/loops/parallel.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

// Grain of the parallel loop; a vertex evaluates about a dozen labels.
constexpr std::size_t kSeamGrain = 128;

float length(const Float8& difference, const Float8& weight) {
  return std::sqrt(sum8(weight * difference * difference));
}

// What each end's label predicts at the other end.
struct Across {
  Vec2f vThere, uHere;
};

Across acrossEdge(const SeamModel& model, const Label& atV, const Label& atU, std::uint32_t h) {
  const Complexf& edge = model.view.connection.edge[h];
  return {atV.at(edge), atU.at(-conjugateProduct(model.view.connection.rotation[h], edge))};
}

bool continues(const SeamModel& model, const Label& atV, const Label& atU, const Across& across) {
  const float here = texelDifference(model.image, across.uHere, atV.texel).length();
  const float there = texelDifference(model.image, across.vThere, atU.texel).length();
  return here + there < 2.0f * kCoherent;
}

// Where the labels do not continue each other.
float seamCost(const SeamModel& model, const Across& across, const Float8& valueV, const Float8& valueU) {
  const Float8 atEnd = model.image.sample(across.vThere) - valueU;
  const Float8 atStart = model.image.sample(across.uHere) - valueV;
  return kSeamLength +
         (length(atEnd, model.channelWeight) + length(atStart, model.channelWeight)) / model.unit;
}

// Greedy colouring of the free vertices: neighbours differ in colour.
std::vector<std::vector<std::uint32_t>> colored(const VertexGraph& graph,
                                                const std::vector<std::uint8_t>& free) {
  const std::size_t count = graph.first.size() - 1;
  std::vector<std::vector<std::uint32_t>> classes;
  std::vector<std::int16_t> color(count, -1);
  for (std::uint32_t v = 0; v < count; ++v) {
    if (!free.empty() && !free[v]) continue;
    std::uint64_t taken = 0;
    for (const std::uint32_t u : graph.around(v))
      if (color[u] >= 0) taken |= std::uint64_t(1) << std::min<int>(color[u], 63);
    int own = 0;
    while (own < 63 && (taken >> own & 1)) ++own;
    if (own == 63) continue;  // vertices with that many neighbours keep their label
    color[v] = std::int16_t(own);
    if (std::size_t(own) >= classes.size()) classes.resize(std::size_t(own) + 1);
    classes[std::size_t(own)].push_back(v);
  }
  return classes;
}

}  // namespace

float labelCost(const SeamModel& model, const LabelTerms& terms, const Label& label, const Float8& value,
                std::uint32_t v) {
  float cost =
      terms.stretch * std::log(stretch(label)) + guidanceCost(model.image, model.view.mesh, label.texel, v);
  if (terms.wanted) cost += terms.data * length(value - (*terms.wanted)[v], model.channelWeight) / model.unit;
  return cost;
}

float seamUnit(const TexelImage& image, const Float8& channelWeight) {
  return std::max(randomDifference(image, channelWeight), 1e-6f);
}

SeamModel makeSeamModel(const MeshView& view, const TexelImage& image, const Float8& channelWeight) {
  return {view, image, channelWeight, seamUnit(image, channelWeight)};
}

bool continues(const SeamModel& model, const Label& atV, const Label& atU, std::uint32_t h) {
  return continues(model, atV, atU, acrossEdge(model, atV, atU, h));
}

float seamCost(const SeamModel& model, const Label& atV, const Label& atU, std::uint32_t h) {
  const Across across = acrossEdge(model, atV, atU, h);
  if (continues(model, atV, atU, across)) return 0.0f;
  return seamCost(model, across, model.image.sample(atV.texel), model.image.sample(atU.texel));
}

float seamCost(const SeamModel& model, const Label& atV, const Float8& valueV, const Label& atU,
               const Float8& valueU, std::uint32_t h) {
  const Across across = acrossEdge(model, atV, atU, h);
  return continues(model, atV, atU, across) ? 0.0f : seamCost(model, across, valueV, valueU);
}

float seamCostAround(const SeamModel& model, const Labels& labels, std::uint32_t v) {
  const VertexGraph& graph = model.view.graph;
  float sum = 0.0f;
  for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h) {
    const std::uint32_t u = graph.neighbor[h];
    if (!model.slides(v, u)) sum += seamCost(model, labels[v], labels[u], h);
  }
  return sum / float(graph.around(v).size());
}

void straightenSeams(const SeamModel& model, const LabelTerms& terms, const std::vector<std::uint8_t>& free,
                     const Labels* alternative, int sweeps, Labels& labels) {
  const VertexGraph& graph = model.view.graph;
  const std::vector<std::vector<std::uint32_t>> classes = colored(graph, free);
  std::vector<std::uint8_t> active(labels.size(),
                                   1);  // the surroundings have changed since the last visit
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    std::vector<std::uint8_t> changed(labels.size(), 0);
    for (const std::vector<std::uint32_t>& members : classes) {
      forEachIndex(
          members.size(),
          [&](std::uint32_t i) {
            const std::uint32_t v = members[i];
            if (!active[v]) return;
            const std::uint32_t begin = graph.first[v], end = graph.first[v + 1];
            const auto costOf = [&](const Label& label, float bound) {
              const Float8 value = model.image.sample(label.texel);
              float cost = labelCost(model, terms, label, value, v);
              for (std::uint32_t h = begin; h < end && cost < bound; ++h)
                cost += seamCost(model, label, labels[graph.neighbor[h]], h);
              return cost;
            };
            constexpr float kAny = 1e30f;
            constexpr float kGain = 1e-4f;  // above rounding
            const float present = costOf(labels[v], kAny);
            float least = present;
            Label best = labels[v];
            const auto offer = [&](const Label& label) {
              if (texelDifference(model.image, label.texel, best.texel).lengthSqr() < 0.04f) return;
              const float cost = costOf(label, least);
              if (cost < least - kGain) least = cost, best = label;
            };
            for (std::uint32_t h = begin; h < end; ++h) {
              const Label& other = labels[graph.neighbor[h]];
              const Label here = continued(model.image, other, model.view.connection.edge[h],
                                           model.view.connection.rotation[h]);
              if (texelDifference(model.image, here.texel, labels[v].texel).lengthSqr() >
                  kCoherent * kCoherent)
                offer(here);
            }
            if (alternative) offer((*alternative)[v]);
            if (least < present) {
              labels[v] = best;
              changed[v] = 1;
            }
          },
          kSeamGrain);
    }
    std::fill(active.begin(), active.end(), 0);
    bool any = false;
    for (std::uint32_t v = 0; v < labels.size(); ++v) {
      if (!changed[v]) continue;
      any = true;
      active[v] = 1;
      for (const std::uint32_t u : graph.around(v)) active[u] = 1;
    }
    if (!any) break;
  }
}

}  // namespace fluidtex::texture
