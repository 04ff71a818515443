// Y. Boykov, V. Kolmogorov, "An experimental comparison of min-cut/max-flow algorithms for energy
// minimization in vision" (2004). The source's side keeps, the sink's takes.
#include "texture/labels/min_cut.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace fluidtex::texture {
namespace {

constexpr int kFar = std::numeric_limits<int>::max();

}  // namespace

void MinCut::reset(std::size_t nodes) {
  m_nodes.assign(nodes, {});
  m_arcs.clear();
  m_flow = 0.0;
}

void MinCut::addOwn(std::uint32_t node, float keep, float take) {
  // The source arc is cut where the node takes, the sink arc where it keeps. Flow through both is pushed at
  // once.
  float& residual = m_nodes[node].toTerminal;
  float fromSource = take, toSink = keep;
  if (residual > 0.0f)
    fromSource += residual;
  else
    toSink -= residual;
  m_flow += double(std::min(fromSource, toSink));
  residual = fromSource - toSink;
}

void MinCut::addPair(std::uint32_t i, std::uint32_t j, float keepTake, float takeKeep) {
  const auto arc = std::int32_t(m_arcs.size());
  m_arcs.push_back({j, m_nodes[i].firstArc, keepTake});
  m_arcs.push_back({i, m_nodes[j].firstArc, takeKeep});
  m_nodes[i].firstArc = arc;
  m_nodes[j].firstArc = arc + 1;
}

void MinCut::activate(std::uint32_t node) {
  if (m_nodes[node].active) return;
  m_nodes[node].active = true;
  m_active.push_back(node);
}

void MinCut::orphan(std::uint32_t node) {
  m_nodes[node].parent = kOrphan;
  m_orphans.push_back(node);
}

double MinCut::solve() {
  m_active.clear();
  m_nextActive = 0;
  m_time = 0;
  for (std::uint32_t i = 0; i < m_nodes.size(); ++i) {
    Node& node = m_nodes[i];
    if (node.toTerminal == 0.0f) continue;
    node.inSinkTree = node.toTerminal < 0.0f;
    node.parent = kTerminal;
    node.distance = 1;
    activate(i);
  }
  while (m_nextActive < m_active.size()) {
    const std::uint32_t i = m_active[m_nextActive];
    const std::int32_t middle = m_nodes[i].parent == kFree ? -1 : grow(i);
    ++m_time;
    if (middle < 0) {  // all paths from here are exhausted
      m_nodes[i].active = false;
      ++m_nextActive;
      continue;
    }
    m_orphans.clear();
    m_nextOrphan = 0;
    augment(middle);
    while (m_nextOrphan < m_orphans.size()) adopt(m_orphans[m_nextOrphan++]);
  }
  return m_flow;
}

// Adds free neighbours to the node's tree. Returns the first arc that meets the other tree, directed from the
// source's tree to the sink's; -1 if there is none.
std::int32_t MinCut::grow(std::uint32_t i) {
  const bool sinkTree = m_nodes[i].inSinkTree;
  for (std::int32_t a = m_nodes[i].firstArc; a >= 0; a = m_arcs[std::size_t(a)].next) {
    if (!(m_arcs[std::size_t(sinkTree ? a ^ 1 : a)].residual > 0.0f)) continue;
    const std::uint32_t j = m_arcs[std::size_t(a)].head;
    Node &own = m_nodes[i], &other = m_nodes[j];
    if (other.parent == kFree) {
      other.inSinkTree = sinkTree;
      activate(j);
    } else if (other.inSinkTree != sinkTree) {
      return sinkTree ? a ^ 1 : a;
    } else if (other.stamp > own.stamp || other.distance <= own.distance) {
      continue;  // its present path to the terminal is as short
    }
    other.parent = a ^ 1;
    other.stamp = own.stamp;
    other.distance = own.distance + 1;
  }
  return -1;
}

// Pushes the bottleneck capacity along the path through both trees and the arc between them.
void MinCut::augment(std::int32_t middle) {
  const std::uint32_t ends[2] = {m_arcs[std::size_t(middle ^ 1)].head, m_arcs[std::size_t(middle)].head};
  float flow = m_arcs[std::size_t(middle)].residual;
  for (const bool sinkTree : {false, true}) {
    std::uint32_t i = ends[sinkTree];
    for (; m_nodes[i].parent != kTerminal; i = m_arcs[std::size_t(m_nodes[i].parent)].head)
      flow = std::min(flow, treeResidual(m_nodes[i].parent, sinkTree));
    flow = std::min(flow, std::abs(m_nodes[i].toTerminal));
  }
  m_arcs[std::size_t(middle)].residual -= flow;
  m_arcs[std::size_t(middle ^ 1)].residual += flow;
  for (const bool sinkTree : {false, true}) {
    std::uint32_t i = ends[sinkTree];
    while (m_nodes[i].parent != kTerminal) {
      const std::int32_t up = m_nodes[i].parent;
      float& residual = treeResidual(up, sinkTree);
      residual -= flow;
      treeResidual(up, !sinkTree) += flow;
      if (!(residual > 0.0f)) orphan(i);
      i = m_arcs[std::size_t(up)].head;
    }
    m_nodes[i].toTerminal += sinkTree ? flow : -flow;
    if (m_nodes[i].toTerminal == 0.0f) orphan(i);
  }
  m_flow += double(flow);
}

// Arcs from a node to its terminal; kFar if an orphan is on the path.
int MinCut::distanceToTerminal(std::uint32_t i) const {
  for (int steps = 0;; ++steps) {
    const Node& node = m_nodes[i];
    if (node.parent == kOrphan) return kFar;
    if (node.stamp == m_time) return steps + node.distance;
    if (node.parent == kTerminal) return steps + 1;
    i = m_arcs[std::size_t(node.parent)].head;
  }
}

// Adoption: gives an orphan the parent in its tree that is nearest to the terminal. Without one the node
// becomes free and its children orphans.
void MinCut::adopt(std::uint32_t i) {
  const bool sinkTree = m_nodes[i].inSinkTree;
  int least = kFar;
  std::int32_t best = -1;
  for (std::int32_t a = m_nodes[i].firstArc; a >= 0; a = m_arcs[std::size_t(a)].next) {
    const std::uint32_t j = m_arcs[std::size_t(a)].head;
    if (m_nodes[j].inSinkTree != sinkTree || m_nodes[j].parent == kFree ||
        !(treeResidual(a, sinkTree) > 0.0f))
      continue;
    int distance = distanceToTerminal(j);
    if (distance == kFar) continue;
    if (distance < least) least = distance, best = a;
    // Marks the path, so that it is not walked again.
    for (std::uint32_t k = j; m_nodes[k].stamp != m_time; --distance) {
      m_nodes[k].stamp = m_time;
      m_nodes[k].distance = distance;
      if (m_nodes[k].parent == kTerminal) break;
      k = m_arcs[std::size_t(m_nodes[k].parent)].head;
    }
  }
  if (best >= 0) {
    m_nodes[i].parent = best;
    m_nodes[i].stamp = m_time;
    m_nodes[i].distance = least + 1;
    return;
  }
  m_nodes[i].parent = kFree;
  for (std::int32_t a = m_nodes[i].firstArc; a >= 0; a = m_arcs[std::size_t(a)].next) {
    const std::uint32_t j = m_arcs[std::size_t(a)].head;
    const std::int32_t parent = m_nodes[j].parent;
    if (m_nodes[j].inSinkTree != sinkTree || parent == kFree) continue;
    if (treeResidual(a, sinkTree) > 0.0f) activate(j);
    if (parent >= 0 && m_arcs[std::size_t(parent)].head == i) orphan(j);
  }
}

}  // namespace fluidtex::texture
