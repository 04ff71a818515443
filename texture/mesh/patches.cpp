#include "texture/mesh/patches.h"

#include "texture/loops/parallel.h"
#include "texture/loops/point_grid.h"

#include <cmath>
#include <numeric>
#include <unordered_map>

namespace fluidtex::texture {

namespace {

constexpr std::uint64_t kGone = ~std::uint64_t(0);

std::uint64_t cubeAt(const Vec3f& place, float side, const Vec3f& corner) {
  const Vec3f p = (place - corner) / side;
  const auto part = [](float x) { return std::uint64_t(cellAlong(x) + (1 << 20)) & 0x1fffff; };
  return part(p.x()) << 42 | part(p.y()) << 21 | part(p.z());
}

Patches sharedOut(const std::vector<std::uint64_t>& cube) {
  const std::size_t count = cube.size();
  Patches patches;
  patches.of.resize(count);
  patches.first.assign(1, 0);
  // Neighbours in memory are mostly in one cube.
  std::unordered_map<std::uint64_t, std::uint32_t> numbers;
  std::uint64_t last = kGone;
  std::uint32_t number = kNone;
  for (std::size_t v = 0; v < count; ++v) {
    patches.of[v] = kNone;
    if (cube[v] == kGone) continue;
    if (cube[v] != last) {
      last = cube[v];
      number = numbers.try_emplace(last, std::uint32_t(numbers.size())).first->second;
      if (number + 1 == patches.first.size()) patches.first.push_back(0);
    }
    patches.of[v] = number;
    ++patches.first[number + 1];
  }
  std::partial_sum(patches.first.begin(), patches.first.end(), patches.first.begin());
  patches.vertex.resize(patches.first.back());
  std::vector<std::uint32_t> cursor(patches.first.begin(), patches.first.end() - 1);
  for (std::uint32_t v = 0; v < count; ++v) {
    if (patches.of[v] != kNone) patches.vertex[cursor[patches.of[v]]++] = v;
  }
  return patches;
}

}  // namespace

Patches patchesOf(const std::vector<Vec3f>& places, float side, const Vec3f& corner) {
  std::vector<std::uint64_t> cube(places.size());
  forEachIndex(places.size(), [&](std::uint32_t i) { cube[i] = cubeAt(places[i], side, corner); });
  return sharedOut(cube);
}

Patches patchesOf(const EditableMesh& mesh, float side, const Vec3f& corner) {
  std::vector<std::uint64_t> cube(mesh.vertexCount());
  forEachIndex(mesh.vertexCount(), [&](std::uint32_t v) {
    cube[v] = mesh.outgoing[v] == kNone ? kGone : cubeAt(mesh.position[v], side, corner);
  });
  return sharedOut(cube);
}

}  // namespace fluidtex::texture
