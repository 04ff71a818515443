// Where carried texture is renewed on later frames, and where it stays. What is coherent and hardly stretched
// is not touched: that keeps the texture calm, and cheap.
#pragma once

#include "texture/options.h"
#include "texture/seams.h"

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// How bad each vertex's label is: log stretch() + kSeamWeight * seamCosts(). A label beyond the edge of an
// exemplar that does not wrap, or whose `trust` is low, counts as stretched kLostStretch times.
std::vector<float> badness(const SeamModel& model, const Labels& labels, const std::vector<float>& trust);

// 1 where labels should be renewed: where badness, averaged over a few rings, exceeds that of texture
// stretched by keepStretch. The threshold varies by a fifth, smoothly over the exemplar, so that neighbours
// do not renew at once; and it is higher where `age`, seconds since the last renewal, is young, so that what
// has just been laid down rests a while instead of boiling.
std::vector<std::uint8_t> worthRenewing(const SeamModel& model, const Labels& labels,
                                        const std::vector<float>& trust, const std::vector<float>& age,
                                        double keepStretch, std::uint64_t seed);

// The mask grown by `rings` rings of neighbours.
std::vector<std::uint8_t> grown(const VertexGraph& graph, std::vector<std::uint8_t> mask, int rings);

// Merges proposed labels into carried ones. Where they continue each other the carried one stays. The others
// form connected pieces, and a piece is renewed if that lowers the summed badness of the surface: the piece's
// own and that of the vertices around it, whose seams change with it. renewed[v] says where. A surface at rest
// therefore comes to rest: every renewal lowers a sum that has a bound.
Labels settle(const SeamModel& model, const Labels& carried, const Labels& proposed,
              const std::vector<float>& trust, std::vector<std::uint8_t>& renewed);

}  // namespace fluidtex::texture
