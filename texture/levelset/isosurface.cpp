// Based on: Lorensen, Cline, "Marching cubes" (1987) with the case table derived from the tetrahedra of
// Doi, Koide, "An efficient method of triangulating equi-valued surfaces by using tetrahedral cells" (1991),
// so that ambiguous faces are decided alike from both sides.
#include "texture/levelset/isosurface.h"

#include "texture/levelset/crossed_cells.h"
#include "texture/loops/parallel.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <memory>
#include <numeric>
#include <optional>

namespace fluidtex::texture {
namespace {

using openvdb::Coord;

constexpr int kBlockCells = kBlockSide * kBlockSide * kBlockSide;
constexpr std::size_t kTermsAtOnce = 4096;  // of a sum
constexpr int kCentre = 12;                 // in the table: the extra vertex at the centre

// A crossing is on the edge between two corners; corner c of a cell is at (c & 1, c >> 1 & 1, c >> 2 & 1).
struct Crossing {
  int low, high;
  bool operator==(const Crossing&) const = default;
  bool onGridEdge() const { return ((low ^ high) & ((low ^ high) - 1)) == 0; }
  // 0..11: axis * 4 + the low corner's two other coordinates.
  int edge() const {
    const int axis = (low ^ high) == 1 ? 0 : (low ^ high) == 2 ? 1 : 2;
    const int others = axis == 0 ? low >> 1 : axis == 1 ? (low & 1) | (low >> 2 & 1) << 1 : low & 3;
    return axis * 4 + others;
  }
};

Crossing crossing(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

bool onOneFace(const Crossing& a, const Crossing& b) {
  const int all = a.low & a.high & b.low & b.high, any = a.low | a.high | b.low | b.high;
  return all != 0 || any != 7;
}

using Polygon = std::vector<Crossing>;

// Triangulation of a polygon without diagonals in a face of the cell: the neighbouring cell might have the
// same one, and the edge four triangles. Nothing if there is none.
std::optional<std::vector<std::array<Crossing, 3>>> triangulate(const Polygon& polygon) {
  using Triangles = std::vector<std::array<Crossing, 3>>;
  const std::size_t n = polygon.size();
  if (n < 3) return Triangles{};
  if (n == 3) return Triangles{{polygon[0], polygon[1], polygon[2]}};
  for (std::size_t k = 1; k + 1 < n; ++k) {
    if (k > 1 && onOneFace(polygon[0], polygon[k])) continue;
    if (k + 2 < n && onOneFace(polygon[k], polygon[n - 1])) continue;
    auto left = triangulate(Polygon(polygon.begin(), polygon.begin() + std::ptrdiff_t(k) + 1));
    auto right = triangulate(Polygon(polygon.begin() + std::ptrdiff_t(k), polygon.end()));
    if (!left || !right) continue;
    left->insert(left->end(), right->begin(), right->end());
    left->push_back({polygon[0], polygon[k], polygon[n - 1]});
    return left;
  }
  return std::nullopt;
}

struct Case {
  std::vector<std::array<std::uint8_t, 3>> triangles;  // edges of the cell, or kCentre
  std::vector<std::uint8_t> rim;                       // where there is a centre: the edges around it
};

// Triangles of marching tetrahedra in one cell, counter-clockwise seen from positive values.
std::vector<std::array<Crossing, 3>> tetrahedraTriangles(unsigned negative) {
  std::vector<std::array<Crossing, 3>> triangles;
  std::array<int, 3> axes{1, 2, 4};
  bool even = true;  // the parity of the permutation is the handedness of its tetrahedron
  do {
    std::array<int, 4> corner{0, axes[0], axes[0] | axes[1], 7};
    const int inversions = (axes[0] > axes[1]) + (axes[0] > axes[2]) + (axes[1] > axes[2]);
    even = inversions % 2 == 0;
    if (!even) std::swap(corner[2], corner[3]);
    std::array<int, 4> order{0, 1, 2, 3};
    // Even permutations of a positively oriented tetrahedron that bring its negative corners to the front.
    static constexpr std::array<std::array<int, 4>, 12> kEven{{{0, 1, 2, 3},
                                                               {0, 2, 3, 1},
                                                               {0, 3, 1, 2},
                                                               {1, 0, 3, 2},
                                                               {1, 2, 0, 3},
                                                               {1, 3, 2, 0},
                                                               {2, 0, 1, 3},
                                                               {2, 1, 3, 0},
                                                               {2, 3, 0, 1},
                                                               {3, 0, 2, 1},
                                                               {3, 1, 0, 2},
                                                               {3, 2, 1, 0}}};
    const auto isNegative = [&](int k) { return (negative >> corner[std::size_t(k)] & 1u) != 0; };
    const int count = isNegative(0) + isNegative(1) + isNegative(2) + isNegative(3);
    for (const auto& candidate : kEven) {
      bool front = true;
      for (int k = 0; k < 4; ++k) front = front && isNegative(candidate[std::size_t(k)]) == (k < count);
      if (front) {
        order = candidate;
        break;
      }
    }
    const auto at = [&](int a, int b) {
      return crossing(corner[std::size_t(order[std::size_t(a)])], corner[std::size_t(order[std::size_t(b)])]);
    };
    // With det(p1 - p0, p2 - p0, p3 - p0) > 0 the triangle 1, 2, 3 is counter-clockwise seen from the side
    // away from 0.
    if (count == 1) triangles.push_back({at(0, 1), at(0, 2), at(0, 3)});
    if (count == 3) triangles.push_back({at(3, 0), at(3, 1), at(3, 2)});
    if (count == 2) {
      triangles.push_back({at(0, 2), at(0, 3), at(1, 3)});
      triangles.push_back({at(0, 2), at(1, 3), at(1, 2)});
    }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return triangles;
}

// Loops in which the triangles of a cell meet its faces, oriented as the triangles, without diagonal
// crossings.
std::vector<Polygon> faceLoops(const std::vector<std::array<Crossing, 3>>& triangles) {
  std::vector<std::array<Crossing, 2>> open;
  for (const auto& t : triangles) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::array<Crossing, 2> edge{t[k], t[(k + 1) % 3]};
      const auto opposite = std::find(open.begin(), open.end(), std::array<Crossing, 2>{edge[1], edge[0]});
      if (opposite != open.end()) {
        open.erase(opposite);
      } else {
        open.push_back(edge);
      }
    }
  }
  std::vector<Polygon> loops;
  while (!open.empty()) {
    Polygon loop;
    std::array<Crossing, 2> edge = open.back();
    open.pop_back();
    const Crossing start = edge[0];
    while (true) {
      if (edge[0].onGridEdge()) loop.push_back(edge[0]);
      if (edge[1] == start) break;
      const auto next =
          std::find_if(open.begin(), open.end(), [&](const auto& e) { return e[0] == edge[1]; });
      assert(next != open.end());
      edge = *next;
      open.erase(next);
    }
    loops.push_back(loop);
  }
  return loops;
}

Case makeCase(unsigned negative) {
  Case result;
  const auto add = [&](const Crossing& a, const Crossing& b, const Crossing& c) {
    result.triangles.push_back({std::uint8_t(a.edge()), std::uint8_t(b.edge()), std::uint8_t(c.edge())});
  };
  const std::vector<Polygon> loops = faceLoops(tetrahedraTriangles(negative));
  // Two opposite corners on the dividing diagonal: a tube between two triangles, the only patch that is no
  // disc.
  constexpr unsigned kEnds = 1u | 1u << 7;
  if (negative == kEnds || negative == (~kEnds & 0xffu)) {
    assert(loops.size() == 2 && loops[0].size() == 3 && loops[1].size() == 3);
    // Edges at both ends are matched by nearness: they share one corner's coordinate pattern.
    const Polygon& a = loops[0];
    Polygon b = loops[1];
    const auto parallel = [](const Crossing& p, const Crossing& q) {
      return (p.low ^ p.high) == (q.low ^ q.high);
    };
    while (!parallel(a[0], b[0])) std::rotate(b.begin(), b.begin() + 1, b.end());
    for (std::size_t k = 0; k < 3; ++k) {
      // b runs the other way round the tube.
      const Crossing &a0 = a[k], &a1 = a[(k + 1) % 3], &b0 = b[(3 - k) % 3], &b1 = b[(2 - k + 3) % 3];
      add(a0, a1, b0);
      add(a1, b1, b0);
    }
    return result;
  }
  for (const Polygon& loop : loops) {
    if (const auto triangles = triangulate(loop)) {
      for (const auto& t : *triangles) add(t[0], t[1], t[2]);
    } else {
      assert(result.rim.empty());
      for (std::size_t k = 0; k < loop.size(); ++k) {
        result.rim.push_back(std::uint8_t(loop[k].edge()));
        result.triangles.push_back({std::uint8_t(loop[k].edge()),
                                    std::uint8_t(loop[(k + 1) % loop.size()].edge()), std::uint8_t(kCentre)});
      }
    }
  }
  return result;
}

const std::array<Case, 256>& cases() {
  static const std::array<Case, 256> table = [] {
    std::array<Case, 256> t;
    for (unsigned m = 1; m < 255; ++m) t[m] = makeCase(m);
    return t;
  }();
  return table;
}

constexpr std::array<int, 3> kValueStep{kBlockPadded * kBlockPadded, kBlockPadded, 1};

unsigned cellMask(const float* corner) {
  unsigned mask = 0;
  for (int c = 0; c < 8; ++c) {
    const int offset = (c & 1) * kValueStep[0] + (c >> 1 & 1) * kValueStep[1] + (c >> 2 & 1) * kValueStep[2];
    mask |= unsigned(corner[offset] < 0.0f) << c;
  }
  return mask;
}

}  // namespace

IsoSurface isoSurface(const LevelSet& phi) {
  IsoSurface surface;
  const std::size_t blocks = phi.surfaceBlockCount();
  if (blocks == 0) return surface;
  const auto& table = cases();
  const auto forBlocks = [&](const auto& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks, 16), [&](const auto& range) {
      for (std::size_t b = range.begin(); b < range.end(); ++b) body(b);
    });
  };

  std::vector<std::uint32_t> firstVertex(blocks + 1, 0), firstTriangle(blocks + 1, 0);
  forBlocks([&](std::size_t b) {
    std::uint32_t vertices = 0, triangles = 0;
    forCrossedCells(phi.values(b), [&](int, int, int, const float* v) {
      const bool inside = v[0] < 0.0f;
      for (int step : kValueStep) vertices += inside != (v[step] < 0.0f);
      const Case& c = table[cellMask(v)];
      vertices += !c.rim.empty();
      triangles += std::uint32_t(c.triangles.size());
    });
    firstVertex[b + 1] = vertices;
    firstTriangle[b + 1] = triangles;
  });
  std::partial_sum(firstVertex.begin(), firstVertex.end(), firstVertex.begin());
  std::partial_sum(firstTriangle.begin(), firstTriangle.end(), firstTriangle.begin());
  surface.positions.resize(firstVertex.back());
  surface.triangles.resize(firstTriangle.back());
  surface.cells.resize(firstTriangle.back());

  // vertexOf[(block * cells + cell) * 3 + axis]: crossing on the edge from the cell's lowest corner along the
  // axis.
  const auto vertexOf = std::make_unique_for_overwrite<std::uint32_t[]>(blocks * kBlockCells * 3);
  forBlocks([&](std::size_t b) {
    constexpr float kMargin = 0.02f;
    std::uint32_t next = firstVertex[b];
    const Coord o = phi.origin(b);
    forCrossedCells(phi.values(b), [&](int x, int y, int z, const float* v) {
      const Vec3f base(float(o.x() + x), float(o.y() + y), float(o.z() + z));
      for (int axis = 0; axis < 3; ++axis) {
        const float v1 = v[kValueStep[std::size_t(axis)]];
        if ((v[0] < 0.0f) == (v1 < 0.0f)) continue;
        Vec3f p = base;
        p[axis] += std::clamp(v[0] / (v[0] - v1), kMargin, 1.0f - kMargin);
        vertexOf[(b * kBlockCells + std::size_t((x * kBlockSide + y) * kBlockSide + z)) * 3 +
                 std::size_t(axis)] = next;
        surface.positions[next++] = p;
      }
    });
  });

  forBlocks([&](std::size_t b) {
    const Coord o = phi.origin(b);
    std::array<std::uint32_t, 8>
        neighbor;  // block that holds a cell of local coordinates up to 8, by which of them are 8
    for (int n = 0; n < 8; ++n) {
      neighbor[std::size_t(n)] =
          n == 0
              ? std::uint32_t(b)
              : phi.find(o.offsetBy(n & 1 ? kBlockSide : 0, n & 2 ? kBlockSide : 0, n & 4 ? kBlockSide : 0));
    }
    std::uint32_t triangle = firstTriangle[b];
    // Centres are numbered after the block's crossings.
    std::uint32_t centre = firstVertex[b + 1];
    forCrossedCells(phi.values(b),
                    [&](int, int, int, const float* v) { centre -= !table[cellMask(v)].rim.empty(); });
    forCrossedCells(phi.values(b), [&](int x, int y, int z, const float* v) {
      const unsigned mask = cellMask(v);
      const Case& c = table[mask];
      if (c.triangles.empty()) return;
      const auto vertex = [&](std::uint8_t edge) {
        if (edge == kCentre) return centre;
        const int axis = edge / 4, others = edge % 4;
        const int low = axis == 0 ? others << 1 : axis == 1 ? (others & 1) | (others >> 1) << 2 : others;
        const int cx = x + (low & 1), cy = y + (low >> 1 & 1), cz = z + (low >> 2 & 1);
        const std::uint32_t block = neighbor[std::size_t((cx >> 3) | (cy >> 3) << 1 | (cz >> 3) << 2)];
        assert(block < blocks);
        const int cell = ((cx & 7) * kBlockSide + (cy & 7)) * kBlockSide + (cz & 7);
        return vertexOf[(std::size_t(block) * kBlockCells + std::size_t(cell)) * 3 + std::size_t(axis)];
      };
      for (const auto& t : c.triangles) {
        surface.cells[triangle] = o.offsetBy(x, y, z);
        surface.triangles[triangle++] = Vec3I(vertex(t[0]), vertex(t[1]), vertex(t[2]));
      }
      if (!c.rim.empty()) {
        Vec3f sum(0.0f);
        for (std::uint8_t edge : c.rim) sum += surface.positions[vertex(edge)];
        surface.positions[centre++] = sum / float(c.rim.size());
      }
    });
  });
  return surface;
}

double areaOf(const std::vector<Vec3f>& positions, const Vec3I& t) {
  const openvdb::Vec3d a(positions[t[0]]), b(positions[t[1]]), c(positions[t[2]]);
  return 0.5 * (b - a).cross(c - a).length();
}

double area(const std::vector<Vec3f>& positions, const std::vector<Vec3I>& triangles) {
  return sumOf(
      triangles.size(), [&](std::uint32_t t) { return areaOf(positions, triangles[t]); }, kTermsAtOnce);
}

double squares(const LevelSet& phi, const IsoSurface& surface) {
  return sumOf(
      surface.triangles.size(),
      [&](std::uint32_t t) {
        const float scale = phi.scale(surface.positions[surface.triangles[t][0]]);
        return areaOf(surface.positions, surface.triangles[t]) / (scale * scale);
      },
      kTermsAtOnce);
}

}  // namespace fluidtex::texture
