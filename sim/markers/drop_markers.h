// Removal of markers.
#pragma once

#include "sim/markers/markers.h"

#include <tbb/parallel_for.h>

#include <cmath>

namespace fluidtex::sim {

// Drops the markers for which gone(marker, cell) holds, and blocks left without any. cell: the one whose
// centre is nearest to the marker. `gone` is called from several threads at once.
template <class Gone>
void dropMarkers(Markers& markers, const Gone& gone) {
  tbb::parallel_for(std::size_t{0}, markers.size(), [&](std::size_t n) {
    std::erase_if(markers[n].markers, [&, origin = markers[n].origin](const Marker& m) {
      return gone(m, origin.offsetBy(static_cast<int>(std::lround(m.x)), static_cast<int>(std::lround(m.y)),
                                     static_cast<int>(std::lround(m.z))));
    });
  });
  std::erase_if(markers, [](const MarkerBlock& block) { return block.markers.empty(); });
}

}  // namespace fluidtex::sim
