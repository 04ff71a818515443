// Neighbourhoods on the mesh [Kwatra07 sec. V-A]: square pieces of the surface, flattened around a vertex,
// and the correspondence between their vertices and the pixels of an exemplar window.
//
// Both kinds come from one flattening: the centre's axes are carried outward by parallel transport, ring by
// ring; each new vertex takes the average of what its placed neighbours predict. On a plane the result is
// exact, whatever the orientation field does there. A pixel is interpolated from the flattened triangle it
// falls into, so that what is linear in the local coordinates is exact in both kinds.
#pragma once

#include "texture/orientation/tangent.h"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace fluidtex::texture {

// Vertex neighbourhoods of one window width, compressed rows: those of centre p are entries first[p] ..
// first[p+1]-1, the centre itself first, then outward ring by ring.
struct Neighborhoods {
  int window = 0;
  std::vector<std::uint32_t> center;  // #P
  // #P, pixels: |l1|, |l2| < reach. window / 2, or less where the flattened piece folds or a triangle's area
  // changes more than threefold (thin parts, sharp edges, small drops): there it ends at the first bad
  // triangle.
  std::vector<float> reach;
  std::vector<std::uint32_t> first;   // #P + 1
  std::vector<std::uint32_t> vertex;  // #N
  std::vector<Vec2f> offset;          // #N: l, local coordinates in pixels, in the centre's axes
  std::vector<Complexf> turn;         // #N, unit: a vector x in the vertex's axes is turn * x in the centre's

  std::size_t size() const { return center.size(); }
  bool shrunk(std::size_t p) const { return reach[p] < 0.5f * float(window); }
};

// A pixel of a flattened neighbourhood: sum of weight[i] * value(vertex[i]). All weights zero: no surface
// there.
struct PixelSource {
  std::array<std::uint32_t, 3> vertex{};
  std::array<float, 3> weight{};
  bool missing() const { return weight[0] + weight[1] + weight[2] == 0.0f; }
};

// Pixel neighbourhoods: window^2 sources a centre, rows downwards, columns to the right, the centre in the
// middle.
using PixelNeighborhoods = std::vector<PixelSource>;

// What neighbourhoods are made from. Axes are mesh.orientation.
//
// A mesh can be looked at with less detail than it has: with `pixel` 2 an exemplar pixel is two spacings
// wide, and of the vertices only `members` count, which then should be about that far apart. Flattening still
// goes over all of them.
struct MeshView {
  const SurfaceMesh& mesh;
  const VertexGraph& graph;
  const Connection& connection;
  float pixel = 1.0f;                                  // of windows, offsets and radii, in spacings
  const std::vector<std::uint8_t>* members = nullptr;  // #V; null: all vertices

  bool isMember(std::uint32_t v) const { return !members || (*members)[v]; }
};

// Vertices spread over those where wanted[v] != 0 (empty: over all), so that each of them lies within
// `radius` pixels of a chosen one. Distance counts along the surface: the two sides of a thin sheet are
// covered each on its own. The order in which vertices are offered is a fixed permutation, so that an
// unchanged mesh gets the same choice on every frame.
std::vector<std::uint32_t> selectCenters(const MeshView& view, float radius,
                                         const std::vector<std::uint8_t>& wanted = {});

// Vertex neighbourhoods around the given centres; with `pixels`, the pixel neighbourhoods too. window must be
// odd and >= 3. None reaches further than `widest` pixels.
Neighborhoods buildNeighborhoods(const MeshView& view, int window, std::vector<std::uint32_t> centers,
                                 PixelNeighborhoods* pixels = nullptr,
                                 double widest = std::numeric_limits<double>::infinity());

// selectCenters() at window / 4 and their neighbourhoods. Every wanted vertex lies in at least one of them:
// where shrunk ones leave gaps, more centres are added.
Neighborhoods coverSurface(const MeshView& view, int window, const std::vector<std::uint8_t>& wanted = {},
                           PixelNeighborhoods* pixels = nullptr);

// The same entries by vertex, compressed rows: vertex v lies in neighbourhood window[i], as its entry
// entry[i].
struct Overlaps {
  std::vector<std::uint32_t> first;  // #V + 1
  std::vector<std::uint32_t> window, entry;
};
Overlaps overlaps(const Neighborhoods& neighborhoods, std::size_t vertexCount);

// Neighbouring windows, compressed rows: the entries of p's neighbourhood that are centres of other windows,
// at most `limit` of them, those of the innermost rings.
struct WindowLinks {
  std::vector<std::uint32_t> first;  // #P + 1
  std::vector<std::uint32_t> window, entry;
};
WindowLinks linkWindows(const Neighborhoods& neighborhoods, std::size_t vertexCount, int limit);

}  // namespace fluidtex::texture
