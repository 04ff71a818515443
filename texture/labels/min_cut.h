// The minimum cut of a graph whose nodes have two labels, found as a maximum flow by growing search trees
// from both terminals [Boykov04]: on the small, densely weighted graphs of label expansion it is several
// times faster than a library's general flow.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace fluidtex::texture {

// Minimises sum_i own_i(x_i) + sum_ij pair_ij(x_i, x_j) over x_i in {keep, take}, where a pair costs
// something only if its ends differ. All costs are 0 or more. Memory is kept from one problem to the next:
// one object a thread.
class MinCut {
 public:
  // Starts a problem of `nodes` nodes without costs.
  void reset(std::size_t nodes);

  // Adds to the cost of a node that keeps and of one that takes.
  void addOwn(std::uint32_t node, float keep, float take);

  // Adds to the cost of i keeping while j takes (keepTake), and of i taking while j keeps (takeKeep).
  void addPair(std::uint32_t i, std::uint32_t j, float keepTake, float takeKeep);

  // Solves, and returns the least cost. Where both labels are as good, a node keeps.
  double solve();

  // After solve().
  bool takes(std::uint32_t node) const { return m_nodes[node].parent != kFree && m_nodes[node].inSinkTree; }

 private:
  static constexpr std::int32_t kFree = -1, kTerminal = -2,
                                kOrphan = -3;  // of Node::parent; else an arc to it

  struct Node {
    std::int32_t firstArc = -1, parent = kFree;
    std::int32_t stamp = 0, distance = 0;
    float toTerminal = 0.0f;  // residual capacity: from the source where positive, to the sink where negative
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
  // Residual capacity of the tree's flow through an arc that leads from a node towards its parent.
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
