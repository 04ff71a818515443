#include "sim/meshes/closed_surface.h"

#include "sim/options.h"

#include <algorithm>
#include <numeric>
#include <tuple>
#include <utility>

namespace fluidtex::sim {
namespace {

using Polygon = std::vector<std::size_t>;

// A polygon's corners from the least one on, in the direction of the lesser of its neighbours.
struct Key {
  Polygon corners;
  bool turned = false;
};

Key keyOf(const Polygon& polygon) {
  const std::size_t n = polygon.size();
  const std::size_t least =
      static_cast<std::size_t>(std::min_element(polygon.begin(), polygon.end()) - polygon.begin());
  Key key;
  key.turned = polygon[(least + 1) % n] > polygon[(least + n - 1) % n];
  for (std::size_t i = 0; i < n; ++i)
    key.corners.push_back(polygon[(key.turned ? least + n - i : least + i) % n]);
  return key;
}

// A group of polygons with the same corners: its members, sorted, and the surplus of one orientation.
struct Twins {
  std::vector<std::size_t> members;
  int surplus = 0;
};

std::vector<Twins> twinsOf(const Polygons& polygons) {
  std::vector<Key> keys;
  keys.reserve(polygons.size());
  for (const Polygon& polygon : polygons) keys.push_back(keyOf(polygon));
  std::vector<std::size_t> order(polygons.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tie(keys[a].corners, a) < std::tie(keys[b].corners, b);
  });
  std::vector<Twins> groups;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || keys[order[i]].corners != keys[order[i - 1]].corners) groups.emplace_back();
    groups.back().members.push_back(order[i]);
    groups.back().surplus += keys[order[i]].turned ? -1 : 1;
  }
  return groups;
}

}  // namespace

Polygon withoutRepeats(const std::vector<std::size_t>& polygon) {
  Polygon corners;
  for (const std::size_t corner : polygon)
    if (corners.empty() || corners.back() != corner) corners.push_back(corner);
  while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
  return corners;
}

OpenEdges openEdges(const Polygons& polygons) {
  std::vector<std::pair<std::size_t, std::size_t>> edges;
  for (const Polygon& polygon : polygons)
    for (std::size_t i = 0; i < polygon.size(); ++i)
      edges.push_back(std::minmax({polygon[i], polygon[(i + 1) % polygon.size()]}));
  std::sort(edges.begin(), edges.end());
  OpenEdges open;
  for (std::size_t i = 0, end = 0; i < edges.size(); i = end) {
    while (end < edges.size() && edges[end] == edges[i]) ++end;
    if (end - i == 1) ++open.ofOne;
    if (end - i > 1 && (end - i) % 2 != 0) ++open.ofMore;
  }
  return open;
}

Fan bestFan(const std::vector<Vec3d>& x) {
  const std::size_t n = x.size();
  // The search takes the square of their number.
  const std::size_t starts = n > 1024 ? 1 : n;
  const auto normal = [&](std::size_t a, std::size_t b, std::size_t c) {
    return (x[b % n] - x[a % n]).cross(x[c % n] - x[a % n]);
  };
  Vec3d whole(0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) whole += normal(0, i, i + 1);
  Fan best;
  double most = -kForever;
  for (std::size_t start = 0; start < starts; ++start) {
    double least = kForever;
    for (std::size_t i = 1; i + 1 < n; ++i)
      least = std::min(least, normal(start, start + i, start + i + 1).dot(whole));
    if (least > most) {
      most = least;
      best = {start, least >= 0.0};
    }
  }
  return best;
}

Polygons withoutTwins(const Polygons& polygons) {
  const std::vector<Twins> groups = twinsOf(polygons);
  if (groups.size() == polygons.size()) return polygons;
  const auto kept = [&](const auto& isKept) {
    std::vector<std::size_t> numbers;
    for (const Twins& twins : groups)
      if (isKept(twins)) numbers.push_back(twins.members.front());
    std::sort(numbers.begin(), numbers.end());
    Polygons some;
    for (const std::size_t n : numbers) some.push_back(polygons[n]);
    return some;
  };
  const auto closes = [](const Polygons& some) { return !some.empty() && openEdges(some).none(); };
  // In this order: walls within, whose faces cancel; duplicates; both, with faces of any orientation.
  if (Polygons some = kept([](const Twins& twins) { return twins.surplus != 0; }); closes(some)) return some;
  if (Polygons some = kept([](const Twins&) { return true; }); closes(some)) return some;
  if (Polygons some = kept([](const Twins& twins) { return twins.members.size() % 2 != 0; }); closes(some))
    return some;
  return polygons;
}

}  // namespace fluidtex::sim
