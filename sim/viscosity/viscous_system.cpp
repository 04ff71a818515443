#include "sim/viscosity/viscous_system.h"

#include <tbb/parallel_for.h>

namespace fluidtex::sim {

void numberFaces(ViscousSystem& system, const std::array<std::vector<std::uint8_t>, 3>& state) {
  const LeafTable& table = system.table;
  const auto parityOf = [](int offset) { return ((offset >> 6) + ((offset >> 3) & 7) + (offset & 7)) & 1; };
  std::int32_t next = 0;
  for (int c = 0; c < 3; ++c) {
    std::vector<std::int32_t> counts(2 * table.size());
    tbb::parallel_for(std::size_t{0}, table.size(), [&](std::size_t n) {
      for (int i = 0; i < kLeafSize; ++i) {
        if (state[c][n * kLeafSize + i] == 1) ++counts[2 * n + parityOf(i)];
      }
    });
    auto& start = system.start[c];
    start.assign(1, next);
    for (const std::int32_t count : counts) start.push_back(next += count);
    system.number[c].assign(table.voxels(), -1);
    tbb::parallel_for(std::size_t{0}, table.size(), [&](std::size_t n) {
      std::int32_t at[2] = {start[2 * n], start[2 * n + 1]};
      for (int i = 0; i < kLeafSize; ++i) {
        if (state[c][n * kLeafSize + i] == 1) system.number[c][n * kLeafSize + i] = at[parityOf(i)]++;
      }
    });
  }
  system.unknowns = next;
  for (int c = 0; c < 3; ++c) {
    for (std::size_t v = 0; v < table.voxels(); ++v) {
      if (state[c][v] == 2) system.number[c][v] = next++;
    }
  }
  system.faces = next;
  system.coord.resize(next);
  tbb::parallel_for(std::size_t{0}, table.size(), [&](std::size_t n) {
    for (int c = 0; c < 3; ++c) {
      for (std::size_t v = n * kLeafSize; v < (n + 1) * kLeafSize; ++v) {
        const std::int32_t number = system.number[c][v];
        if (number >= 0) system.coord[number] = table.coord(static_cast<std::int64_t>(v));
      }
    }
  });
}

std::array<std::int32_t, 4> facesOfStrain(const ViscousSystem& system, int t, std::int64_t voxel) {
  const auto numberAt = [&](int c, std::int64_t v) { return v < 0 ? -1 : system.number[c][v]; };
  const int p = kStrainAxes[t][0], q = kStrainAxes[t][1];
  if (t < 3) {
    return {numberAt(p, voxel), numberAt(p, system.table.neighbor(voxel, 2 * p + 1)), system.nowhere(),
            system.nowhere()};
  }
  return {numberAt(p, system.table.neighbor(voxel, 2 * q)), numberAt(p, voxel),
          numberAt(q, system.table.neighbor(voxel, 2 * p)), numberAt(q, voxel)};
}

void linkSamples(ViscousSystem& system) {
  FaceSamples none;
  none.fill(static_cast<std::int32_t>(system.samples.size()));
  system.samplesOf.assign(system.unknowns, none);
  const auto link = [&](std::int32_t face, int slot, std::int32_t sample) {
    if (face < system.unknowns) system.samplesOf[face][slot] = sample;
  };
  // Each slot belongs to one type and one end of a sample: types write to disjoint places.
  tbb::parallel_for(0, kStrains, [&](int t) {
    for (std::int32_t s = system.typeStart[t]; s < system.typeStart[t + 1]; ++s) {
      const auto& face = system.samples[s].face;
      if (t < 3) {
        link(face[0], 1, s);
        link(face[1], 0, s);
        continue;
      }
      // Of the two axes other than a face's own, which one the sample's other component is.
      const int p = kStrainAxes[t][0], q = kStrainAxes[t][1];
      const int slotA = q == (p == 0 ? 1 : 0) ? 2 : 4, slotB = p == (q == 0 ? 1 : 0) ? 2 : 4;
      link(face[0], slotA + 1, s);
      link(face[1], slotA, s);
      link(face[2], slotB + 1, s);
      link(face[3], slotB, s);
    }
  });
}

}  // namespace fluidtex::sim
