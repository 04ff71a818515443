// Singular parts: Bochev and Lehoucq, "On the finite element solution of the pure Neumann problem", 2005.
#include "sim/poisson/poisson.h"

#include "sim/poisson/conjugate_gradients.h"
#include "sim/poisson/multigrid.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace fluidtex::sim {

namespace {

using Range = IndexRange;

template <typename Scalar>
void removeMeans(const std::vector<std::vector<int>>& parts, std::vector<Scalar>& values) {
  for (const auto& part : parts) {
    double mean = 0.0;
    for (const int i : part) mean += values[i];
    mean /= static_cast<double>(part.size());
    for (const int i : part) values[i] -= static_cast<Scalar>(mean);
  }
}

}  // namespace

CellNumbering::CellNumbering(const std::vector<CellBlock>& blocks) {
  m_lists = std::make_shared<Lists>();
  Lists& lists = *m_lists;
  for (const CellBlock& block : blocks) {
    lists.origins.push_back(block.origin);
    lists.tables.enter(block.origin >> 5);
  }
  lists.blockStart.assign(64 * lists.tables.size(), -1);
  lists.numbers.assign(blocks.size() * 512, -1);

  std::bitset<512> red;
  for (int c = 0; c < 512; ++c) red[c] = (((c >> 6) ^ (c >> 3) ^ c) & 1) == 0;

  const int count = static_cast<int>(blocks.size());
  std::vector<int> firstRed(count), firstBlack(count);
  int size = 0;
  for (int b = 0; b < count; ++b) {
    const std::size_t table = lists.tables.find(blocks[b].origin >> 5);
    lists.blockStart[64 * table + placeInTable(blocks[b].origin)] = b * 512;
    firstRed[b] = m_red;
    const int reds = static_cast<int>((blocks[b].cells & red).count());
    m_red += reds;
    size += static_cast<int>(blocks[b].cells.count());
    firstBlack[b] = size - m_red;
  }
  // firstBlack counts past the block's own black cells.
  for (int b = 0; b < count; ++b) {
    firstBlack[b] += m_red - static_cast<int>((blocks[b].cells & ~red).count());
  }
  lists.places.resize(size);
  tbb::parallel_for(Range(0, count), [&](const Range& range) {
    for (int b = range.begin(); b < range.end(); ++b) {
      int nextRed = firstRed[b], nextBlack = firstBlack[b];
      for (int c = 0; c < 512; ++c) {
        if (!blocks[b].cells[c]) continue;
        const int number = red[c] ? nextRed++ : nextBlack++;
        lists.numbers[b * 512 + c] = number;
        lists.places[number] = b * 512 + c;
      }
    }
  });
}

BlockNumbers::BlockNumbers(const CellNumbering& numbering, const Coord& origin) {
  m_own = numbering.block(origin);
  for (int s = 0; s < kSides; ++s) {
    Coord there = origin;
    there[s >> 1] += (s & 1) != 0 ? 8 : -8;
    m_beside[s] = numbering.block(there);
  }
}

EvenRows::EvenRows(const PoissonRows& rows, const std::vector<double>& anchor)
    : m_link((rows.size() + (1u << kShift) - 1) >> kShift) {
  const int n = static_cast<int>(rows.size());
  tbb::parallel_for(Range(0, static_cast<int>(m_link.size()), 64), [&](const Range& range) {
    for (int part = range.begin(); part < range.end(); ++part) {
      const int first = part << kShift, last = std::min(n, first + (1 << kShift));
      const float link = rows.link[first][0];
      bool alike = true;
      for (int i = first; i < last; ++i) {
        alike = alike && anchor[i] == 0.0;
        for (const float other : rows.link[i]) alike = alike && other == link;
      }
      m_link[part] = alike ? link : 0.0f;
    }
  });
}

namespace {

// Whether each connected part has an anchor: cells are merged with their lower neighbours in the order in
// which they lie in memory.
bool allAnchored(const PoissonSystem& system) {
  const int n = system.numbering.size();
  std::vector<int> above(n);  // another cell of the part, itself for one cell of each part
  std::iota(above.begin(), above.end(), 0);
  const auto rootOf = [&](int i) {
    while (above[i] != i) i = above[i] = above[above[i]];
    return i;
  };
  for (int i = 0; i < n; ++i) {
    for (int s = 0; s < kSides; s += 2) {
      if (system.rows.link[i][s] <= 0.0f) continue;
      const int a = rootOf(i), b = rootOf(system.rows.neighbor[i][s]);
      above[std::max(a, b)] = std::min(a, b);
    }
  }
  std::vector<char> anchored(n, 0);
  for (int i = 0; i < n; ++i) {
    if (system.anchor[i] > 0.0) anchored[rootOf(i)] = 1;
  }
  for (int i = 0; i < n; ++i) {
    if (above[i] == i && !anchored[i]) return false;
  }
  return true;
}

}  // namespace

std::vector<std::vector<int>> singularParts(const PoissonSystem& system) {
  if (allAnchored(system)) return {};
  const int n = system.numbering.size();
  std::vector<char> seen(n, 0);
  std::vector<int> front;
  for (int i = 0; i < n; ++i) {
    if (system.anchor[i] > 0.0) {
      seen[i] = 1;
      front.push_back(i);
    }
  }
  const auto visitNeighbors = [&](int i) {
    for (int s = 0; s < kSides; ++s) {
      const int j = system.rows.neighbor[i][s];
      if (j < n && system.rows.link[i][s] > 0.0f && !seen[j]) {
        seen[j] = 1;
        front.push_back(j);
      }
    }
  };
  for (std::size_t next = 0; next < front.size(); ++next) visitNeighbors(front[next]);

  std::vector<std::vector<int>> parts;
  if (static_cast<int>(front.size()) == n) return parts;
  for (int i = 0; i < n; ++i) {
    if (seen[i]) continue;
    seen[i] = 1;
    front.assign(1, i);
    for (std::size_t next = 0; next < front.size(); ++next) visitNeighbors(front[next]);
    parts.push_back(front);
  }
  return parts;
}

PoissonSolver::PoissonSolver(const PoissonSystem& system, const std::vector<std::vector<int>>& singular)
    : m_system(system), m_singular(singular), m_even(system.rows, system.anchor) {}

PoissonSolver::~PoissonSolver() = default;

PoissonReport PoissonSolver::solve(std::vector<double> b, std::vector<double>& x, double tolerance,
                                   int maxIterations, const PoissonProbe& probe) {
  const PoissonSystem& system = m_system;
  const EvenRows& even = m_even;
  const int n = system.numbering.size();
  removeMeans(m_singular, b);

  PoissonReport report;
  const double rightNorm = std::sqrt(sumOver(n, [&](int i) { return b[i] * b[i]; }));
  if (!(rightNorm > 0.0)) {
    std::fill(x.begin(), x.end(), 0.0);
    report.converged = rightNorm == 0.0;
    report.residual = rightNorm;
    return report;
  }

  // One value more, 0, for neighbours that are not there.
  ConjugateGradients v{.n = n,
                       .x = x,
                       .r = std::move(b),
                       .p = std::vector<double>(n + 1, 0.0),
                       .q = std::vector<double>(n),
                       .scaled = std::vector<float>(n + 1, 0.0f),
                       .z = std::vector<float>(n + 1, 0.0f),
                       .rightNorm = rightNorm};
  std::copy(x.begin(), x.end(), v.p.begin());
  // The sum of what body(i, row i times p) gives.
  const auto sumOfProducts = [&](const auto& body) {
    const std::vector<double>& p = v.p;
    return tbb::parallel_deterministic_reduce(
        Range(0, n, kIndicesAtOnce), 0.0,
        [&](const Range& range, double total) {
          even.forParts(
              range.begin(), range.end(),
              [&](int first, int last, double link) {
                for (int i = first; i < last; ++i) {
                  double value = 6.0 * link * p[i];
                  for (const int neighbor : system.rows.neighbor[i]) value -= link * p[neighbor];
                  total += body(i, value);
                }
              },
              [&](int first, int last) {
                for (int i = first; i < last; ++i) {
                  const auto& link = system.rows.link[i];
                  const double diagonal =
                      system.anchor[i] + (double(link[0]) + link[1] + link[2] + link[3] + link[4] + link[5]);
                  double value = diagonal * p[i];
                  for (int s = 0; s < kSides; ++s) value -= link[s] * p[system.rows.neighbor[i][s]];
                  total += body(i, value);
                }
              });
          return total;
        },
        std::plus<double>());
  };
  v.residualNorm = std::sqrt(sumOfProducts([&](int i, double product) {
    v.r[i] -= product;
    return v.r[i] * v.r[i];
  }));
  report.residual = v.residualNorm / v.rightNorm;
  report.converged = report.residual <= tolerance;
  if (report.converged) return report;

  if (m_preconditioner == nullptr) m_preconditioner = std::make_unique<Multigrid>(system, even);
  const auto precondition = [&] {
    m_preconditioner->apply(v.scaled, v.z);
    removeMeans(m_singular, v.z);
  };
  const auto product = [&] {
    return sumOfProducts([&](int i, double value) {
      v.q[i] = value;
      return v.p[i] * value;
    });
  };
  bool asked = probe.continues == nullptr;
  const auto goesOn = [&] {
    if (asked || report.residual > probe.tolerance) return true;
    asked = true;
    report.ended = !probe.continues(x);
    return !report.ended;
  };
  conjugateGradients(v, tolerance, maxIterations, precondition, product, goesOn, report);
  removeMeans(m_singular, x);
  return report;
}

PoissonReport solvePoisson(const PoissonSystem& system, const std::vector<std::vector<int>>& singular,
                           std::vector<double> b, std::vector<double>& x, double tolerance,
                           int maxIterations) {
  return PoissonSolver(system, singular).solve(std::move(b), x, tolerance, maxIterations);
}

}  // namespace fluidtex::sim
