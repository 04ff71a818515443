// A V-cycle on coarsened cells. Coarse matrices are made by halving the grid: links between cells of twice
// the size carry four times the area over twice the distance, so half the sum of the four fine links.
// Interpolation is linear over the tetrahedron of the parent and its three nearest neighbours, and its
// transpose restricts. One red-black Gauss-Seidel sweep before and one, reversed, after the coarse correction
// keep the cycle symmetric. Sources: Trottenberg, Oosterlee, Schueller, "Multigrid", 2001 (cell-centred
// coarsening, sections 2.8 and 5); Tatebe, "The multigrid preconditioned conjugate gradient method", 1993;
// McAdams, Sifakis, Teran, "A parallel multigrid Poisson solver for fluids simulation on large grids", 2010.
#include "sim/poisson/multigrid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace fluidtex::sim {

namespace {

using Range = tbb::blocked_range<int>;

constexpr int kGrain = 4096;
constexpr int kGroup = 1024;
// A level this small is swept until it is practically solved.
constexpr int kCoarsestCells = 100;
constexpr int kCoarsestSweeps = 12;
// A face with a smaller open area fraction counts as a wall in the interpolation: the values on its two sides
// are hardly related. Without it, a ball in the flow doubles the iterations.
constexpr float kWeakLink = 0.5f;

template <typename Body>
void forEach(int begin, int end, const Body& body) {
  tbb::parallel_for(Range(begin, end, kGrain), [&](const Range& range) {
    for (int i = range.begin(); i < range.end(); ++i) body(i);
  });
}

// The side on which a cell's parent has the neighbour nearest to the cell, along each axis.
int outwardSide(const Coord& cell, int axis) {
  return 2 * axis + (cell[axis] & 1);
}

// A red cell that a coarse cell gets its share of, from the first of the coarse cell's children; axis: along
// which it lies beside them, -1 for a child.
struct Giver {
  int i, j, k, axis;
};

constexpr int kGivers = 4 + 12;

constexpr std::array<Giver, kGivers> kRedGivers = [] {
  std::array<Giver, kGivers> givers{};
  int n = 0;
  for (int i = -1; i < 3; ++i) {
    for (int j = -1; j < 3; ++j) {
      for (int k = -1; k < 3; ++k) {
        const bool outside[3] = {i < 0 || i > 1, j < 0 || j > 1, k < 0 || k > 1};
        if (((i + j + k) & 1) != 0 || outside[0] + outside[1] + outside[2] > 1) continue;
        givers[n++] = {i, j, k, outside[0] ? 0 : outside[1] ? 1 : outside[2] ? 2 : -1};
      }
    }
  }
  return givers;
}();

// The coarse blocks that hold the parents of all cells.
std::vector<CellBlock> coarseBlocks(const CellNumbering& fine) {
  std::vector<Coord> origins;
  for (const Coord& origin : fine.origins()) origins.push_back((origin >> 4) << 3);
  std::sort(origins.begin(), origins.end());
  origins.erase(std::unique(origins.begin(), origins.end()), origins.end());
  std::vector<CellBlock> all(origins.size());
  tbb::parallel_for(Range(0, static_cast<int>(all.size())), [&](const Range& range) {
    for (int b = range.begin(); b < range.end(); ++b) {
      CellBlock& block = all[b];
      block.origin = origins[b];
      for (int octant = 0; octant < 8; ++octant) {
        const Coord half((octant >> 2) & 1, (octant >> 1) & 1, octant & 1);
        const int* numbers = fine.block((block.origin << 1) + (half << 3));
        if (numbers == nullptr) continue;
        for (int c = 0; c < 512; ++c) {
          if (numbers[c] < 0) continue;
          const int i = 4 * half[0] + (c >> 7), j = 4 * half[1] + ((c >> 4) & 3),
                    k = 4 * half[2] + ((c >> 1) & 3);
          block.cells.set(64 * i + 8 * j + k);
        }
      }
    }
  });
  return all;
}

}  // namespace

Multigrid::Multigrid(const PoissonSystem& system, const EvenRows& even) {
  m_levels.push_back(std::make_unique<Level>());
  Level& finest = *m_levels.back();
  finest.numbering = &system.numbering;
  finest.rows = &system.rows;
  finest.even = even;
  finest.anchor = &system.anchor;
  finest.anchoredSides = &system.anchoredSides;

  for (int depth = 0;; ++depth) {
    Level& level = *m_levels.back();
    const int n = level.numbering->size();
    level.inverseDiagonal.resize(n);
    forEach(0, n, [&](int i) {
      double diagonal = (*level.anchor)[i];
      for (const float link : level.rows->link[i]) diagonal += link;
      level.inverseDiagonal[i] = diagonal > 0.0 ? static_cast<float>(1.0 / diagonal) : 0.0f;
    });
    level.residual.assign(level.numbering->redCount(), 0.0f);
    if (depth > 0) {
      level.b.assign(n + 1, 0.0f);
      level.x.assign(n + 1, 0.0f);
    }
    if (n <= kCoarsestCells) break;
    std::unique_ptr<Level> coarse = coarsen(level, depth);
    connect(level, *coarse, depth);
    m_levels.push_back(std::move(coarse));
  }
}

std::unique_ptr<Multigrid::Level> Multigrid::coarsen(const Level& fine, int depth) {
  auto level = std::make_unique<Level>();
  Level& coarse = *level;
  const std::vector<CellBlock> blocks = coarseBlocks(*fine.numbering);
  coarse.ownNumbering = CellNumbering(blocks);
  coarse.numbering = &coarse.ownNumbering;
  coarse.rows = &coarse.ownRows;
  coarse.anchor = &coarse.ownAnchor;
  coarse.anchoredSides = &coarse.ownAnchoredSides;
  const int n = coarse.numbering->size();
  coarse.ownRows.resize(n);
  coarse.ownAnchor.resize(n);
  coarse.ownAnchoredSides.resize(n);
  // The link of a fully open face grows by two with each level.
  const double openLink = std::ldexp(1.0, depth);
  const auto gatherChildren = [&](int i, const Coord& cell) {
    std::array<float, kSides>& links = coarse.ownRows.link[i];
    links.fill(0.0f);
    double anchor = 0.0;
    int sides = 0;
    // The children of a cell lie in one block.
    const Coord first = cell << 1;
    const int* numbers = fine.numbering->block(first);
    const int at = ((first[0] & 7) << 6) | ((first[1] & 7) << 3) | (first[2] & 7);
    for (int child = 0; child < 8; ++child) {
      const Coord place = first + Coord((child >> 2) & 1, (child >> 1) & 1, child & 1);
      const int f = numbers[at + ((child >> 2) & 1) * 64 + ((child >> 1) & 1) * 8 + (child & 1)];
      if (f < 0) continue;
      for (int axis = 0; axis < 3; ++axis) {
        const int s = outwardSide(place, axis);
        links[s] += 0.5f * fine.rows->link[f][s];
      }
      // The centre of the coarse cell lies half a fine cell further from the surface.
      const double fineAnchor = (*fine.anchor)[f];
      if (fineAnchor > 0.0) anchor += 1.0 / (1.0 / fineAnchor + 0.5 / openLink);
      sides |= (*fine.anchoredSides)[f];
    }
    coarse.ownAnchor[i] = anchor;
    coarse.ownAnchoredSides[i] = static_cast<std::uint8_t>(sides);
  };
  tbb::parallel_for(Range(0, static_cast<int>(blocks.size())), [&](const Range& range) {
    for (int b = range.begin(); b < range.end(); ++b) {
      const Coord& origin = blocks[b].origin;
      const BlockNumbers numbers(coarse.ownNumbering, origin);
      for (int c = 0; c < 512; ++c) {
        const int i = numbers.at(c);
        if (i < 0) continue;
        for (int s = 0; s < kSides; ++s) {
          const int neighbor = numbers.beside(c, s);
          coarse.ownRows.neighbor[i][s] = neighbor < 0 ? n : neighbor;
        }
        gatherChildren(i, origin.offsetBy(c >> 6, (c >> 3) & 7, c & 7));
      }
    }
  });
  coarse.even = EvenRows(coarse.ownRows, coarse.ownAnchor);
  return level;
}

void Multigrid::connect(Level& fine, const Level& coarse, int depth) {
  const int none = coarse.numbering->size();
  const float weak = kWeakLink * std::ldexp(1.0f, depth);
  fine.interpolation.resize(fine.numbering->redCount());
  forEach(0, fine.numbering->redCount(), [&](int f) {
    const Coord cell = fine.numbering->cell(f);
    Interpolation& to = fine.interpolation[f];
    const int parent = coarse.numbering->at(cell >> 1);
    int quarters = 1;
    to.others.fill(none);
    for (int axis = 0; axis < 3; ++axis) {
      const int s = outwardSide(cell, axis);
      if (fine.rows->link[f][s] > weak) {
        to.others[axis] = coarse.ownRows.neighbor[parent][s];
      } else if (((*fine.anchoredSides)[f] >> s & 1) == 0) {
        ++quarters;  // a wall, or nearly: no change across it
      }              // else the surface, where the value is 0
    }
    to.own = Share(parent, quarters);
  });

  // The same weights, listed for each coarse cell: from its red children, and from red cells beside it.
  const auto forEntries = [&](int c, const auto& body) {
    const Coord first = coarse.numbering->cell(c) << 1;
    for (const auto& [i, j, k, axis] : kRedGivers) {
      const int f = fine.numbering->at(first.offsetBy(i, j, k));
      if (f < 0) continue;
      const Interpolation& from = fine.interpolation[f];
      if (axis < 0) {
        body(f, from.own.quarters());
      } else if (from.others[axis] == c) {
        body(f, 1);
      }
    }
  };
  const int groups = (none + kGroup - 1) / kGroup;
  fine.entries.resize(groups);
  fine.entryEnd.resize(none);
  tbb::parallel_for(0, groups, [&](int group) {
    thread_local std::vector<Share> entries;
    entries.clear();
    for (int c = group * kGroup; c < std::min(none, (group + 1) * kGroup); ++c) {
      forEntries(c, [&](int f, int quarters) { entries.emplace_back(f, quarters); });
      fine.entryEnd[c] = static_cast<int>(entries.size());
    }
    fine.entries[group] = entries;
  });
}

void Multigrid::apply(const std::vector<float>& b, std::vector<float>& x) {
  cycle(0, b, x);
}

void Multigrid::cycle(std::size_t depth, const std::vector<float>& b, std::vector<float>& x) {
  Level& level = *m_levels[depth];
  const int n = level.numbering->size(), red = level.numbering->redCount();
  const auto* neighbors = level.rows->neighbor.data();
  const auto* links = level.rows->link.data();
  const float* inverse = level.inverseDiagonal.data();
  // Calls put(i, sum over the neighbours of cell i).
  const auto forSums = [&](int begin, int end, const auto& put) {
    tbb::parallel_for(Range(begin, end, kGrain), [&](const Range& range) {
      level.even.forParts(
          range.begin(), range.end(),
          [&](int first, int last, float link) {
            for (int i = first; i < last; ++i) {
              float value = 0.0f;
              for (const int neighbor : neighbors[i]) value += x[neighbor];
              put(i, link * value);
            }
          },
          [&](int first, int last) {
            for (int i = first; i < last; ++i) {
              float value = 0.0f;
              for (int s = 0; s < kSides; ++s) value += links[i][s] * x[neighbors[i][s]];
              put(i, value);
            }
          });
    });
  };
  const auto relax = [&](int begin, int end) {
    forSums(begin, end, [&](int i, float sum) { x[i] = (b[i] + sum) * inverse[i]; });
  };

  forEach(0, red, [&](int i) { x[i] = b[i] * inverse[i]; });
  relax(red, n);

  if (depth + 1 == m_levels.size()) {
    for (int sweep = 1; sweep < kCoarsestSweeps; ++sweep) {
      relax(0, red);
      relax(red, n);
    }
    for (int sweep = 0; sweep < kCoarsestSweeps; ++sweep) {
      relax(red, n);
      relax(0, red);
    }
    return;
  }

  // Black cells have no residual; that of the red ones is what the black neighbours have added since.
  Level& coarse = *m_levels[depth + 1];
  forSums(0, red, [&](int i, float sum) { level.residual[i] = sum; });
  forEach(0, coarse.numbering->size(), [&](int c) {
    float value = 0.0f;
    const Share* entries = level.entries[c / kGroup].data();
    for (int e = c % kGroup == 0 ? 0 : level.entryEnd[c - 1]; e < level.entryEnd[c]; ++e)
      value += entries[e].weight() * level.residual[entries[e].cell()];
    coarse.b[c] = value;
  });
  cycle(depth + 1, coarse.b, coarse.x);
  // The sweep back starts with the black cells, from red values alone: only those need the correction.
  forEach(0, red, [&](int i) {
    const auto& [own, others] = level.interpolation[i];
    x[i] += own.weight() * coarse.x[own.cell()] +
            0.25f * (coarse.x[others[0]] + coarse.x[others[1]] + coarse.x[others[2]]);
  });
  relax(red, n);
  relax(0, red);
}

}  // namespace fluidtex::sim
