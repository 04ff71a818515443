// The viscous energy of a liquid on a staggered grid, as a list of strains, and its minimisation.
//
// Minimised over the velocities x of the liquid's faces:  sum of mass (x - before)^2 / 2 + sum over samples
// of weight e^2 / 2,  e = a (x[face1] - x[face0]) + b (x[face3] - x[face2]) + offset.  A sample is one entry
// of the strain at one place: on the diagonal (at a cell's centre, two faces) or off it (at a cell's edge,
// four faces). Differences are formed before they are weighted, so that a translation has no strain to the
// last bit.
#pragma once

#include "sim/grid/leaf_table.h"
#include "sim/solids/solids.h"
#include "sim/viscosity/viscosity.h"

#include <array>
#include <cstdint>
#include <vector>

namespace fluidtex::sim {

struct StrainSample {
  std::array<std::int32_t, 4> face;  // indices of faces; on the diagonal the last two are nowhere()
  float weight = 0.0f;
  float a = 1.0f, b = 1.0f;  // other than 1 where a difference reaches a wall nearer or farther than one cell
  float offset = 0.0f;       // what the wall's own motion changes between its surface and the given face
};

// Types of samples: xx, yy, zz, then xy, xz, yz.
inline constexpr int kStrains = 6;
inline constexpr int kStrainAxes[kStrains][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};

// The samples that hold a face: 0 and 1 on the diagonal, where it is the upper and the lower face; then two
// for each of the other axes in order, where it is the upper and the lower one.
using FaceSamples = std::array<std::int32_t, 6>;

struct ViscousSystem {
  LeafTable table;
  // By voxel of the table: the number of its lower face along each axis, -1 for none.
  std::array<std::vector<std::int32_t>, 3> number;

  // Unknown faces come first: those of u, of v, of w, each leaf by leaf, in a leaf first those with even
  // i + j + k. Then faces of solids, whose values are given.
  std::int32_t unknowns = 0, faces = 0;
  std::vector<Coord> coord;  // #faces
  // Start of the faces of component c in leaf n with even (0) and odd (1) i + j + k, at [c][2 n + parity];
  // one more entry at the end.
  std::array<std::vector<std::int32_t>, 3> start;

  std::vector<StrainSample> samples;                   // of one type after the other
  std::array<std::int32_t, kStrains + 1> typeStart{};  // into samples
  std::vector<FaceSamples> samplesOf;                  // #unknowns; samples.size() for none
  std::vector<float> mass;                             // #unknowns

  // A face beyond the last, whose value is 0.
  std::int32_t nowhere() const { return faces; }
};

// Derivative of strain `s` of sample type `t` with respect to a face of component c in slot `slot` of
// FaceSamples.
inline float strainOf(const StrainSample& s, int c, int slot) {
  const float sign = (slot & 1) == 0 ? 1.0f : -1.0f;
  if (slot < 2) return sign * s.a;
  const int other = slot < 4 ? (c == 0 ? 1 : 0) : (c == 2 ? 1 : 2);
  return sign * (c < other ? s.a : s.b);
}

// Numbers the faces of `state` (1 unknown, 2 given, 0 neither) and fills table, number, coord, start,
// unknowns and faces.
void numberFaces(ViscousSystem& system, const std::array<std::vector<std::uint8_t>, 3>& state);

// Indices of the faces of a sample of type t at a voxel, -1 where there is none.
std::array<std::int32_t, 4> facesOfStrain(const ViscousSystem& system, int t, std::int64_t voxel);

// Fills samplesOf from samples.
void linkSamples(ViscousSystem& system);

// The system of a liquid. `before` gets the velocity at all faces (nowhere() included). Lengths in cells,
// weights relative to the mass of a full cell.
ViscousSystem viscousSystem(const Velocity& velocity, const FloatGrid& phi, const SolidField& solid,
                            double dt, double density, const ViscosityField& viscosity,
                            std::vector<double>& before);

// Solves from x = before; faces of solids keep their values.
[[nodiscard]] ViscosityReport solveViscous(const ViscousSystem& system, std::vector<double>& x,
                                           const ViscosityOptions& options);

}  // namespace fluidtex::sim
