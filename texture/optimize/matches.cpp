// Candidates: propagation and random [Ashikhmin01], k-coherence [Tong02], tree search [Kwatra05].
#include "texture/optimize/matches.h"

#include "numerics/random.h"
#include "texture/labels/usage.h"
#include "texture/loops/complex.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace fluidtex::texture {
namespace {

constexpr int kMaxLinks = 8;
constexpr int kMaxSimilar = 4;
constexpr int kTreeCandidates = 8;  // nearest by descriptor, compared in full
constexpr int kRandomCandidates = 2;
// Windows are improved in batches, so that later ones see the matches and the usage of earlier ones.
constexpr std::uint64_t kBatches = 8;
constexpr float kFar = std::numeric_limits<float>::max();

// A neighbourhood's values, gathered once for all candidates.
struct Gathered {
  Values value;
  std::array<std::span<const Vec2f>, kMostWays> offset;  // by symmetry variant
  std::array<std::vector<Vec2f>, kMostWays> turned;      // storage of the variants but upright
  std::span<const float> falloff;
  float mass = 0.0f;
};

// Centre and symmetry variant of a match.
struct Place {
  Vec2f center;
  Way way = 0;
};

void gather(const Windows& windows, std::size_t p, const Values& value, Gathered& result) {
  const Neighborhoods& n = windows.neighborhoods;
  const std::size_t begin = n.first[p], count = n.first[p + 1] - begin;
  result.value.resize(count);
  for (std::size_t i = 0; i < count; ++i) result.value[i] = value[n.vertex[begin + i]];
  result.offset[0] = {n.offset.data() + begin, count};
  for (int i = 1; i < countOf(windows.ways); ++i) {
    const Way way = wayAt(windows.ways, i);
    std::vector<Vec2f>& turned = result.turned[way];
    turned.resize(count);
    for (std::size_t k = 0; k < count; ++k) turned[k] = laid(way, n.offset[begin + k]);
    result.offset[way] = turned;
  }
  result.falloff = {windows.falloff.data() + begin, count};
  result.mass = windows.mass[p];
}

// D_p / m_p of a match. Early termination: some value above `bound` once the sum passes it.
float distanceAt(const TexelImage& image, const Gathered& gathered, const Place& match, float bound = kFar) {
  constexpr std::size_t kBlockSize = 24;  // entries per check of the bound; the heaviest come first
  const float limit = bound < kFar ? bound * gathered.mass : kFar;
  const std::span<const Vec2f> offset = gathered.offset[match.way];
  const std::size_t count = gathered.value.size();
  float total = 0.0f;
  for (std::size_t begin = 0; begin < count; begin += kBlockSize) {
    Float8 sum{};
    const std::size_t end = std::min(count, begin + kBlockSize);
    for (std::size_t i = begin; i < end; ++i) {
      const Float8 texel = image.sampleInside(match.center[0] + offset[i][0], match.center[1] + offset[i][1]);
      const Float8 d = gathered.value[i] - texel;
      sum += gathered.falloff[i] * d * d;
    }
    total += sum8(sum);
    if (total > limit) break;
  }
  return total / gathered.mass;
}

// Per-thread workspace.
struct Searcher {
  explicit Searcher(const SearchTable* table) {
    if (table) query.emplace_back(*table);
  }
  std::vector<WindowQuery> query;  // one, or none without a table
  Gathered gathered;
};

// The tree's best windows for neighbourhood p in one symmetry variant.
int searchWindows(const Windows& windows, std::size_t p, const Pass& pass, const Values& value, int channels,
                  Way way, WindowQuery& query, std::span<Match> found) {
  fillQuery(windows, p, value, query, channels, way);
  prepareQuery(*pass.table, query);
  return searchTree(*pass.table, query, pass.probes, found);
}

}  // namespace

void fillQuery(const Windows& windows, std::size_t p, const Values& value, WindowQuery& query, int channels,
               Way way) {
  const std::size_t area = query.mask.size();
  const int width = windows.neighborhoods.window, middle = width / 2;
  const PixelSource* pixels = windows.pixels.data() + p * area;
  for (std::size_t k = 0; k < area; ++k) {
    const PixelSource& pixel = pixels[k];
    const int row = int(k) / width, column = int(k) % width;
    const Vec2f at = laid(way, Vec2f(float(column - middle), float(row - middle)));
    const auto i = std::size_t((int(at[1]) + middle) * width + int(at[0]) + middle);
    query.mask[i] = pixel.missing() ? 0.0f : 1.0f;
    const Float8 sum = pixel.weight[0] * value[pixel.vertex[0]] + pixel.weight[1] * value[pixel.vertex[1]] +
                       pixel.weight[2] * value[pixel.vertex[2]];
    for (int c = 0; c < channels; ++c) query.pixels[i * std::size_t(channels) + std::size_t(c)] = sum[c];
  }
}

Windows makeWindows(const Level& level, const Pass& pass) {
  Windows windows;
  windows.ways = level.image.ways;
  windows.neighborhoods = coverSurface(level.view, pass.window, level.wanted,
                                       pass.table && pass.probes > 0 ? &windows.pixels : nullptr);
  const Neighborhoods& n = windows.neighborhoods;
  windows.links = linkWindows(n, level.view.mesh.positions.size(), kMaxLinks);
  windows.falloff.resize(n.vertex.size());
  windows.mass.resize(n.size());
  windows.match.resize(n.size());
  windows.way.assign(n.size(), 0);
  windows.distance.assign(n.size(), 0.0f);
  windows.demand = demandOn(level.image, level.view.mesh);
  tbb::parallel_for(std::size_t(0), n.size(), [&](std::size_t p) {
    float mass = 0.0f;
    for (std::uint32_t i = n.first[p]; i < n.first[p + 1]; ++i)
      mass += windows.falloff[i] = windowFalloff(n.window, n.offset[i][0], n.offset[i][1]);
    windows.mass[p] = mass;
  });
  return windows;
}

void measureMatches(const TexelImage& image, const Values& value, Windows& windows) {
  tbb::enumerable_thread_specific<Gathered> workspace;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, windows.match.size(), 16),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      Gathered& gathered = workspace.local();
                      for (std::size_t p = range.begin(); p != range.end(); ++p) {
                        gather(windows, p, value, gathered);
                        windows.distance[p] = distanceAt(image, gathered, {windows.match[p], windows.way[p]});
                      }
                    });
}

void findFirstMatches(const Level& level, const Pass& pass, const Values& value, Windows& windows) {
  tbb::enumerable_thread_specific<Searcher> workspace([&] { return Searcher(pass.table); });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, windows.match.size(), 16),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      Searcher& searcher = workspace.local();
                      for (std::size_t p = range.begin(); p != range.end(); ++p) {
                        float least = kFar;
                        for (int i = 0; i < countOf(windows.ways); ++i) {
                          const Way way = wayAt(windows.ways, i);
                          Match found[1];
                          searchWindows(windows, p, pass, value, level.image.channels, way,
                                        searcher.query.front(), found);
                          if (i > 0 && !(found[0].distance < least)) continue;
                          least = found[0].distance;
                          windows.match[p] = Vec2f(found[0].center);
                          windows.way[p] = way;
                        }
                      }
                    });
  measureMatches(level.image, value, windows);
}

namespace {

// The best of the places that are tried for one window.
class Candidates {
 public:
  // gathered: of the window. used: counted with weight `usage`. now: its present match, at distance
  // `present`.
  Candidates(const TexelImage& image, const Gathered& gathered, const Usage& used, float usage, float reach,
             const Place& now, float present)
      : nearest(now),
        best(now),
        bestDistance(present),
        m_image(image),
        m_gathered(gathered),
        m_used(used),
        m_usage(usage),
        m_reach(reach),
        m_now(now),
        m_present(present),
        m_nearestDistance(present) {}

  void offer(const Vec2f& texel, Way way) {
    const Place candidate{m_image.centerFor(texel, m_reach), way};
    const auto same = [&](const Place& other) {
      constexpr float kSame = 0.02f;  // texels, squared distance
      return way == other.way && (candidate.center - other.center).lengthSqr() < kSame;
    };
    if (same(m_now) || std::any_of(m_tried.begin(), m_tried.begin() + m_triedCount, same)) return;
    if (m_triedCount < m_tried.size()) m_tried[m_triedCount++] = candidate;
    const float penalty =
        m_usage > 0.0f ? 1.0f + m_usage * std::max(0.0f, m_used.at(candidate.center) - 1.0f) : 1.0f;
    const float bound = std::min(m_present, m_bestScore / penalty);
    const float distance = distanceAt(m_image, m_gathered, candidate, bound);
    if (distance < m_nearestDistance) m_nearestDistance = distance, nearest = candidate;
    if (distance < m_present && distance * penalty < m_bestScore)
      m_bestScore = distance * penalty, bestDistance = distance, best = candidate;
  }

  Place nearest;  // of least distance
  Place best;     // of least distance times penalty of usage, nearer than the present one; else that
  float bestDistance;

 private:
  const TexelImage& m_image;
  const Gathered& m_gathered;
  const Usage& m_used;
  float m_usage, m_reach;
  Place m_now;
  float m_present, m_nearestDistance, m_bestScore = kFar;
  std::array<Place, kMaxLinks + kMaxSimilar + kTreeCandidates + kRandomCandidates> m_tried;
  std::size_t m_triedCount = 0;
};

// Propagation: where the matches of overlapping windows would continue.
void offerContinued(const Windows& windows, std::size_t p, Candidates& candidates) {
  const Neighborhoods& n = windows.neighborhoods;
  const bool oneWay = countOf(windows.ways) == 1;
  for (std::uint32_t i = windows.links.first[p]; i < windows.links.first[p + 1]; ++i) {
    const std::uint32_t entry = windows.links.entry[i];
    const Complexf offset(n.offset[entry][0], n.offset[entry][1]);
    // From p to the neighbour, in the neighbour's axes.
    const Complexf towards = conjugateProduct(n.turn[entry], offset);
    const std::uint32_t q = windows.links.window[i];
    candidates.offer(
        windows.texelAt(q, Vec2f(-towards.real(), -towards.imag())),
        oneWay ? Way(0)
               : nearestWay(windows.ways, seenFrom(layOf(windows.way[q]), std::conj(n.turn[entry]))));
  }
}

// As many candidates per variant as an exemplar with one variant gets.
void offerFromTree(const Windows& windows, std::size_t p, const Pass& pass, const Values& value, int channels,
                   WindowQuery& query, Candidates& candidates) {
  Match found[kTreeCandidates];
  for (int w = 0; w < countOf(windows.ways); ++w) {
    const Way way = wayAt(windows.ways, w);
    const int count = searchWindows(windows, p, pass, value, channels, way, query, found);
    for (int i = 0; i < count; ++i) candidates.offer(Vec2f(found[i].center), way);
  }
}

// k-coherence: windows of the exemplar that are like the nearest one so far.
void offerSimilar(const SearchTable& table, int similarCount, Candidates& candidates) {
  Vec2i similar[kMaxSimilar];
  const auto [nearest, way] = candidates.nearest;
  const Vec2i center(int(std::lround(nearest[0])), int(std::lround(nearest[1])));
  const Vec2f shift = nearest - Vec2f(center);
  const int count =
      similarWindows(table, validCenter(table, center), std::span(similar, std::size_t(similarCount)));
  for (int i = 0; i < count; ++i) candidates.offer(Vec2f(similar[i]) + shift, way);
}

// One place anywhere, one near the nearest so far.
void offerRandom(const TexelImage& image, const Ways& ways, float near, std::uint64_t key,
                 Candidates& candidates) {
  const auto random = [&](std::uint64_t i) { return float(randomUnit(key, i)); };
  candidates.offer(Vec2f(random(0) * float(image.width), random(1) * float(image.height)),
                   wayAt(ways, int(randomBelow(key, 4, std::uint64_t(countOf(ways))))));
  const auto [nearest, way] = candidates.nearest;
  candidates.offer(nearest + Vec2f((2.0f * random(2) - 1.0f) * near, (2.0f * random(3) - 1.0f) * near), way);
}

// Takes over the batch's new matches, and counts their use.
void settleBatch(const std::vector<std::uint32_t>& batch, const std::vector<Place>& next, bool counts,
                 Usage& used, Windows& windows) {
  for (std::size_t b = 0; b < batch.size(); ++b) {
    Vec2f& match = windows.match[batch[b]];
    const Vec2f& center = next[b].center;
    if (counts && center != match) used.add(match, -1.0f), used.add(center, 1.0f);
    match = center;
    windows.way[batch[b]] = next[b].way;
  }
}

}  // namespace

void improveMatches(const Level& level, const Pass& pass, int iteration, double usage, const Values& value,
                    Windows& windows) {
  const Neighborhoods& n = windows.neighborhoods;
  const TexelImage& image = level.image;
  const bool useTree = pass.table && pass.probes > 0;
  const int similarCount = pass.table ? std::min({pass.similar, pass.table->similarCount, kMaxSimilar}) : 0;
  const std::uint64_t key = randomBits(pass.seed, std::uint64_t(iteration));
  const float reach = 0.5f * float(n.window - 1), near = 0.25f * float(n.window);

  std::vector<std::vector<std::uint32_t>> batches(kBatches);
  for (std::uint32_t p = 0; p < n.size(); ++p) batches[randomBits(key, p) % kBatches].push_back(p);

  Usage used(image, std::max(8, n.window), n.size(), windows.demand);
  if (usage > 0.0)
    for (const Vec2f& match : windows.match) used.add(match, 1.0f);

  tbb::enumerable_thread_specific<Searcher> workspace(
      [&] { return Searcher(useTree ? pass.table : nullptr); });
  std::vector<Place> next;
  for (const std::vector<std::uint32_t>& batch : batches) {
    next.resize(batch.size());
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, batch.size(), 16),
        [&](const tbb::blocked_range<std::size_t>& range) {
          Searcher& searcher = workspace.local();
          for (std::size_t b = range.begin(); b != range.end(); ++b) {
            const std::size_t p = batch[b];
            gather(windows, p, value, searcher.gathered);
            Candidates candidates(image, searcher.gathered, used, float(usage), reach,
                                  {windows.match[p], windows.way[p]}, windows.distance[p]);
            offerContinued(windows, p, candidates);
            if (useTree)
              offerFromTree(windows, p, pass, value, image.channels, searcher.query.front(), candidates);
            if (similarCount > 0) offerSimilar(*pass.table, similarCount, candidates);
            offerRandom(image, windows.ways, near, randomBits(key, kBatches + p), candidates);
            next[b] = candidates.best;
            windows.distance[p] = candidates.bestDistance;  // read by no other window in this batch
          }
        });
    settleBatch(batch, next, usage > 0.0, used, windows);
  }
}

}  // namespace fluidtex::texture
