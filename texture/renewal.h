// Where carried texture is renewed on later frames, and where it stays. What is coherent and hardly stretched
// is not touched: that keeps the texture calm, and cheap.
#pragma once

#include "texture/labels.h"
#include "texture/options.h"

#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// How bad each vertex's label is: log stretch() + kSeamWeight * seamContrast() over the difference of random
// texels; a label beyond the edge of an exemplar that does not wrap, or whose `trust` is low, counts as
// stretched kLostStretch times.
std::vector<float> badness(const MeshView& view, const TexelImage& image, const Labels& labels,
                           const std::vector<float>& trust, const Float8& channelWeight);

// 1 where a label should be renewed: stretched beyond keepStretch (jittered by a fifth from place to place in
// the exemplar, so that neighbours do not renew at once), lost, or among bad seams.
std::vector<std::uint8_t> worthRenewing(const MeshView& view, const TexelImage& image, const Labels& labels,
                                        const std::vector<float>& trust, const Float8& channelWeight,
                                        double keepStretch, std::uint64_t seed);

// The mask grown by `rings` rings of neighbours.
std::vector<std::uint8_t> grown(const VertexGraph& graph, std::vector<std::uint8_t> mask, int rings);

// Merges proposed labels into carried ones. Where they continue each other the carried one stays. The others
// form connected pieces, and a piece is renewed if that lowers its summed badness (the surroundings as they
// were). renewed[v] says where. A surface at rest therefore comes to rest: every renewal lowers a sum that
// has a bound.
Labels settle(const MeshView& view, const TexelImage& image, const Labels& carried, const Labels& proposed,
              const std::vector<float>& trust, const Float8& channelWeight,
              std::vector<std::uint8_t>& renewed);

}  // namespace fluidtex::texture
