// The search of windows by another program: FAISS, on the same windows reduced to their principal components.
#pragma once

#include "texture/search/pca.h"

#include <string>
#include <vector>

namespace fluidtex::benchmarks {

struct SearchProblem {
  std::vector<float> windows, queries;  // #n and #m x texture::kDescriptorSize
  int count = 8;                        // how many are looked for
  std::size_t size() const { return queries.size() / texture::kDescriptorSize; }
};

// What one setting does: processor seconds a query, and the mean over the queries of the squared distance of
// the nearest window found, and of all that were found.
struct SearchRun {
  std::string setting;
  double seconds = 0.0, nearest = 0.0, all = 0.0;
};

enum class PeerIndex { flat, ivf, hnsw };

// The index by rising effort, until its nearest windows are in the mean as near as `nearest`, or as near as
// it can. All queries at once, on one thread. Nothing where libfaiss is not there.
std::vector<SearchRun> searchFaiss(const SearchProblem& problem, PeerIndex index, double nearest);

}  // namespace fluidtex::benchmarks
