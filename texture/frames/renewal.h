// Where carried texture is renewed on later frames, and where it stays. What is coherent and hardly stretched
// is not touched: that keeps the texture calm, and cheap.
#pragma once

#include "texture/frames/look_ahead.h"
#include "texture/labels/seams.h"
#include "texture/options.h"

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// How bad each vertex's label is: log stretch() + kSeamWeight * seamCostAround() + guidanceCost(). A label
// that is lost (lostLabels) counts as stretched kLostStretch times.
std::vector<float> badness(const SeamModel& model, const Labels& labels, const std::vector<float>& trust);

// Whether a carried label means anything: where trust is low, nothing was there before.
bool believed(float trust);

// A piece of the surface that is renewed at once.
struct Disc {
  std::uint32_t center = 0;
  std::vector<std::uint32_t> members;  // from the centre outwards
};

// Of a disc's nominal radius: how far it reaches.
inline constexpr double kDiscShare = 0.8;
// Of what is kept (log): by how much new texture is laid squeezed at most where the flow draws it out, and
// where waiting ends. What is laid must not be urgent if the flow stops.
inline constexpr double kMostAhead = 1.45;
inline constexpr float kUrgent = 1.5f;
static_assert(kMostAhead < kUrgent);

struct DiscOptions {
  double keepStretch;  // what is coherent and stretched less is kept
  double radius;       // pixels, nominal; discs' centres are at least twice as far apart as they reach
  // Shares of the vertices that discs may cover: where texture is not stretched by more than kUrgent times
  // what is kept (log), and where it is.
  double budget;
  double urgentBudget;
};

// Averages over half a small window.
struct Wear {
  std::vector<float> bad;      // #V: badness()
  std::vector<float> stretch;  // #V: log stretch() alone; 0 where a label is beyond use
};
Wear wearAround(const SeamModel& model, const Labels& labels, const std::vector<float>& trust);

// Share of the texture that the flow wears out in that time: mean of how far each vertex is strained (rates,
// 1/s, logarithmic), over what lies between texture that is laid ahead and texture that is urgent.
double wornShare(const std::vector<Strain>& rates, double seconds, double keepStretch);

// Discs around the worst places, worst first, until the budget is used: where wear is worse than that of
// texture stretched by keepStretch. The threshold varies from half of that (log), smoothly over the exemplar,
// so that neighbours do not renew at once. What is not `free` (#V: what still fades, and droplets) is no
// member, and discs that hold much of it are left for later. What is urgent and lies between discs, within as
// much again as they reach, joins the nearest whatever the budget.
std::vector<Disc> worstDiscs(const SeamModel& model, const Labels& labels, const Wear& wear,
                             const std::vector<std::uint8_t>& free, const DiscOptions& options,
                             std::uint64_t seed);

// 1/s, how fast the old texture gives way where it is renewed: in `fade` seconds, or in the time in which
// texture is stretched 1.8 times (log) what keepStretch says, if that is shorter. strainRate: 1/s,
// logarithmic.
float fadingSpeed(float strainRate, double keepStretch, double fade);

// 1 where labels must be renewed whatever else is: hardly trusted, beyond the edge of an exemplar that does
// not wrap, or folded to mirror images that the exemplar must not show.
std::vector<std::uint8_t> lostLabels(const SeamModel& model, const Labels& labels,
                                     const std::vector<float>& trust);

// The mask grown by `rings` rings of neighbours.
std::vector<std::uint8_t> grown(const VertexGraph& graph, std::vector<std::uint8_t> mask, int rings);

// Merges proposed labels into carried ones. Where they continue each other the carried one stays. Of the
// others, slips are closed; they form connected pieces, and a piece is renewed if that lowers the summed
// badness of the surface: the piece's own and that of the vertices around it, whose seams change with it.
// renewed[v] says where. A surface at rest therefore comes to rest: every renewal lowers a sum that has a
// bound.
Labels settle(const SeamModel& model, const Labels& carried, const Labels& proposed,
              const std::vector<float>& trust, std::vector<std::uint8_t>& renewed);

}  // namespace fluidtex::texture
