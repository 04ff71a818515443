// Loops and sums over an index, shared out among threads.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <cstddef>
#include <cstdint>
#include <functional>

namespace fluidtex::texture {

// Indices that one task gets at least, where each costs well under a microsecond.
inline constexpr std::size_t kGrain = 512;

// Calls body(i) for every i < count, in any order and at once: bodies must write to places of their own.
template <typename Body>
void forEachIndex(std::size_t count, const Body& body, std::size_t grain = kGrain) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) body(std::uint32_t(i));
                    });
}

// The sum of double(term(i)) over all i < count, the same on any number of threads. The grain decides the
// order in which terms are added, and with it the last digits.
template <typename Term>
double sumOf(std::size_t count, const Term& term, std::size_t grain = kGrain) {
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, count, grain), 0.0,
      [&](const tbb::blocked_range<std::size_t>& range, double sum) {
        for (std::size_t i = range.begin(); i != range.end(); ++i) sum += double(term(std::uint32_t(i)));
        return sum;
      },
      std::plus<>());
}

}  // namespace fluidtex::texture
