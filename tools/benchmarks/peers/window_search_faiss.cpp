#include "tools/benchmarks/peers/window_search.h"

#ifdef FLUIDTEX_FAISS

#include "tools/benchmarks/measure.h"

#include <faiss/IndexFlat.h>
#include <faiss/IndexHNSW.h>
#include <faiss/IndexIVFFlat.h>
#include <faiss/utils/distances.h>
#include <omp.h>

namespace fluidtex::benchmarks {
namespace {

constexpr int kRounds = 3;

SearchRun measured(const faiss::Index& index, const SearchProblem& problem, std::string setting) {
  const std::size_t queries = problem.size(), count = std::size_t(problem.count);
  std::vector<float> distance(queries * count);
  std::vector<faiss::Index::idx_t> found(queries * count);
  SearchRun run{std::move(setting), 0.0, 0.0, 0.0};
  // Many queries are compared by a product of matrices, which depends on the BLAS that is installed; the
  // quicker way counts.
  for (const int threshold : {20, 1 << 30}) {
    faiss::distance_compute_blas_threshold = threshold;
    std::vector<double> seconds;
    for (int round = 0; round < kRounds; ++round) {
      const double from = processorSeconds();
      index.search(faiss::Index::idx_t(queries), problem.queries.data(), problem.count, distance.data(),
                   found.data());
      seconds.push_back((processorSeconds() - from) / double(queries));
    }
    const double took = median(seconds);
    if (run.seconds == 0.0 || took < run.seconds) run.seconds = took;
  }
  for (std::size_t q = 0; q < queries; ++q) {
    run.nearest += distance[q * count] / double(queries);
    for (std::size_t k = 0; k < count; ++k) run.all += distance[q * count + k] / double(queries * count);
  }
  return run;
}

// Doubles the effort, from `first` to `most`, until the nearest windows are near enough; apply(effort) sets
// it.
template <typename Apply>
void sweep(const faiss::Index& index, const SearchProblem& problem, double nearest, const std::string& name,
           int first, int most, const Apply& apply, std::vector<SearchRun>& runs) {
  for (int effort = first; effort <= most; effort *= 2) {
    apply(effort);
    runs.push_back(measured(index, problem, name + std::to_string(effort)));
    if (runs.back().nearest <= nearest) return;
  }
}

}  // namespace

std::vector<SearchRun> searchFaiss(const SearchProblem& problem, PeerIndex kind, double nearest) {
  omp_set_num_threads(1);
  constexpr int kSize = texture::kDescriptorSize;
  const auto windows = faiss::Index::idx_t(problem.windows.size() / kSize);
  if (kind == PeerIndex::flat) {
    faiss::IndexFlatL2 index(kSize);
    index.add(windows, problem.windows.data());
    return {measured(index, problem, "all")};
  }
  std::vector<SearchRun> runs;
  if (kind == PeerIndex::ivf)
    for (const int lists : {256, 1024}) {
      faiss::IndexFlatL2 means(kSize);
      faiss::IndexIVFFlat index(&means, kSize, std::size_t(lists));
      index.train(windows, problem.windows.data());
      index.add(windows, problem.windows.data());
      sweep(
          index, problem, nearest, std::to_string(lists) + " lists, nprobe ", 1, 64,
          [&](int effort) { index.nprobe = std::size_t(effort); }, runs);
    }
  else
    for (const int links : {16, 32}) {
      faiss::IndexHNSWFlat index(kSize, links);
      index.add(windows, problem.windows.data());
      sweep(
          index, problem, nearest, "M " + std::to_string(links) + ", efSearch ", problem.count, 512,
          [&](int effort) { index.hnsw.efSearch = effort; }, runs);
    }
  return runs;
}

}  // namespace fluidtex::benchmarks

#else

namespace fluidtex::benchmarks {

std::vector<SearchRun> searchFaiss(const SearchProblem&, PeerIndex, double) {
  return {};
}

}  // namespace fluidtex::benchmarks

#endif
