// Loops and sums over an index, shared out among threads.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

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

// What make(i, list) adds to the list for each i < count, in the order of i.
template <typename Value, typename Make>
std::vector<Value> gathered(std::size_t count, const Make& make, std::size_t chunk = 4 * kGrain) {
  std::vector<std::vector<Value>> parts((count + chunk - 1) / chunk);
  tbb::parallel_for(std::size_t(0), parts.size(), [&](std::size_t part) {
    const std::size_t end = std::min(count, (part + 1) * chunk);
    for (std::size_t i = part * chunk; i < end; ++i) make(std::uint32_t(i), parts[part]);
  });
  std::vector<Value> all;
  if (parts.size() == 1) all.swap(parts[0]);
  std::size_t size = all.size();
  for (const auto& part : parts) size += part.size();
  all.reserve(size);
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace fluidtex::texture
