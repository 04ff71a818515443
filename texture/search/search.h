// Search for the exemplar window nearest to a neighbourhood [Kwatra07 sec. V-B]: principal components, a tree
// of windows by hierarchical clustering, and lists of similar windows (k-coherence [Tong02]).
//
// One SearchTable serves one level of the exemplar and one window width. It is read-only once built; threads
// may search it at the same time, each with its own WindowQuery.
#pragma once

#include "texture/exemplar/image.h"
#include "texture/search/pca.h"
#include "texture/search/window_tree.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace fluidtex::texture {

using openvdb::Vec2i;

// Gaussian fall-off: weight of a window's pixel at (x, y) from the centre, in pixels. Standard deviation
// window / 3, 1 at the centre. Used by the search and by the energy.
float windowFalloff(int window, float x, float y);

struct Match {
  Vec2i center{0, 0};  // column, row of the window's middle pixel
  // Mean squared difference under the fall-off: sum g m |a - b|^2 / sum g m over the window's pixels, with g
  // the fall-off, m the query's mask, and |.|^2 summed over channels.
  float distance = std::numeric_limits<float>::max();
};

struct SearchTable {
  int window = 0;  // odd
  int channels = 0;
  bool toroidal = false;
  int width = 0, height = 0;  // of the image
  int margin = 0;             // window / 2 where toroidal, else 0
  // The image, padded on every side by `margin` pixels, with eight more floats at the end. Read by
  // windowDistance() and nearestWindow() only; it may be emptied otherwise, as it is as large as the tree.
  Image padded;
  std::vector<float> falloff;  // window^2, row-major, sums to 1
  WindowBasis basis;
  WindowTree tree;
  int stride = 1;              // the tree holds every stride-th centre in both directions
  int similarCount = 0;        // k
  std::vector<Vec2i> similar;  // k per tree centre, centres in row-major order; empty without lists

  // Range of valid centres, inclusive: those whose window lies inside; all pixels where toroidal.
  Vec2i minCenter() const;
  Vec2i maxCenter() const;
};

// Builds the table of one level.
// similar > 0: adds k-coherence lists of that many windows, which lie at least window / 2 pixels from their
// own centre and from each other.
// The result depends on the arguments only, not on the number of threads.
// Throws std::invalid_argument if window is even or does not fit (fittingWindow).
SearchTable buildSearchTable(const Image& match, bool toroidal, int window, std::uint64_t seed,
                             int similar = 0);

// A neighbourhood to search for, with the workspace of the search; one per thread.
struct WindowQuery {
  explicit WindowQuery(const SearchTable& table);

  // window^2 x channels, filled in by the caller: row-major, rows downwards, channels interleaved.
  std::vector<float> pixels;
  // window^2: 0 missing (its value is ignored) to 1 full weight; initially 1.
  std::vector<float> mask;

  // Set by prepareQuery(). Rows are padded to a multiple of eight floats, with weight 0.
  std::vector<float> rows;    // the pixels, 0 where missing
  std::vector<float> weight;  // fall-off times mask over its sum, per channel
  bool anyMissing = false;    // some of the mask is not 1
  bool fullWeight = false;    // `weight` is that of a mask of ones, and need not be computed again

  // Set by describeQuery().
  bool described = false;
  std::vector<float> descriptor;  // kDescriptorSize
  std::vector<float> filled;      // the pixels, missing ones filled
  TreeSearch search;
};

// Required after pixels or mask have changed, before the functions below.
void prepareQuery(const SearchTable& table, WindowQuery& query);

// The nearest valid centre: wrapped where toroidal, else clamped.
Vec2i validCenter(const SearchTable& table, Vec2i center);

// Distance (see Match) of the query to the exemplar window at a valid centre. Early termination: some value
// above `bound` once the sum passes it.
float windowDistance(const SearchTable& table, const WindowQuery& query, Vec2i center,
                     float bound = std::numeric_limits<float>::max());

// The query's descriptor. Missing pixels are filled with the weighted mean of the others, then once more from
// the reconstruction by the basis.
std::span<const float> describeQuery(const SearchTable& table, WindowQuery& query);

// Finds the best.size() windows nearest by descriptor in the `probes` leaves whose means are nearest to the
// query, in ascending order. Match::distance is that of the descriptors, a lower bound of the windows' where
// no pixel is missing. Returns how many were found. Ties: smaller row, then column.
int searchTree(const SearchTable& table, WindowQuery& query, int probes, std::span<Match> best);

// Writes the k windows most similar to the one at `center` (any valid centre), best first; returns their
// number, min(k, out.size()). Where stride > 1 they are those of the nearest tree centre, shifted.
int similarWindows(const SearchTable& table, Vec2i center, std::span<Vec2i> out);

// The nearest window by windowDistance() among the candidates and, with probes > 0, the tree's best `keep`
// windows and the neighbours of the best of all. Candidates are made valid first. The result is never farther
// than the first candidate; ties go to the earlier one. With neither candidates nor probes: the first valid
// centre at the largest distance.
Match nearestWindow(const SearchTable& table, WindowQuery& query, std::span<const Vec2i> candidates,
                    int probes, int keep = 16);

}  // namespace fluidtex::texture
