#include "caches/liquid/survey.h"

#include "caches/liquid/read_frame.h"

#include <utility>

namespace fluidtex::caches {

Survey survey(const Options& options) {
  Cache cache{options, recognize(options), options.voxel};
  SurfaceTriangles surface;
  int first = cache.layout.first;
  for (; first <= cache.layout.last; ++first) {
    if (!cache.layout.surface.byNumber.contains(first)) continue;
    surface = readSurface(cache, first);
    if (!surface.triangles.empty()) break;
  }
  if (surface.triangles.empty())
    throw LayoutError(cache.layout.surface.pattern.string() +
                      ": no frame holds a surface; write at least one that does");
  openvdb::BBoxd bounds = boundsOf(surface);
  if (cache.voxel == 0.0) cache.voxel = suitingVoxel(cache, first, surface);
  // What is found while a program still runs must be found again when a run goes on later.
  const int last = options.follow ? first : cache.layout.last;
  for (const int number : {(first + last) / 2, last}) {
    if (number == first || !cache.layout.surface.byNumber.contains(number)) continue;
    const SurfaceTriangles later = readSurface(cache, number);
    if (!later.triangles.empty()) bounds.expand(boundsOf(later));
  }
  return {std::move(cache.layout), cache.voxel, bounds};
}

}  // namespace fluidtex::caches
