// Neighbourhoods on the mesh [Kwatra07 sec. V-A]: square pieces of the surface, flattened around a vertex,
// and the correspondence between their vertices and the pixels of an exemplar window.
//
// Vertex and pixel neighbourhoods come from one flattening: the centre's axes are carried outward by parallel
// transport, ring by ring, and each new vertex takes the mean of the predictions of its placed neighbours. On
// a plane the result is exact for any orientation field. Pixels are interpolated linearly in the flattened
// triangles, so functions linear in the local coordinates are exact in both kinds.
#pragma once

#include "texture/mesh/vertex_graph.h"
#include "texture/orientation/tangent.h"

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

namespace fluidtex::texture {

// Vertex neighbourhoods of one window width, in compressed rows: neighbourhood p has entries first[p] ..
// first[p+1]-1, the centre first, then ring by ring.
struct Neighborhoods {
  int window = 0;
  std::vector<std::uint32_t> center;  // #P
  // #P, pixels: |l1|, |l2| < reach. window / 2, or less where the piece folds or a triangle's area changes
  // more than threefold (thin parts, sharp edges, small drops): it ends at the first such triangle.
  std::vector<float> reach;
  std::vector<std::uint32_t> first;   // #P + 1
  std::vector<std::uint32_t> vertex;  // #N
  std::vector<Vec2f> offset;          // #N: l, local coordinates in pixels, in the centre's axes
  std::vector<Complexf> turn;         // #N, unit: a vector x in the vertex's axes is turn * x in the centre's

  std::size_t size() const { return center.size(); }
  bool shrunk(std::size_t p) const { return reach[p] < 0.5f * float(window); }
};

// A pixel of a flattened neighbourhood: sum of weight[i] * value(vertex[i]). All weights zero: no surface.
struct PixelSource {
  std::array<std::uint32_t, 3> vertex{};
  std::array<float, 3> weight{};
  bool missing() const { return weight[0] + weight[1] + weight[2] == 0.0f; }
};

// Pixel neighbourhoods: window^2 sources per centre, rows downwards, columns to the right, the centre in the
// middle.
using PixelNeighborhoods = std::vector<PixelSource>;

// What neighbourhoods are built from. Axes are mesh.orientation.
//
// A mesh can be viewed at less than its detail: with `pixel` 2 an exemplar pixel is two spacings wide, and
// only `members`, which should be about that far apart, count as vertices. Flattening still uses all of them.
struct MeshView {
  const SurfaceMesh& mesh;
  const VertexGraph& graph;
  const Connection& connection;
  float pixel = 1.0f;                                  // of windows, offsets and radii, in spacings
  const std::vector<std::uint8_t>* members = nullptr;  // #V; null: all vertices

  bool isMember(std::uint32_t v) const { return !members || (*members)[v]; }
};

// Centres spread over the vertices with wanted[v] != 0 (empty: over all), so that each of these is within
// `radius` pixels of a centre. Distance is measured along the surface, so that both sides of a thin sheet are
// covered. Vertices are visited in a fixed permutation: an unchanged mesh gets the same centres on every
// frame.
std::vector<std::uint32_t> selectCenters(const MeshView& view, float radius,
                                         const std::vector<std::uint8_t>& wanted = {});

// Vertex neighbourhoods around the centres; with `pixels`, the pixel neighbourhoods too. Precondition: window
// odd, >= 3. None reaches further than `widest` pixels.
Neighborhoods buildNeighborhoods(const MeshView& view, int window, std::vector<std::uint32_t> centers,
                                 PixelNeighborhoods* pixels = nullptr,
                                 double widest = std::numeric_limits<double>::infinity());

// selectCenters() at radius window / 4 and their neighbourhoods. Every wanted vertex lies in at least one:
// where shrunk ones leave gaps, centres are added.
Neighborhoods coverSurface(const MeshView& view, int window, const std::vector<std::uint8_t>& wanted = {},
                           PixelNeighborhoods* pixels = nullptr);

// The transpose, in compressed rows: vertex v is entry[i] of neighbourhood window[i].
struct Overlaps {
  std::vector<std::uint32_t> first;  // #V + 1
  std::vector<std::uint32_t> window, entry;
};
Overlaps overlaps(const Neighborhoods& neighborhoods, std::size_t vertexCount);

// Neighbouring windows, in compressed rows: entries of p's neighbourhood that are centres of other windows,
// at most `limit`, innermost rings first.
struct WindowLinks {
  std::vector<std::uint32_t> first;  // #P + 1
  std::vector<std::uint32_t> window, entry;
};
WindowLinks linkWindows(const Neighborhoods& neighborhoods, std::size_t vertexCount, int limit);

}  // namespace fluidtex::texture
