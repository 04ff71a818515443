// The search for windows alone: the tree that synthesis uses, beside FAISS on the same windows reduced to the
// same principal components. Asked for are the windows of a sphere's texture as they stand after the first
// average. Distances are those of the reduced windows, squared. Processor time of one thread.
#include "tools/benchmarks/peers/window_search.h"
#include "texture/optimize/matches.h"
#include "texture/optimize/passes.h"
#include "tools/benchmarks/measure.h"
#include "tools/benchmarks/textured_samples.h"

#include <tbb/global_control.h>

#include <cmath>
#include <map>
#include <memory>

namespace fluidtex::benchmarks {
namespace {

constexpr int kPoints = 100000, kRounds = 5;
constexpr float kBlock = 64.0f;   // texels: what the texture starts from, as on a first frame
constexpr double kAsNear = 1.01;  // a peer whose mean distance is at most so many times ours is as good

struct Problem {
  texture::SearchTable table;
  SearchProblem search;
  SearchRun ours;
};

// The reduced windows that a table holds.
std::vector<float> windowsOf(const texture::SearchTable& table) {
  const texture::Vec2i centers = (table.maxCenter() - table.minCenter()) / table.stride;
  return texture::describeAll(table.basis, table.padded, table.window, table.stride, centers[0] + 1,
                              centers[1] + 1);
}

std::vector<float> queriesOf(const texture::Synthesizer& made, const texture::SearchTable& table) {
  const texture::Surface surface = sphere(kPoints, 1);
  const texture::PreparedMesh prepared(surface.levels.front());
  const texture::TexelImage& image = made.tables->image.front();
  texture::State state;
  state.labels = texture::blockLabels(prepared.view(), image, kBlock, 1);
  state.value = texture::lookUp(image, state.labels);
  const texture::Level level{prepared.view(), image, made.tables->histogram.front(), {}, {}};
  texture::Pass pass;
  pass.window = table.window;
  pass.table = &table;
  texture::optimize(level, pass, made.options, state);

  const texture::Windows windows = texture::makeWindows(level, pass);
  texture::WindowQuery query(table);
  std::vector<float> queries;
  for (std::size_t p = 0; p < windows.match.size(); ++p) {
    texture::fillQuery(windows, p, state.average, query, image.channels);
    texture::prepareQuery(table, query);
    const auto descriptor = texture::describeQuery(table, query);
    queries.insert(queries.end(), descriptor.begin(), descriptor.end());
  }
  return queries;
}

SearchRun searchOurs(const texture::WindowTree& tree, const SearchProblem& problem, int probes) {
  SearchRun run{std::to_string(probes) + " of " + std::to_string(tree.leaves()) + " leaves", 0.0, 0.0, 0.0};
  const std::size_t queries = problem.size(), count = std::size_t(problem.count);
  texture::TreeSearch search;
  std::vector<double> seconds;
  std::vector<std::uint32_t> found(queries * count);
  for (int round = 0; round < kRounds; ++round) {
    const double from = processorSeconds();
    for (std::size_t q = 0; q < queries; ++q) {
      texture::searchWindowTree(tree, problem.queries.data() + q * texture::kDescriptorSize, probes,
                                problem.count, search);
      for (std::size_t k = 0; k < count; ++k) found[q * count + k] = search.best.at(k).index;
    }
    seconds.push_back((processorSeconds() - from) / double(queries));
  }
  run.seconds = median(seconds);
  // What the codes say is rounded; the true distances are compared.
  for (std::size_t i = 0; i < found.size(); ++i) {
    double distance = 0.0;
    for (std::size_t k = 0; k < texture::kDescriptorSize; ++k)
      distance += std::pow(problem.windows[found[i] * std::size_t(texture::kDescriptorSize) + k] -
                               problem.queries[i / count * texture::kDescriptorSize + k],
                           2.0);
    if (i % count == 0) run.nearest += distance / double(queries);
    run.all += distance / double(found.size());
  }
  return run;
}

// Made once for a row and its peers.
const Problem& problemOf(int size, int window) {
  static std::map<std::pair<int, int>, std::unique_ptr<Problem>> made;
  std::unique_ptr<Problem>& problem = made[{size, window}];
  if (problem) return *problem;
  problem = std::make_unique<Problem>();
  const texture::SynthesisOptions options;
  const texture::Synthesizer synthesizer =
      texture::makeSynthesizer(texture::makeExemplar(scales(size), true, options, 1), options);
  problem->table = texture::buildSearchTable(synthesizer.exemplar.match.front(), true, window, options.seed);
  problem->search.windows = windowsOf(problem->table);
  problem->search.queries = queriesOf(synthesizer, problem->table);
  problem->ours = searchOurs(problem->table.tree, problem->search, texture::Pass{}.probes);
  return *problem;
}

void report(benchmark::State& state, const std::string& row, const SearchProblem& problem,
            const SearchRun& run) {
  state.SetIterationTime(run.seconds);
  state.SetLabel(run.setting);
  state.counters["query_ns"] = 1e9 * run.seconds;
  state.counters["mean_nearest"] = run.nearest;
  state.counters["mean_all"] = run.all;
  const std::size_t windows = problem.windows.size() / texture::kDescriptorSize;
  state.counters["windows"] = double(windows);
  state.counters["queries"] = double(problem.size());
  keep(row, "s / query", run.seconds);
}

void ours(benchmark::State& state, const std::string& row, int size, int window) {
  const Problem& problem = problemOf(size, window);
  for ([[maybe_unused]] auto _ : state) report(state, row, problem.search, problem.ours);
}

// Of the settings that find windows as near as ours the quickest; where none does, the one that comes
// nearest.
void peer(benchmark::State& state, const std::string& row, int size, int window, PeerIndex index) {
  const Problem& problem = problemOf(size, window);
  const double nearest = kAsNear * problem.ours.nearest;
  const std::vector<SearchRun> runs = searchFaiss(problem.search, index, nearest);
  if (runs.empty()) {
    state.SkipWithError(
        "FAISS was not there when the benchmarks were built: apt-get install libfaiss-dev, "
        "and build anew");
    return;
  }
  const SearchRun* best = &runs.front();
  for (const SearchRun& run : runs) {
    const bool near = run.nearest <= nearest, bestNear = best->nearest <= nearest;
    if (near != bestNear ? near : near ? run.seconds < best->seconds : run.nearest < best->nearest)
      best = &run;
  }
  for ([[maybe_unused]] auto _ : state) report(state, row, problem.search, *best);
}

}  // namespace

void registerWindowSearch() {
  const auto add = [](const std::string& name, const auto& run) {
    addRow(name, run, benchmark::kMicrosecond);
  };
  for (const int size : {256, 1024})
    for (const int window : {9, 33}) {
      const std::string row = "synthesis_search/" + std::to_string(size) + "/" + std::to_string(window);
      add(row, [=](benchmark::State& s) { ours(s, row, size, window); });
      for (const auto& [name, index] : {std::pair<const char*, PeerIndex>{"faiss_flat", PeerIndex::flat},
                                        {"faiss_ivf", PeerIndex::ivf},
                                        {"faiss_hnsw", PeerIndex::hnsw}}) {
        const std::string peerRow = row + "/peer:" + name;
        add(peerRow, [=, index = index](benchmark::State& s) { peer(s, peerRow, size, window, index); });
      }
    }
}

}  // namespace fluidtex::benchmarks
