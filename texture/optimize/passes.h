// What the first and the later frames share: tables by level and window, and the passes of one level.
#pragma once

#include "texture/labels/seams.h"
#include "texture/optimize/optimize.h"
#include "texture/optimize/synthesizer.h"

#include <map>
#include <utility>

namespace fluidtex::texture {

struct SearchTables {
  // By level.
  std::vector<TexelImage> image;
  std::vector<HistogramTarget> histogram;
  std::vector<float> seamUnit;
  // By level and window.
  std::map<std::pair<int, int>, SearchTable> table;
};

using Progress = std::function<void(double)>;

// A level's mesh with graph and connection.
struct PreparedMesh {
  explicit PreparedMesh(const SurfaceMesh& surface);
  MeshView view() const { return {mesh, graph, connection}; }

  const SurfaceMesh& mesh;
  VertexGraph graph;
  Connection connection;
};

// Channels whose jumps are seen: all but the guidance map and the gradient's, which is the last.
Float8 seamChannels(const Synthesizer& synthesizer);

SeamModel seamModel(const Synthesizer& synthesizer, const MeshView& view, std::size_t level);

// Windows that fit a level's exemplar, without repetition, each with its place in the options.
std::vector<std::pair<int, std::size_t>> windowsOf(const Synthesizer& synthesizer, int level);

// The vertices that are searched: all, which is empty, but for those of droplets.
std::vector<std::uint8_t> searched(const Synthesizer& synthesizer, const VertexGraph& graph);

// Keys random numbers of a pass.
std::uint64_t keyOf(const Synthesizer& synthesizer, int frame, int level, int window);

struct PassPlan {
  int index = 0;  // of the level
  int frame = 0;
  const std::vector<int>& iterations;  // by window; the last one stands for those that follow
  int factor = 1;                      // of the iterations
  bool tree = true;                    // search the tree of windows; else those like the best so far
  std::size_t begin = 0, end = 1000;   // of the windows that fit, the widest first
};

// One pass a window, the widest first. Adds what it did to stats.
void runPasses(Synthesizer& synthesizer, const Level& level, const PassPlan& plan, State& state,
               SynthesisStats& stats, const Progress& progress);

// From label fields to the fewest and least visible seams: vertex by vertex, then by expansion. `data`:
// weight of the difference from state.average.
void joinLabels(const SeamModel& seams, const State& state, float data, const std::vector<std::uint8_t>& free,
                const Labels* alternative, std::uint64_t seed, Labels& labels);

}  // namespace fluidtex::texture
