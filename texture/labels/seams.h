// Seams: edges of the mesh across which the labels of the two ends do not continue each other.
#pragma once

#include "texture/labels/labels.h"

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// What seams are judged by.
struct SeamModel {
  MeshView view;
  const TexelImage& image;
  Float8 channelWeight{};  // of squared differences
  float unit = 1.0f;       // the difference of random texels: costs are in these units
};
// The unit of an exemplar: a scan of the image, to be kept where it is asked for again.
float seamUnit(const TexelImage& image, const Float8& channelWeight);
SeamModel makeSeamModel(const MeshView& view, const TexelImage& image, const Float8& channelWeight);

// Whether two labels at the ends of edge h, from v to u, continue each other (kCoherent).
bool continues(const SeamModel& model, const Label& atV, const Label& atU, std::uint32_t h);

// Cost of edge h, from v to u, between two labels: zero where they continue each other, else kSeamLength +
// |A(v) - B(v)| + |A(u) - B(u)|, A and B being what the two put at a place; differences are not squared, so
// that this is a metric in the labels [Kwatra03].
float seamCost(const SeamModel& model, const Label& atV, const Label& atU, std::uint32_t h);
// The same where each label's texel has been read already.
float seamCost(const SeamModel& model, const Label& atV, const Float8& valueV, const Label& atU,
               const Float8& valueU, std::uint32_t h);
inline constexpr float kSeamLength = 0.1f;

// The mean of seamCost() over a vertex's edges.
float seamCostAround(const SeamModel& model, const Labels& labels, std::uint32_t v);

// Terms of a vertex's own cost.
struct LabelTerms {
  float stretch = 1.0f;            // times log stretch()
  float data = 0.0f;               // times the difference, in units, of its texel and `wanted`
  const Values* wanted = nullptr;  // #V, the picture to stay near to; null: none
  float usage =
      0.0f;  // times how much more than the mean its part of the exemplar is used; label expansion only
};

// A label's own cost at v, without usage, with that of guidance. value: the image at its texel.
float labelCost(const SeamModel& model, const LabelTerms& terms, const Label& label, const Float8& value,
                std::uint32_t v);

// Straightens seams and moves them to where they show least: each free vertex (free empty: all) takes, of its
// own label, its neighbours' continued ones and `alternative`'s (null: none), the one of least cost: its
// terms plus the seams on its edges. The sum over the surface falls with every change. Vertices of one colour
// of a colouring of the mesh move at once.
void straightenSeams(const SeamModel& model, const LabelTerms& terms, const std::vector<std::uint8_t>& free,
                     const Labels* alternative, int sweeps, Labels& labels);

}  // namespace fluidtex::texture
