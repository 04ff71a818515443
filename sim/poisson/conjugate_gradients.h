// Preconditioned conjugate gradients for symmetric, positive (semi)definite systems, in the flexible form,
// which tolerates a preconditioner rounded to single precision: Notay, "Flexible conjugate gradients", 2000.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace fluidtex::sim {

// Indices are split at fixed places, so that sums do not depend on the number of threads.
using IndexRange = tbb::blocked_range<std::int32_t>;
inline constexpr std::int32_t kIndicesAtOnce = 8192;

template <class Sums, class Body, class Join>
Sums sumsOver(std::int32_t n, const Body& body, const Join& join) {
  return tbb::parallel_deterministic_reduce(
      IndexRange(0, n, kIndicesAtOnce), Sums{},
      [&](const IndexRange& range, Sums sums) {
        for (std::int32_t i = range.begin(); i < range.end(); ++i) body(i, sums);
        return sums;
      },
      join);
}

// Sum of term(i), 0 <= i < n.
template <class Term>
double sumOver(std::int32_t n, const Term& term) {
  return sumsOver<double>(
      n, [&](std::int32_t i, double& sum) { sum += term(i); }, [](double a, double b) { return a + b; });
}

// One system's vectors. Of each the first n values are unknowns; what stands behind them is neither read nor
// written here.
struct ConjugateGradients {
  std::int32_t n = 0;
  std::vector<double>& x;          // in: first guess; out: solution
  std::vector<double> r = {};      // right-hand side minus matrix times x
  std::vector<double> p = {};      // direction
  std::vector<double> q = {};      // matrix times p
  std::vector<float> scaled = {};  // the residual, with an rms of 1
  std::vector<float> z = {};       // what the preconditioner makes of it
  double rightNorm = 0.0;          // 2-norm of the right-hand side, above 0
  double residualNorm = 0.0;       // of r
};

// Steps until the residual's 2-norm is at most `tolerance` times the right-hand side's, after
// `maxIterations`, where only rounding is left, or where goesOn() says no.
//   precondition()  fills z from `scaled`: about the inverse of the matrix
//   product()       fills q, the matrix times p, and returns p.q
//   goesOn()        asked after each step that has not converged
// report: a struct with iterations, residual (relative) and converged, which hold the state at the beginning.
template <class Precondition, class Product, class GoesOn, class Report>
void conjugateGradients(ConjugateGradients& v, double tolerance, int maxIterations,
                        const Precondition& precondition, const Product& product, const GoesOn& goesOn,
                        Report& report) {
  using Sums = std::pair<double, double>;
  const std::int32_t n = v.n;
  const auto forAll = [n](const auto& body) {
    tbb::parallel_for(IndexRange(0, n, kIndicesAtOnce), [&](const IndexRange& range) {
      for (std::int32_t i = range.begin(); i < range.end(); ++i) body(i);
    });
  };
  double rz = 0.0, alpha = 0.0;
  bool wanted = true;
  while (wanted && !report.converged && report.iterations < maxIterations && std::isfinite(report.residual)) {
    // Scaled, since the preconditioner works on values of about 1.
    const double unit = v.residualNorm / std::sqrt(static_cast<double>(n));
    forAll([&](std::int32_t i) { v.scaled[i] = static_cast<float>(v.r[i] / unit); });
    precondition();
    // z.(r - r_old) = -alpha z.q gives the flexible (Polak-Ribiere) direction without keeping the old
    // residual.
    const auto [zr, zq] = sumsOver<Sums>(
        n,
        [&](std::int32_t i, Sums& sums) {
          sums.first += v.z[i] * v.r[i];
          sums.second += v.z[i] * v.q[i];
        },
        [](const Sums& a, const Sums& b) {
          return Sums{a.first + b.first, a.second + b.second};
        });
    const bool first = report.iterations == 0;
    const double beta = first ? 0.0 : -alpha * zq / rz;
    rz = zr;
    forAll([&](std::int32_t i) { v.p[i] = first ? v.z[i] : v.z[i] + beta * v.p[i]; });
    const double pq = product();
    if (!(pq > 0.0) || !(rz > 0.0)) break;  // only rounding is left
    alpha = rz / pq;
    v.residualNorm = std::sqrt(sumOver(n, [&](std::int32_t i) {
      v.x[i] += alpha * v.p[i];
      v.r[i] -= alpha * v.q[i];
      return v.r[i] * v.r[i];
    }));
    ++report.iterations;
    report.residual = v.residualNorm / v.rightNorm;
    report.converged = report.residual <= tolerance;
    wanted = report.converged || goesOn();
  }
}

}  // namespace fluidtex::sim
