// Seams: edges of the mesh across which the labels of the two ends do not continue each other.
#pragma once

#include "texture/labels/labels.h"

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// What seam costs are computed from.
struct SeamModel {
  MeshView view;
  const TexelImage& image;
  Float8 channelWeight{};  // on squared differences
  float unit = 1.0f;       // unit of cost: rms difference of random texels
  // #V (null: none), Carried::stays. Edges between a vertex that stays and one that does not cost nothing in
  // seamCostAround(), since the texture on one side moves past that on the other.
  const std::vector<std::uint8_t>* stays = nullptr;
  // #V (null: none), VertexTexture::original. Original labels may be mirrored, or lie beyond the edge of the
  // exemplar.
  const std::vector<std::uint8_t>* original = nullptr;

  bool isOriginal(std::uint32_t v) const {
    return original != nullptr && !original->empty() && (*original)[v] != 0;
  }
  bool slides(std::uint32_t v, std::uint32_t u) const {
    return stays != nullptr && !stays->empty() && (*stays)[v] != (*stays)[u];
  }
};
// Unit of cost for an exemplar. Scans the image: keep the result.
float seamUnit(const TexelImage& image, const Float8& channelWeight);
SeamModel makeSeamModel(const MeshView& view, const TexelImage& image, const Float8& channelWeight);

// Whether two labels at the ends of edge h, from v to u, continue each other (kCoherent).
bool continues(const SeamModel& model, const Label& atV, const Label& atU, std::uint32_t h);

// Cost of edge h, from v to u: zero where the labels continue each other, else kSeamLength + (|A(v) - B(v)| +
// |A(u) - B(u)|) / model.unit. A and B: image values at the texels that the two labels predict at a vertex.
// The norm is weighted by model.channelWeight and not squared, so that this is a metric on labels [Kwatra03].
float seamCost(const SeamModel& model, const Label& atV, const Label& atU, std::uint32_t h);
// The same for texels that have been looked up already.
float seamCost(const SeamModel& model, const Label& atV, const Float8& valueV, const Label& atU,
               const Float8& valueU, std::uint32_t h);
inline constexpr float kSeamLength = 0.1f;

// Mean of seamCost() over a vertex's edges, of which those cost nothing that texture slides along.
float seamCostAround(const SeamModel& model, const Labels& labels, std::uint32_t v);

// Weights of a vertex's unary cost.
struct LabelTerms {
  float stretch = 1.0f;            // on log stretch()
  float data = 0.0f;               // data term: on the difference from `wanted`, in units
  const Values* wanted = nullptr;  // #V: picture of the data term; null: none
  float usage =
      0.0f;  // on the use of that part of the exemplar beyond the mean; label expansion alone counts it
};

// Unary cost of a label at v, with guidance, without usage. value: the image at its texel.
float labelCost(const SeamModel& model, const LabelTerms& terms, const Label& label, const Float8& value,
                std::uint32_t v);

// Iterated conditional modes: each free vertex (`free` #V; empty: all) takes the label of least cost among
// its own, its neighbours' continued ones and that of `alternative` (#V; null: none). Cost: unary terms plus
// seams on its edges. The sum over the surface falls with every change. Vertices of one colour of a graph
// colouring move at once.
void straightenSeams(const SeamModel& model, const LabelTerms& terms, const std::vector<std::uint8_t>& free,
                     const Labels* alternative, int sweeps, Labels& labels);

}  // namespace fluidtex::texture
