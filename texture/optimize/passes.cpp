#include "texture/optimize/passes.h"

#include "numerics/random.h"
#include "texture/exemplar/window_size.h"
#include "texture/labels/fresh.h"
#include "texture/labels/label_expansion.h"
#include "texture/search/table_cache.h"

#include <tbb/parallel_for.h>

#include <algorithm>

namespace fluidtex::texture {
namespace {

// On later frames, which start near a minimum, k-coherence replaces the tree search.
constexpr int kSimilar = 4;
constexpr int kSeamSweeps = 8;
constexpr float kStretchCost = 1.0f;
constexpr float kUsageCost = 0.17f;

SearchTable madeTable(const Synthesizer& synthesizer, int level, int window) {
  const bool labels = synthesizer.options.method == Method::coordinates;
  return cachedSearchTable(synthesizer.exemplar.match[std::size_t(level)], synthesizer.exemplar.toroidal,
                           window, streamOf(synthesizer.options.seed, Stream::windows),
                           level == 0 && labels ? kSimilar : 0, synthesizer.cache);
}

const SearchTable& tableFor(Synthesizer& synthesizer, int level, int window) {
  const auto key = std::make_pair(level, window);
  auto it = synthesizer.tables->table.find(key);
  if (it == synthesizer.tables->table.end())
    it = synthesizer.tables->table.emplace(key, madeTable(synthesizer, level, window)).first;
  return it->second;
}

int iterationsOf(const std::vector<int>& iterations, std::size_t i) {
  return iterations.empty() ? 1 : iterations[std::min(i, iterations.size() - 1)];
}

void record(SynthesisStats& stats, const EnergyTrace& trace) {
  if (trace.empty()) return;
  stats.energyStart = trace.front();
  stats.energyEnd = trace.back();
  stats.iterations += int(trace.size()) - 1;
}

}  // namespace

void prepareTables(Synthesizer& synthesizer) {
  std::vector<std::pair<int, int>> keys;
  for (int level = 0; level < int(synthesizer.exemplar.match.size()); ++level)
    for (const auto& [window, place] : windowsOf(synthesizer, level)) keys.emplace_back(level, window);
  std::vector<SearchTable> tables(keys.size());
  tbb::parallel_for(std::size_t(0), keys.size(), [&](std::size_t i) {
    tables[i] = madeTable(synthesizer, keys[i].first, keys[i].second);
  });
  for (std::size_t i = 0; i < keys.size(); ++i)
    synthesizer.tables->table.emplace(keys[i], std::move(tables[i]));
}

PreparedMesh::PreparedMesh(const SurfaceMesh& surface)
    : mesh(surface),
      graph(buildVertexGraph(surface)),
      connection(buildConnection(surface, graph, surface.orientation)) {}

Float8 seamChannels(const Synthesizer& synthesizer) {
  Float8 weight{};
  const int channels = synthesizer.exemplar.match.front().channels;
  const bool gradient = synthesizer.options.gradientWeight > 0.0 &&
                        channels > synthesizer.exemplar.colorChannels + synthesizer.exemplar.guided;
  for (int c = 0; c < channels - (gradient ? 1 : 0); ++c) weight[c] = 1.0f;
  if (synthesizer.exemplar.guided) weight[synthesizer.exemplar.colorChannels] = 0.0f;
  return weight;
}

SeamModel seamModel(const Synthesizer& synthesizer, const MeshView& view, std::size_t level) {
  const SearchTables& tables = *synthesizer.tables;
  return {view, tables.image[level], seamChannels(synthesizer), tables.seamUnit[level]};
}

std::vector<std::pair<int, std::size_t>> windowsOf(const Synthesizer& synthesizer, int level) {
  std::vector<std::pair<int, std::size_t>> result;
  for (std::size_t i = 0; i < synthesizer.options.windows.size(); ++i) {
    const int window = fittingWindow(synthesizer.exemplar.match[std::size_t(level)],
                                     synthesizer.exemplar.toroidal, synthesizer.options.windows[i]);
    if (window >= kSmallestWindow && (result.empty() || window < result.back().first))
      result.emplace_back(window, i);
  }
  return result;
}

std::vector<std::uint8_t> searched(const Synthesizer& synthesizer, const VertexGraph& graph) {
  const std::vector<int>& windows = synthesizer.options.windows;
  std::vector<std::uint8_t> mask = droplets(graph, *std::min_element(windows.begin(), windows.end()));
  if (!any(mask)) return {};
  for (std::uint8_t& m : mask) m = !m;
  return mask;
}

std::uint64_t keyOf(const Synthesizer& synthesizer, int frame, int level, int window) {
  return randomBits(
      randomBits(streamOf(synthesizer.options.seed, Stream::synthesis), std::uint64_t(std::int64_t(frame))),
      std::uint64_t(level) * 1024u + std::uint64_t(window));
}

void runPasses(Synthesizer& synthesizer, const Level& level, const PassPlan& plan, State& state,
               SynthesisStats& stats, const Progress& progress) {
  auto windows = windowsOf(synthesizer, plan.index);
  windows.erase(windows.begin() + std::ptrdiff_t(std::min(plan.end, windows.size())), windows.end());
  windows.erase(windows.begin(), windows.begin() + std::ptrdiff_t(std::min(plan.begin, windows.size())));
  const bool labels = synthesizer.options.method == Method::coordinates;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    Pass pass;
    pass.window = windows[i].first;
    pass.iterations = plan.factor * iterationsOf(plan.iterations, windows[i].second);
    pass.table = &tableFor(synthesizer, plan.index, pass.window);
    if (!plan.tree) pass.probes = 0, pass.similar = kSimilar;
    pass.startFromLabels = labels;
    pass.copyCores = labels;
    pass.seed = keyOf(synthesizer, plan.frame, plan.index, pass.window);
    record(stats, optimize(level, pass, synthesizer.options, state));
    if (progress) progress(double(i + 1) / double(windows.size()));
  }
}

void joinLabels(const SeamModel& seams, const State& state, float data, const std::vector<std::uint8_t>& free,
                const Labels* alternative, std::uint64_t seed, Labels& labels) {
  const LabelTerms terms{kStretchCost, data, &state.average, kUsageCost};
  straightenSeams(seams, terms, free, alternative, kSeamSweeps, labels);
  expandLabels(seams, terms, free, seed, labels);
}

}  // namespace fluidtex::texture
