// Search for the exemplar window nearest to a neighbourhood [Kwatra07 sec. V-B]: a principal component basis,
// a tree of the exemplar's windows by hierarchical clustering, and lists of windows that look alike [Tong02,
// k-coherence].
//
// One SearchTable serves one level of the exemplar and one window width. It is read-only once built: any
// number of threads may search it, each with a WindowQuery of its own, whose memory is used again and again.
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

// Weight of a window's pixel at (x, y) from the centre, in pixels: a Gaussian of standard deviation window /
// 3, 1 at the centre. Search and energy share it.
float windowFalloff(int window, float x, float y);

struct Match {
  Vec2i center{0, 0};  // column, row of the window's middle pixel
  // Mean squared difference under the fall-off: sum g m |a - b|^2 / sum g m over the window's pixels, g the
  // fall-off, m the query's mask; |.|^2 sums over all channels.
  float distance = std::numeric_limits<float>::max();
};

struct SearchTable {
  int window = 0;  // odd
  int channels = 0;
  bool toroidal = false;
  int width = 0, height = 0;  // of the image
  int margin = 0;             // window / 2 where toroidal, else 0
  // The image, continued on every side by `margin` pixels; eight more floats follow its last. Only
  // windowDistance() and nearestWindow() read it: without them it may be emptied, as it is as large as the
  // tree.
  Image padded;
  std::vector<float> falloff;  // window^2, row-major, sums to 1
  WindowBasis basis;
  WindowTree tree;
  int stride = 1;              // the tree holds every stride-th centre in both directions
  int similarCount = 0;        // k
  std::vector<Vec2i> similar;  // k a tree centre, in row-major order of the centres; empty without lists

  // Centres run from minCenter to maxCenter, both included: those whose window lies inside; all pixels where
  // toroidal.
  Vec2i minCenter() const;
  Vec2i maxCenter() const;
};

// Builds the table of one level. `window` must be odd and fit (see fittingWindow). `similar` > 0 adds the
// k-coherence lists, each of `similar` windows at least window / 2 pixels from their own centre and from each
// other. Same input, same table, on any number of threads. Throws std::invalid_argument if window is even or
// does not fit.
SearchTable buildSearchTable(const Image& match, bool toroidal, int window, std::uint64_t seed,
                             int similar = 0);

// A neighbourhood to search for, and the working memory of searching: one a thread.
struct WindowQuery {
  explicit WindowQuery(const SearchTable& table);

  // To be filled in by the caller; row-major, rows downwards, channels interleaved: window^2 x channels.
  std::vector<float> pixels;
  // Window^2: 0 = the pixel is missing (what stands in `pixels` is ignored), 1 = full weight. Starts as all
  // ones.
  std::vector<float> mask;

  // Made by prepareQuery(). Rows are filled up to a multiple of eight floats, with weight 0.
  std::vector<float> rows;    // the pixels, 0 where missing
  std::vector<float> weight;  // fall-off times mask over its sum, once a channel
  bool anyMissing = false;
  bool fullWeight = false;  // `weight` is that of a mask of ones

  // Made by describeQuery().
  bool described = false;
  std::vector<float> descriptor;  // kDescriptorSize
  std::vector<float> filled;      // the pixels with the missing ones filled
  TreeSearch search;
};

// To be called after pixels or mask have changed and before the functions below.
void prepareQuery(const SearchTable& table, WindowQuery& query);

// The nearest valid centre: wrapped where toroidal, else clamped.
Vec2i validCenter(const SearchTable& table, Vec2i center);

// The distance (see Match) of the query to the exemplar window at a valid centre. Above `bound` it stops
// early and returns some value above bound.
float windowDistance(const SearchTable& table, const WindowQuery& query, Vec2i center,
                     float bound = std::numeric_limits<float>::max());

// The query's descriptor. Missing pixels are filled with the weighted mean of the others, then once with what
// the basis makes of that.
std::span<const float> describeQuery(const SearchTable& table, WindowQuery& query);

// The `best.size()` windows nearest by descriptor among the `probes` leaves whose means are nearest to the
// query, ascending; Match::distance is the distance of the descriptors, a lower bound of the windows' (where
// no pixel is missing). Returns how many were found. Ties go to the smaller row, then column.
int searchTree(const SearchTable& table, WindowQuery& query, int probes, std::span<Match> best);

// Writes the k windows that look like the one at `center` (any valid centre), the most similar first, and
// returns how many: the smaller of k and out.size(). Where stride > 1 they are those of the nearest centre of
// the tree, moved along.
int similarWindows(const SearchTable& table, Vec2i center, std::span<Vec2i> out);

// The nearest of the candidates and, with probes > 0, of the tree's best `keep` windows and the neighbours of
// the best of all, compared by windowDistance. Candidates are made valid first. Never farther than the first
// candidate; a tie goes to the earlier one. With neither candidates nor probes: the first valid centre at the
// largest distance.
Match nearestWindow(const SearchTable& table, WindowQuery& query, std::span<const Vec2i> candidates,
                    int probes, int keep = 16);

}  // namespace fluidtex::texture
