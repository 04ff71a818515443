// Minimum cut of a binary labelling, by the maximum flow algorithm of [Boykov04], which grows search trees
// from both terminals. On the small, densely weighted graphs of label expansion it is several times faster
// than a general library.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// Minimises sum_i own_i(x_i) + sum_ij pair_ij(x_i, x_j) over x_i in {keep, take}. A pair costs nothing where
// its ends agree. Precondition: costs >= 0. Memory is reused from problem to problem; use one object per
// thread.
class MinCut {
 public:
  // Starts a problem of `nodes` nodes without costs.
  void reset(std::size_t nodes);

  // Adds to a node's cost of keeping and of taking.
  void addOwn(std::uint32_t node, float keep, float take);

  // Adds to the cost of i keeping while j takes, and of i taking while j keeps.
  void addPair(std::uint32_t i, std::uint32_t j, float keepTake, float takeKeep);

  // Solves and returns the minimum. Ties: a node keeps.
  double solve();

  // Solution, after solve().
  bool takes(std::uint32_t node) const { return m_nodes[node].parent != kFree && m_nodes[node].inSinkTree; }

 private:
  static constexpr std::int32_t kFree = -1, kTerminal = -2,
                                kOrphan = -3;  // values of Node::parent; else the arc to it

  struct Node {
    std::int32_t firstArc = -1, parent = kFree;
    std::int32_t stamp = 0, distance = 0;
    float toTerminal = 0.0f;  // residual capacity: positive from the source, negative to the sink
    bool inSinkTree = false, active = false;
  };
  struct Arc {  // arcs 2k and 2k + 1 are each other's reverse
    std::uint32_t head;
    std::int32_t next;
    float residual;
  };

  void activate(std::uint32_t node);
  std::int32_t grow(std::uint32_t node);
  void augment(std::int32_t middle);
  void orphan(std::uint32_t node);
  void adopt(std::uint32_t node);
  int distanceToTerminal(std::uint32_t node) const;
  // Residual capacity, in the direction of the tree's flow, of the arc from a node to its parent.
  float& treeResidual(std::int32_t toParent, bool sinkTree) {
    return m_arcs[std::size_t(sinkTree ? toParent : toParent ^ 1)].residual;
  }

  std::vector<Node> m_nodes;
  std::vector<Arc> m_arcs;
  std::vector<std::uint32_t> m_active, m_orphans;
  std::size_t m_nextActive = 0, m_nextOrphan = 0;
  std::int32_t m_time = 0;
  double m_flow = 0.0;
};

}  // namespace fluidtex::texture
