// Which of a set of things are connected, by pairs that are.
#pragma once

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace fluidtex::caches {

// Each thing is one of its own at first.
class Connected {
 public:
  explicit Connected(std::size_t count) : m_parent(count) { std::iota(m_parent.begin(), m_parent.end(), 0u); }

  // The lowest thing that this one is connected to; paths are halved on the way.
  std::uint32_t lowest(std::uint32_t n) {
    while (m_parent[n] != n) n = m_parent[n] = m_parent[m_parent[n]];
    return n;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    a = lowest(a);
    b = lowest(b);
    if (a != b) m_parent[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::uint32_t> m_parent;
};

}  // namespace fluidtex::caches
