// The viscous energy of a liquid from its grids: Batty and Bridson, "Accurate viscous free surfaces for
// buckling, coiling, and rotating liquids", 2008. Departures:
// - Only faces beside a liquid cell are unknown. A strain that would need another face is left out: that face
// would have no mass and move until the strain is 0. The mass around such a face goes to its unknown
// neighbours, so that a film has its whole weight.
// - Walls lie where the solid's distance has its zero, not at faces: a difference that reaches into a solid
// is taken over the distance to the wall, and volumes end there. For walls along an axis this is second
// order.
#include "sim/viscosity/viscous_system.h"

#include "sim/grid/leaf_block.h"
#include "sim/solids/table_sight.h"
#include "sim/viscosity/volume_fraction.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fluidtex::sim {
namespace {

constexpr auto& kStride = LeafBlock<2>::kStride;

// The values of a grid around one leaf.
struct Patch : LeafBlock<2> {
  Patch(const FloatTree& tree, const Coord& origin) { load(tree, origin); }

  float cell(int at) const { return value[at]; }
  // At the lower face of a cell normal to an axis, and at its lower edge between two axes.
  float face(int at, int axis) const { return 0.5f * (value[at] + value[at - kStride[axis]]); }
  float edge(int at, int p, int q) const {
    return 0.25f * (value[at] + value[at - kStride[p]] + value[at - kStride[q]] +
                    value[at - kStride[p] - kStride[q]]);
  }

  // Share of the cube around a place where the values are negative. The place lies half a cell below the
  // cell's centre along the axes in `lower` (bits).
  double negative(int at, int lower) const {
    double middle = 0.0, slope[3] = {};
    int count = 0;
    for (int corner = 0; corner < 8; ++corner) {
      if ((corner & ~lower) != 0) continue;
      int c = at;
      for (int a = 0; a < 3; ++a) c -= ((corner >> a) & 1) * kStride[a];
      ++count;
      middle += value[c];
      for (int a = 0; a < 3; ++a) {
        if (((lower >> a) & 1) != 0) {
          slope[a] += ((corner >> a) & 1) != 0 ? -2.0 * value[c] : 2.0 * value[c];
        } else {
          slope[a] += 0.5 * (static_cast<double>(value[c + kStride[a]]) - value[c - kStride[a]]);
        }
      }
    }
    return negativeShare(middle / count, slope[0] / count, slope[1] / count, slope[2] / count);
  }
};

// Faces in solids farther from liquid than this, in cells, belong to no strain of the liquid.
constexpr float kNearLiquid = 2.0f;
// A solid whose normal is this close to a face's axis gives the face its own normal velocity, whatever the
// wall's boundary condition.
constexpr float kSquare = 0.9f;
// Distances to walls count as at least this share of a cell.
constexpr float kMinReach = 0.05f;
// Faces this close to a wall, in cells, lie on it.
constexpr float kOnWall = 1e-4f;
// Faces with less volume than kMinMass of a cell count as that much, so that the matrix is regular. Strains
// with less than kMinVolume are left out.
constexpr double kMinMass = 0.01, kMinVolume = 1e-4;

enum : std::uint8_t { kNone = 0, kUnknown = 1, kGiven = 2 };

// Boundary conditions at faces beside walls; slip lengths in cells.
struct Walls {
  const SolidField& solid;
  float h;

  float slip(const Coord& face, int axis) const {
    if (!solid.slipLength) return std::numeric_limits<float>::infinity();
    Coord below = face;
    below[axis] -= 1;
    const auto& distance = solid.phi->constTree();
    const Coord& deeper = distance.getValue(face) < distance.getValue(below) ? face : below;
    return solid.slipLength->constTree().getValue(deeper) / h;
  }

  // Whether a face outside solids has a given velocity (a source, a stream side).
  bool given(const Coord& face, int axis) const {
    return solid.given && solid.given[axis].constTree().isValueOn(face);
  }

  bool open(const Coord& face, int axis) const { return solid.open[axis].constTree().getValue(face) > 0.5f; }

  // Velocity of the solid itself, also beside it.
  double motion(const Coord& face, int axis) const {
    return solid.speed ? solid.speed[axis].constTree().getValue(face) : 0.0f;
  }

  double speed(const Coord& face, int axis) const {
    if (given(face, axis)) return solid.given[axis].constTree().getValue(face);
    double value = motion(face, axis);
    if (solid.slide) value += solid.slide[axis].constTree().getValue(face);
    return value;
  }
};

struct FaceFields {
  std::array<std::vector<std::uint8_t>, 3> state;
  std::array<std::vector<float>, 3> volume;  // liquid around a face, outside solids
};

FaceFields classify(const LeafTable& table, const TableSight& sight, const FloatGrid& phi,
                    const SolidField& solid) {
  FaceFields fields;
  const float h = static_cast<float>(solid.voxelSize), onWall = kOnWall * h;
  const Walls walls{solid, h};
  for (int c = 0; c < 3; ++c) {
    fields.state[c].assign(table.voxels(), kNone);
    fields.volume[c].assign(table.voxels(), 0.0f);
  }
  tbb::parallel_for(std::size_t{0}, table.size(), [&](std::size_t n) {
    const Coord& origin = table.origins[n];
    const Patch liquid(phi.constTree(), origin), wall(solid.phi->constTree(), origin);
    for (int c = 0; c < 3; ++c) {
      for (int i = 0; i < kLeafSize; ++i) {
        const int at = Patch::index(i), below = at - kStride[c];
        const std::size_t v = n * kLeafSize + i;
        const float nearest = std::min(liquid.cell(at), liquid.cell(below));
        if (nearest > kNearLiquid * h) continue;
        const Coord face = origin.offsetBy(i >> 6, (i >> 3) & 7, i & 7);
        if (walls.given(face, c) || sight.inWall(static_cast<std::int64_t>(v), c)) {
          fields.state[c][v] = kGiven;
          continue;
        }
        const bool square = std::abs(wall.cell(at) - wall.cell(below)) >= kSquare * h;
        // An open face in the plane of a wall is the end of the domain.
        if (wall.face(at, c) <= onWall && !(square && walls.open(face, c))) {
          if (square || std::isfinite(walls.slip(face, c))) fields.state[c][v] = kGiven;
          continue;
        }
        if (nearest < 0.0f) fields.state[c][v] = kUnknown;
        const double inLiquid = liquid.negative(at, 1 << c);
        if (inLiquid > 0.0)
          fields.volume[c][v] = static_cast<float>(inLiquid * (1.0 - wall.negative(at, 1 << c)));
      }
    }
  });
  return fields;
}

// Distributes the liquid around faces that are not unknown among their unknown neighbours.
void gatherMass(const FaceFields& fields, ViscousSystem& system) {
  const LeafTable& table = system.table;
  system.mass.assign(system.unknowns, 0.0f);
  for (int c = 0; c < 3; ++c) {
    const auto& state = fields.state[c];
    const auto& volume = fields.volume[c];
    tbb::parallel_for(std::size_t{0}, table.size(), [&](std::size_t n) {
      for (std::size_t at = n * kLeafSize; at < (n + 1) * kLeafSize; ++at) {
        if (state[at] != kUnknown) continue;
        const auto v = static_cast<std::int64_t>(at);
        double mass = volume[at];
        for (int side = 0; side < 6; ++side) {
          const std::int64_t beside = table.neighbor(v, side);
          if (beside < 0 || state[beside] != kNone || volume[beside] <= 0.0f) continue;
          int sharers = 0;
          for (int s = 0; s < 6; ++s) {
            const std::int64_t sharer = table.neighbor(beside, s);
            sharers += sharer >= 0 && state[sharer] == kUnknown;
          }
          mass += static_cast<double>(volume[beside]) / sharers;
        }
        system.mass[system.number[c][at]] = static_cast<float>(std::max(mass, kMinMass));
      }
    });
  }
}

// The factor of a difference between an unknown and a given face, distances in cells. With it the wall's drag
// is that of a linear profile that is 0 a slip length behind the wall, on a sample of this volume.
float reachFactor(float unknownDistance, float givenDistance, float slip) {
  // Both may lie on the wall itself.
  const float between = unknownDistance - givenDistance;
  const float reach = between == 0.0f ? kMinReach : std::clamp(unknownDistance / between, kMinReach, 1.0f);
  return 1.0f / std::sqrt(reach * (reach + slip));
}

class Sampler {
 public:
  Sampler(const ViscousSystem& system, const TableSight& sight, const FloatGrid& phi, const SolidField& solid,
          const ViscosityField& viscosity, double scale)
      : m_system(system),
        m_sight(sight),
        m_phi(phi),
        m_solid(solid),
        m_viscosity(viscosity),
        m_scale(scale) {}

  // Appends the samples of type t whose voxel is in leaf n.
  void sample(std::size_t n, int t, std::vector<StrainSample>& out) const {
    const Coord& origin = m_system.table.origins[n];
    const int p = kStrainAxes[t][0], q = kStrainAxes[t][1];
    const int lower = t < 3 ? 0 : (1 << p) | (1 << q);
    std::unique_ptr<Patches> patches;
    for (int i = 0; i < kLeafSize; ++i) {
      const auto voxel = static_cast<std::int64_t>(n * kLeafSize + i);
      StrainSample sample;
      sample.face = facesOfStrain(m_system, t, voxel);
      bool whole = true, any = false;
      for (const std::int32_t f : sample.face) {
        whole = whole && f >= 0;
        any = any || (f >= 0 && f < m_system.unknowns);
      }
      if (!whole || !any || (t >= 3 && isThroughWall(sample, voxel, p, q))) continue;
      if (!patches) {
        patches = std::make_unique<Patches>(Patch(m_phi.constTree(), origin),
                                            Patch(m_solid.phi->constTree(), origin), nullptr);
        if (m_viscosity.variable != nullptr)
          patches->viscosity = std::make_unique<Patch>(m_viscosity.variable->constTree(), origin);
      }
      const int at = Patch::index(i);
      double volume = patches->liquid.negative(at, lower);
      if (volume > 0.0) volume *= 1.0 - patches->wall.negative(at, lower);
      if (volume < kMinVolume) continue;
      double viscosity = m_viscosity.constant;
      if (patches->viscosity)
        viscosity = t < 3 ? patches->viscosity->cell(at) : patches->viscosity->edge(at, p, q);
      sample.weight = static_cast<float>((t < 3 ? 2.0 : 1.0) * m_scale * viscosity * volume);
      if (t < 3) {
        sample.a = factor(sample.face[0], sample.face[1], patches->wall, at, at + kStride[p], p);
        sample.b = 0.0f;
        sample.offset = offset(sample.face[0], sample.face[1], sample.a, p);
      } else {
        sample.a = factor(sample.face[0], sample.face[1], patches->wall, at - kStride[q], at, p);
        sample.b = factor(sample.face[2], sample.face[3], patches->wall, at - kStride[p], at, q);
        sample.offset = offset(sample.face[0], sample.face[1], sample.a, p) +
                        offset(sample.face[2], sample.face[3], sample.b, q);
      }
      out.push_back(sample);
    }
  }

 private:
  struct Patches {
    Patch liquid, wall;
    std::unique_ptr<Patch> viscosity;
    Patches(const Patch& l, const Patch& w, std::unique_ptr<Patch> v)
        : liquid(l), wall(w), viscosity(std::move(v)) {}
  };

  // Whether a sample at a cell's lower edge between two axes is of faces on both sides of a thin wall: they
  // do not drag on each other.
  bool isThroughWall(const StrainSample& sample, std::int64_t cell, int p, int q) const {
    if (!m_sight.any(static_cast<std::size_t>(cell / kLeafSize))) return false;
    const auto areLiquid = [&](int first) {
      return sample.face[first] < m_system.unknowns && sample.face[first + 1] < m_system.unknowns;
    };
    return (areLiquid(0) && m_sight.hidesFace(cell, p, 2 * q)) ||
           (areLiquid(2) && m_sight.hidesFace(cell, q, 2 * p));
  }

  float factor(std::int32_t first, std::int32_t second, const Patch& wall, int firstAt, int secondAt,
               int axis) const {
    const bool firstGiven = first >= m_system.unknowns, secondGiven = second >= m_system.unknowns;
    if (firstGiven == secondGiven) return 1.0f;
    const int givenAt = firstGiven ? firstAt : secondAt, unknownAt = firstGiven ? secondAt : firstAt;
    const float h = static_cast<float>(m_solid.voxelSize);
    if (wall.face(givenAt, axis) > kOnWall * h) return 1.0f;  // given outside solids
    float slip = 0.0f;
    if (std::abs(wall.cell(givenAt) - wall.cell(givenAt - kStride[axis])) < kSquare * h)
      slip = Walls{m_solid, h}.slip(m_system.coord[firstGiven ? first : second], axis);
    return reachFactor(wall.face(unknownAt, axis), std::min(0.0f, wall.face(givenAt, axis)), slip);
  }

  // Offset of the difference second - first, which is multiplied by `factor`: a rotating solid has another
  // velocity at its surface than at the given face, and a motion that liquid and solid share must have no
  // strain.
  float offset(std::int32_t first, std::int32_t second, float factor, int axis) const {
    if (factor == 1.0f || !m_solid.speed) return 0.0f;
    const Walls walls{m_solid, static_cast<float>(m_solid.voxelSize)};
    return static_cast<float>((1.0f - factor) * (walls.motion(m_system.coord[second], axis) -
                                                 walls.motion(m_system.coord[first], axis)));
  }

  const ViscousSystem& m_system;
  const TableSight& m_sight;
  const FloatGrid& m_phi;
  const SolidField& m_solid;
  const ViscosityField& m_viscosity;
  double m_scale;  // from Pa s to the weight of a full sample
};

void gatherSamples(const Sampler& sampler, ViscousSystem& system) {
  const std::size_t leaves = system.table.size();
  std::vector<std::vector<StrainSample>> parts(leaves);
  for (int t = 0; t < kStrains; ++t) {
    system.typeStart[t] = static_cast<std::int32_t>(system.samples.size());
    tbb::parallel_for(std::size_t{0}, leaves, [&](std::size_t n) {
      parts[n].clear();
      sampler.sample(n, t, parts[n]);
    });
    for (const auto& part : parts) system.samples.insert(system.samples.end(), part.begin(), part.end());
  }
  system.typeStart[kStrains] = static_cast<std::int32_t>(system.samples.size());
}

}  // namespace

ViscousSystem viscousSystem(const Velocity& velocity, const FloatGrid& phi, const SolidField& solid,
                            double dt, double density, const ViscosityField& viscosity,
                            std::vector<double>& before) {
  ViscousSystem system;
  system.table = makeLeafTable(velocity.component[0]->constTree());
  const TableSight sight(system.table, solid.visibility.get());
  {
    const FaceFields fields = classify(system.table, sight, phi, solid);
    numberFaces(system, fields.state);
    gatherMass(fields, system);
  }
  const double h = solid.voxelSize;
  gatherSamples(Sampler(system, sight, phi, solid, viscosity, dt / (density * h * h)), system);
  linkSamples(system);

  before.assign(system.faces + 1, 0.0);
  const Walls walls{solid, static_cast<float>(h)};
  for (int c = 0; c < 3; ++c) {
    const auto values = sampleOn(system.table, velocity.component[c]->constTree());
    tbb::parallel_for(std::size_t{0}, system.table.size(), [&](std::size_t n) {
      for (std::size_t v = n * kLeafSize; v < (n + 1) * kLeafSize; ++v) {
        const std::int32_t number = system.number[c][v];
        if (number < 0) continue;
        before[number] = number < system.unknowns ? values[v] : walls.speed(system.coord[number], c);
      }
    });
  }
  return system;
}

}  // namespace fluidtex::sim
