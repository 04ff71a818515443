// Shared by first and later frames: tables by level and window, and the passes of one level.
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

// A level's mesh with its graph and connection. Keeps a reference to the mesh.
struct PreparedMesh {
  explicit PreparedMesh(const SurfaceMesh& surface);
  MeshView view() const { return {mesh, graph, connection}; }

  const SurfaceMesh& mesh;
  VertexGraph graph;
  Connection connection;
};

// Channel weights of seam costs: 1, but 0 for the guidance map and for the gradient channel, which is the
// last.
Float8 seamChannels(const Synthesizer& synthesizer);

SeamModel seamModel(const Synthesizer& synthesizer, const MeshView& view, std::size_t level);

// Window widths that fit a level's exemplar, without repetition, each with its index in options.windows.
std::vector<std::pair<int, std::size_t>> windowsOf(const Synthesizer& synthesizer, int level);

// #V, 1 where textures are searched: all but droplets. Empty: everywhere.
std::vector<std::uint8_t> searched(const Synthesizer& synthesizer, const VertexGraph& graph);

// Key of a pass's random numbers.
std::uint64_t keyOf(const Synthesizer& synthesizer, int frame, int level, int window);

struct PassPlan {
  int index = 0;  // pyramid level
  int frame = 0;
  const std::vector<int>& iterations;  // per window of the options; the last holds for those that follow
  int factor = 1;                      // on the iterations
  bool tree = true;                    // candidates from the tree; else from k-coherence
  std::size_t begin = 0, end = 1000;   // range of the windows that fit, widest first
};

// One pass per window width, widest first. Adds to stats; progress is called with 0..1.
void runPasses(Synthesizer& synthesizer, const Level& level, const PassPlan& plan, State& state,
               SynthesisStats& stats, const Progress& progress);

// Moves seams to where they show least: first vertex by vertex (straightenSeams), then by alpha expansion
// (expandLabels). data: weight of the data term, the difference from state.average. free: #V, 1 where labels
// may change, empty for all. alternative: labels offered besides the neighbours', or null.
void joinLabels(const SeamModel& seams, const State& state, float data, const std::vector<std::uint8_t>& free,
                const Labels* alternative, std::uint64_t seed, Labels& labels);

}  // namespace fluidtex::texture
