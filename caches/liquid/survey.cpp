#include "caches/liquid/survey.h"

#include "caches/liquid/read_frame.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace fluidtex::caches {
namespace {

// The first frame that has a surface, a middle one and the last, as far as there are such files.
std::vector<int> asked(const Cache& cache, int first) {
  // What is found while a program still runs must be found again when a run goes on later.
  const int last = cache.options.follow ? first : cache.layout.last;
  std::vector<int> numbers{first};
  for (const int number : {(first + last) / 2, last})
    if (number != numbers.back() && cache.layout.surface.byNumber.contains(number)) numbers.push_back(number);
  return numbers;
}

double radiusOfAll(const Cache& cache) {
  int first = cache.layout.first;
  double radius = 0.0;
  for (; first <= cache.layout.last && radius == 0.0; ++first)
    if (cache.layout.surface.byNumber.contains(first)) radius = particleRadius(cache, first);
  if (radius == 0.0) return 0.0;
  std::vector<double> found{radius};
  for (const int number : asked(cache, first - 1)) {
    if (number == first - 1) continue;
    if (const double other = particleRadius(cache, number); other > 0.0) found.push_back(other);
  }
  std::sort(found.begin(), found.end());
  return found[found.size() / 2];
}

}  // namespace

Survey survey(const Options& options) {
  Cache cache{options, recognize(options), options.voxel};
  if (cache.layout.surfaceKind == SurfaceKind::particles && cache.options.radius == 0.0)
    cache.options.radius = radiusOfAll(cache);
  const bool particles = cache.layout.surfaceKind == SurfaceKind::particles;
  SurfaceTriangles surface;
  int first = cache.layout.first;
  for (; first <= cache.layout.last; ++first) {
    if (!cache.layout.surface.byNumber.contains(first)) continue;
    surface = readSurface(cache, first);
    if (!surface.triangles.empty()) break;
  }
  if (surface.triangles.empty())
    throw LayoutError(cache.layout.surface.pattern.string() +
                      ": no frame holds a surface; write at least one that does" +
                      (particles ? ", or give files.radius where particles are too few to tell it" : ""));
  openvdb::BBoxd bounds = boundsOf(surface);
  if (cache.voxel == 0.0) cache.voxel = suitingVoxel(cache, first, surface);
  for (const int number : asked(cache, first)) {
    if (number == first) continue;
    const SurfaceTriangles later = readSurface(cache, number);
    if (!later.triangles.empty()) bounds.expand(boundsOf(later));
  }
  return {std::move(cache.layout), cache.voxel, particles ? cache.options.radius : 0.0, bounds};
}

}  // namespace fluidtex::caches
