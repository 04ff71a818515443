#include "texture/neighborhood/neighborhood.h"

#include "numerics/random.h"
#include "texture/loops/parallel.h"
#include "texture/neighborhood/flattener.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace fluidtex::texture {
namespace {

// Pixels: reach of the small neighbourhoods that fill gaps between shrunk ones.
constexpr double kFillerReach = 4.5;

void append(Neighborhoods& to, const Neighborhoods& more) {
  const std::uint32_t base = to.first.back();
  to.center.insert(to.center.end(), more.center.begin(), more.center.end());
  to.reach.insert(to.reach.end(), more.reach.begin(), more.reach.end());
  for (std::size_t p = 0; p < more.size(); ++p) to.first.push_back(base + more.first[p + 1]);
  to.vertex.insert(to.vertex.end(), more.vertex.begin(), more.vertex.end());
  to.offset.insert(to.offset.end(), more.offset.begin(), more.offset.end());
  to.turn.insert(to.turn.end(), more.turn.begin(), more.turn.end());
}

}  // namespace

std::vector<std::uint32_t> selectCenters(const MeshView& view, float radius,
                                         const std::vector<std::uint8_t>& wanted) {
  const std::vector<Vec3f>& x = view.mesh.positions;
  const std::size_t count = x.size();
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  order.reserve(count);
  for (std::uint32_t v = 0; v < count; ++v)
    if (view.isMember(v) && (wanted.empty() || wanted[v])) order.emplace_back(mix64(v), v);
  std::sort(order.begin(), order.end());

  std::vector<std::uint32_t> centers, queue;
  std::vector<std::uint8_t> covered(count, 0);
  std::vector<std::uint32_t> visited(count, kNone);
  for (const auto& entry : order) {
    const std::uint32_t center = entry.second;
    if (covered[center]) continue;
    centers.push_back(center);
    const auto reach = float(radius * view.pixel * view.mesh.spacingAt(center));
    queue.assign(1, center);
    visited[center] = center;
    for (std::size_t i = 0; i < queue.size(); ++i) {
      covered[queue[i]] = 1;
      for (const std::uint32_t u : view.graph.around(queue[i])) {
        if (visited[u] == center || (x[u] - x[center]).lengthSqr() > reach * reach) continue;
        visited[u] = center;
        queue.push_back(u);
      }
    }
  }
  std::sort(centers.begin(), centers.end());  // locality: neighbours in memory are mostly near in space
  return centers;
}

namespace {

// One per thread; their arrays over all vertices are kept between calls.
using Flatteners = tbb::enumerable_thread_specific<Flattener>;

Flatteners makeFlatteners(const MeshView& view) {
  return Flatteners([view] { return Flattener(view); });
}

Neighborhoods build(const MeshView& view, Flatteners& flatteners, int window,
                    std::vector<std::uint32_t> centers, PixelNeighborhoods* pixels,
                    double widest = std::numeric_limits<double>::infinity()) {
  if (window < 3 || window % 2 == 0)
    throw std::invalid_argument("the width of a window must be odd and at least 3");
  constexpr std::size_t kChunk = 64;
  Neighborhoods result;
  result.window = window;
  result.center = std::move(centers);
  const std::size_t count = result.size(), chunks = (count + kChunk - 1) / kChunk;
  result.reach.resize(count);
  result.first.assign(count + 1, 0);
  const std::size_t area = std::size_t(window) * window;
  const double pixel = double(view.pixel);
  if (pixels) pixels->assign(count * area, PixelSource{});

  struct Piece {
    std::vector<std::uint32_t> vertex;
    std::vector<Vec2f> offset;
    std::vector<Complexf> turn;
  };
  std::vector<Piece> pieces(chunks);
  tbb::parallel_for(std::size_t(0), chunks, [&](std::size_t chunk) {
    Flattener& flattener = flatteners.local();
    Piece& piece = pieces[chunk];
    for (std::size_t p = chunk * kChunk; p < std::min(count, (chunk + 1) * kChunk); ++p) {
      flattener.flatten(result.center[p], pixel * std::min(0.5 * window, widest));
      result.reach[p] = float(flattener.reach() / pixel);
      const std::size_t before = piece.vertex.size();
      for (const Flattener::Placed& placed : flattener.placed()) {
        const Vec2f l(float(placed.l.real() / pixel), float(placed.l.imag() / pixel));
        if (!view.isMember(placed.vertex)) continue;
        if (std::max(std::abs(l[0]), std::abs(l[1])) >= result.reach[p]) continue;
        piece.vertex.push_back(placed.vertex);
        piece.offset.push_back(l);
        piece.turn.emplace_back(placed.turn);
      }
      result.first[p + 1] = std::uint32_t(piece.vertex.size() - before);
      if (pixels) flattener.rasterize(window, pixels->data() + p * area);
    }
  });

  std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
  result.vertex.resize(result.first.back());
  result.offset.resize(result.first.back());
  result.turn.resize(result.first.back());
  tbb::parallel_for(std::size_t(0), chunks, [&](std::size_t chunk) {
    const Piece& piece = pieces[chunk];
    const std::uint32_t at = result.first[chunk * kChunk];
    std::copy(piece.vertex.begin(), piece.vertex.end(), result.vertex.begin() + at);
    std::copy(piece.offset.begin(), piece.offset.end(), result.offset.begin() + at);
    std::copy(piece.turn.begin(), piece.turn.end(), result.turn.begin() + at);
  });
  return result;
}

}  // namespace

Neighborhoods buildNeighborhoods(const MeshView& view, int window, std::vector<std::uint32_t> centers,
                                 PixelNeighborhoods* pixels, double widest) {
  Flatteners flatteners = makeFlatteners(view);
  return build(view, flatteners, window, std::move(centers), pixels, widest);
}

Neighborhoods coverSurface(const MeshView& view, int window, const std::vector<std::uint8_t>& wanted,
                           PixelNeighborhoods* pixels) {
  Flatteners flatteners = makeFlatteners(view);
  Neighborhoods result =
      build(view, flatteners, window, selectCenters(view, 0.25f * float(window), wanted), pixels);
  const std::size_t count = view.mesh.positions.size();
  // A shrunk neighbourhood may leave vertices of its centre uncovered; radius 0 makes every remaining vertex
  // a centre. Nothing wide can be flattened there, so nothing wide is tried.
  for (const float radius : {1.0f, 0.0f}) {
    std::vector<std::uint8_t> open = wanted.empty() ? std::vector<std::uint8_t>(count, 1) : wanted;
    for (const std::uint32_t v : result.vertex) open[v] = 0;
    if (view.members)
      for (std::uint32_t v = 0; v < count; ++v) open[v] = open[v] && view.isMember(v);
    if (std::find_if(open.begin(), open.end(), [](std::uint8_t o) { return o != 0; }) == open.end()) break;
    PixelNeighborhoods morePixels;
    append(result, build(view, flatteners, window, selectCenters(view, radius, open),
                         pixels ? &morePixels : nullptr, kFillerReach));
    if (pixels) pixels->insert(pixels->end(), morePixels.begin(), morePixels.end());
  }
  return result;
}

Overlaps overlaps(const Neighborhoods& neighborhoods, std::size_t vertexCount) {
  Overlaps result;
  result.first.assign(vertexCount + 1, 0);
  for (const std::uint32_t v : neighborhoods.vertex) ++result.first[v + 1];
  std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
  result.window.resize(neighborhoods.vertex.size());
  result.entry.resize(neighborhoods.vertex.size());
  std::vector<std::uint32_t> next(result.first.begin(), result.first.end() - 1);
  for (std::uint32_t p = 0; p < neighborhoods.size(); ++p) {
    for (std::uint32_t i = neighborhoods.first[p]; i < neighborhoods.first[p + 1]; ++i) {
      const std::uint32_t at = next[neighborhoods.vertex[i]]++;
      result.window[at] = p;
      result.entry[at] = i;
    }
  }
  return result;
}

WindowLinks linkWindows(const Neighborhoods& neighborhoods, std::size_t vertexCount, int limit) {
  std::vector<std::uint32_t> windowAt(vertexCount, kNone);
  for (std::uint32_t p = 0; p < neighborhoods.size(); ++p) windowAt[neighborhoods.center[p]] = p;
  WindowLinks links;
  links.first.push_back(0);
  for (std::uint32_t p = 0; p < neighborhoods.size(); ++p) {
    int found = 0;
    for (std::uint32_t i = neighborhoods.first[p] + 1; i < neighborhoods.first[p + 1] && found < limit; ++i) {
      const std::uint32_t other = windowAt[neighborhoods.vertex[i]];
      if (other == kNone) continue;
      links.window.push_back(other);
      links.entry.push_back(i);
      ++found;
    }
    links.first.push_back(std::uint32_t(links.window.size()));
  }
  return links;
}

}  // namespace fluidtex::texture
