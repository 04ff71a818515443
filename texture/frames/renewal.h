// Which transported texture is renewed on later frames. Texture that is coherent and hardly stretched is not
// touched: that is calm, and cheap.
#pragma once

#include "texture/frames/look_ahead.h"
#include "texture/labels/seams.h"
#include "texture/options.h"

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// #V, cost of each label: log stretch() + 0.75 seamCostAround() + guidanceCost(). A lost label (lostLabels)
// counts as stretched by 4 at least. trust: #V.
std::vector<float> badness(const SeamModel& model, const Labels& labels, const std::vector<float>& trust);

// Whether a transported value has enough confidence to be used (kLowTrust).
bool believed(float trust);

// A region of the surface that is renewed at once.
struct Disc {
  std::uint32_t center = 0;
  std::vector<std::uint32_t> members;  // vertices, from the centre outwards
};

// Radius of a disc over its nominal radius.
inline constexpr double kDiscShare = 0.8;
// In units of log keepStretch: how much new texture is compressed at most where the flow stretches it, and
// the stretch from which renewal is urgent. New texture must not be urgent if the flow stops.
inline constexpr double kMostAhead = 1.45;
inline constexpr float kUrgent = 1.5f;
static_assert(kMostAhead < kUrgent);

struct DiscOptions {
  double keepStretch;  // coherent texture that is stretched less is kept
  double radius;       // nominal, pixels; centres are at least 2 kDiscShare radius apart
  // Shares of the vertices that discs may cover: where log stretch is below kUrgent log keepStretch, and
  // where it is above.
  double budget;
  double urgentBudget;
};

// Smoothed over neighbours, about half a small window.
struct Wear {
  std::vector<float> bad;      // #V: of badness()
  std::vector<float> stretch;  // #V: of log stretch() alone; lost labels count as 0
};
Wear wearAround(const SeamModel& model, const Labels& labels, const std::vector<float>& trust);

// Both multiplied by factor (#V; empty: unchanged).
Wear scaled(Wear wear, const std::vector<float>& factor);

// Share of the texture that the flow wears out in `seconds`: mean over vertices of strain (rates #V, 1/s,
// logarithmic) over the texture's life, the range from fully compressed (kMostAhead) to urgent (kUrgent).
// factor: #V, on the wear; empty: 1.
double wornShare(const std::vector<Strain>& rates, double seconds, double keepStretch,
                 const std::vector<float>& factor = {});

// Discs around the vertices of largest wear.bad, until the budget is used. Centres are vertices whose
// wear.bad exceeds a threshold of 0.5 to 1 times log keepStretch. The threshold varies smoothly over the
// exemplar, so that texture laid together is not renewed together. Members are `free` vertices only (#V; 0:
// in a cross-fade, on a droplet, where the flow goes through the surface, or never renewed). A disc is
// skipped if more than 35% of its vertices are not free but have wear. Urgent free vertices (wear.stretch of
// kUrgent log keepStretch or more) between discs join the disc that reaches them first, within twice its
// radius, whatever the budget.
std::vector<Disc> worstDiscs(const SeamModel& model, const Labels& labels, const Wear& wear,
                             const std::vector<std::uint8_t>& free, const DiscOptions& options,
                             std::uint64_t seed);

// 1/s, speed of the cross-fade: 1 / fade (s), or faster, so that texture stretches by no more than 1.8 log
// keepStretch meanwhile. strainRate: 1/s, logarithmic.
float fadingSpeed(float strainRate, double keepStretch, double fade);

// #V, 1 where labels must be renewed in any case: of low trust; and, unless they are original, beyond the
// edge of an exemplar that is not toroidal, or mirrored where the exemplar may not be.
std::vector<std::uint8_t> lostLabels(const SeamModel& model, const Labels& labels,
                                     const std::vector<float>& trust);

// The mask (#V) grown by `rings` rings of neighbours.
std::vector<std::uint8_t> grown(const VertexGraph& graph, std::vector<std::uint8_t> mask, int rings);

// Merges proposed labels into transported ones. Where both show the same texel, within 0.7 texels, the
// transported label stays unless it is clearly more stretched. Sub-texel misalignments of the other vertices
// are closed (closeSlips). Each connected piece of these is accepted only if it lowers the summed badness,
// its own and that of neighbours which share seams with it, by at least 0.05 per vertex of the piece. renewed
// (#V) is 1 where a label was accepted. Each renewal lowers a sum that is bounded below, so renewal ends on a
// surface that does not move. factor: #V, on the badness; empty: 1.
Labels settle(const SeamModel& model, const Labels& carried, const Labels& proposed,
              const std::vector<float>& trust, std::vector<std::uint8_t>& renewed,
              const std::vector<float>& factor = {});

}  // namespace fluidtex::texture
