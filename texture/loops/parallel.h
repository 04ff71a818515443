// Parallel loops and sums over an index.
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

// Least number of indices per task, where each takes well under a microsecond.
inline constexpr std::size_t kGrain = 512;

// Calls body(i) for every i < count, in parallel and in any order. Precondition: no two bodies write to the
// same place.
template <typename Body>
void forEachIndex(std::size_t count, const Body& body, std::size_t grain = kGrain) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i != range.end(); ++i) body(std::uint32_t(i));
                    });
}

// Sum of double(term(i)) over i < count, independent of the number of threads. The grain fixes the order of
// summation, and so the last digits.
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

// Concatenates what make(i, list) appends for each i < count, in the order of i.
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
