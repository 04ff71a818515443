// The passes of a frame: which levels, windows and starts, and what is made of the result.
#include "texture/synthesize.h"

#include "texture/fresh.h"
#include "texture/optimize.h"
#include "texture/parallel.h"
#include "texture/random.h"
#include "texture/renewal.h"
#include "texture/srgb.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

namespace fluidtex::texture {

struct SearchTables {
  // By level.
  std::vector<TexelImage> image;
  std::vector<HistogramTarget> histogram;
  std::vector<float> seamUnit;
  // By level and window.
  std::map<std::pair<int, int>, SearchTable> table;
};

namespace {

// Side of the blocks that a first frame starts from, texels of the full exemplar.
constexpr float kBlockSize = 64.0f;
// Coarser levels decide the layout and are cheap: they iterate longer.
constexpr int kCoarseIterations = 3;
// Around what is worth renewing, this many rings may change with it, so that seams find a place.
constexpr int kRenewalRim = 3;
// How near straightened seams stay to the last average, on the first frame and later.
constexpr float kFirstData = 0.15f, kLaterData = 0.4f;
constexpr float kStretchCost = 1.0f;
constexpr int kSeamSweeps = 8;

// Later frames start near their best: instead of the tree they search windows like the best so far.
constexpr int kSimilar = 4;

using Progress = std::function<void(double)>;

// A level's mesh with graph and connection.
struct PreparedMesh {
  explicit PreparedMesh(const SurfaceMesh& surface)
      : mesh(surface),
        graph(buildVertexGraph(surface)),
        connection(buildConnection(surface, graph, surface.orientation)) {}
  MeshView view() const { return {mesh, graph, connection}; }

  const SurfaceMesh& mesh;
  VertexGraph graph;
  Connection connection;
};

const SearchTable& tableFor(Synthesizer& synthesizer, int level, int window) {
  const auto key = std::make_pair(level, window);
  auto it = synthesizer.tables->table.find(key);
  if (it == synthesizer.tables->table.end()) {
    const bool labels = synthesizer.options.method == Method::coordinates;
    SearchTable table =
        buildSearchTable(synthesizer.exemplar.match[std::size_t(level)], synthesizer.exemplar.toroidal,
                         window, synthesizer.options.seed, level == 0 && labels ? kSimilar : 0);
    table.padded = {};  // distances are taken from the level's TexelImage
    it = synthesizer.tables->table.emplace(key, std::move(table)).first;
  }
  return it->second;
}

// Windows that fit a level's exemplar, without repetition, each with its place in the options.
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

int iterationsOf(const std::vector<int>& iterations, std::size_t i) {
  return iterations.empty() ? 1 : iterations[std::min(i, iterations.size() - 1)];
}

void record(SynthesisStats& stats, const EnergyTrace& trace) {
  if (trace.empty()) return;
  stats.energyStart = trace.front();
  stats.energyEnd = trace.back();
  stats.iterations += int(trace.size()) - 1;
}

// Channels whose seams are seen: all but the gradient's, which is the last.
Float8 seamChannels(const Synthesizer& synthesizer) {
  Float8 weight{};
  const int channels = synthesizer.exemplar.match.front().channels;
  const bool gradient =
      synthesizer.options.gradientWeight > 0.0 && channels > synthesizer.exemplar.colorChannels;
  for (int c = 0; c < channels - (gradient ? 1 : 0); ++c) weight[c] = 1.0f;
  return weight;
}

SeamModel seamModel(const Synthesizer& synthesizer, const MeshView& view, std::size_t level) {
  const SearchTables& tables = *synthesizer.tables;
  return {view, tables.image[level], seamChannels(synthesizer), tables.seamUnit[level]};
}

Float8 encoded(const Vec4f& color, int channels) {
  Float8 value{};
  for (int c = 0; c < 3; ++c) value[c] = encodeSrgb(color[c] * color[3]);
  if (channels > 3) value[3] = color[3];
  return value;
}

Vec4f decoded(const Float8& value, int channels) {
  const float alpha = channels > 3 ? std::clamp(value[3], 0.0f, 1.0f) : 1.0f;
  Vec4f color(0.0f, 0.0f, 0.0f, alpha);
  for (int c = 0; c < 3; ++c) color[c] = alpha > 1e-4f ? std::max(0.0f, decodeSrgb(value[c])) / alpha : 0.0f;
  return color;
}

// The vertices that are searched: all, which is empty, but for those of droplets.
std::vector<std::uint8_t> searched(const Synthesizer& synthesizer, const VertexGraph& graph) {
  const std::vector<int>& windows = synthesizer.options.windows;
  std::vector<std::uint8_t> mask = droplets(graph, *std::min_element(windows.begin(), windows.end()));
  if (!any(mask)) return {};
  for (std::uint8_t& m : mask) m = !m;
  return mask;
}

std::uint64_t keyOf(const Synthesizer& synthesizer, int frame, int level, int window) {
  return randomBits(randomBits(synthesizer.options.seed, std::uint64_t(std::int64_t(frame))),
                    std::uint64_t(level) * 1024u + std::uint64_t(window));
}

// One pass after the other, largest window first.
void runPasses(Synthesizer& synthesizer, const Level& level, int index, int frame,
               const std::vector<int>& iterations, int factor, bool tree, State& state, SynthesisStats& stats,
               const Progress& progress) {
  const auto windows = windowsOf(synthesizer, index);
  const bool labels = synthesizer.options.method == Method::coordinates;
  for (std::size_t i = 0; i < windows.size(); ++i) {
    Pass pass;
    pass.window = windows[i].first;
    pass.iterations = factor * iterationsOf(iterations, windows[i].second);
    pass.table = &tableFor(synthesizer, index, pass.window);
    if (!tree) pass.probes = 0, pass.similar = kSimilar;
    pass.startFromLabels = labels;
    pass.copyCores = labels;
    pass.seed = keyOf(synthesizer, frame, index, pass.window);
    record(stats, optimize(level, pass, synthesizer.options, state));
    if (progress) progress(double(i + 1) / double(windows.size()));
  }
}

// Coarse to fine from random blocks. Leaves the state of level 0.
State synthesizeFirst(Synthesizer& synthesizer, const Surface& surface, int frame, SynthesisStats& stats,
                      const Progress& progress) {
  const SearchTables& tables = *synthesizer.tables;
  int coarsest = int(std::min(surface.levels.size(), tables.image.size())) - 1;
  while (coarsest > 0 && surface.levels[std::size_t(coarsest)].positions.empty()) --coarsest;

  State state;
  double done = 0.0, whole = 0.0;
  for (int l = 0; l <= coarsest; ++l) whole += double(surface.levels[std::size_t(l)].positions.size());
  for (int l = coarsest; l >= 0; --l) {
    const std::size_t index = std::size_t(l);
    const SurfaceMesh& mesh = surface.levels[index];
    const PreparedMesh prepared(mesh);
    const TexelImage& image = tables.image[index];
    const Level level{prepared.view(),
                      image,
                      tables.histogram[index],
                      {},
                      l == 0 ? searched(synthesizer, prepared.graph) : std::vector<std::uint8_t>{}};
    if (l == coarsest)
      state.labels =
          blockLabels(level.view, image, kBlockSize / float(1 << l), keyOf(synthesizer, frame, l, 0));
    else
      state.labels = refineLabels(surface.levels[index + 1], state.labels, mesh, image);
    state.value = state.average = lookUp(image, state.labels);
    const double share = double(mesh.positions.size()) / whole;
    runPasses(synthesizer, level, l, frame, synthesizer.options.firstIterations,
              l > 0 ? kCoarseIterations : 1, true, state, stats, [&](double part) {
                if (progress) progress(done + share * part);
              });
    done += share;
    if (synthesizer.options.method == Method::coordinates)
      straightenSeams(seamModel(synthesizer, level.view, index), {kStretchCost, kFirstData, &state.average},
                      level.wanted, nullptr, kSeamSweeps, state.labels);
  }
  return state;
}

// From carried labels. renewed[v] = 1 where a vertex got a new one.
State synthesizeLater(Synthesizer& synthesizer, const MeshView& view, const Carried& carried, int frame,
                      std::vector<std::uint8_t>& renewed, SynthesisStats& stats, const Progress& progress) {
  const SynthesisOptions& options = synthesizer.options;
  const TexelImage& image = synthesizer.tables->image.front();
  const SeamModel seams = seamModel(synthesizer, view, 0);
  const Labels before = labelsOf(view.mesh, carried.coordinate, carried.gradient);
  renewed.assign(before.size(), 0);

  State state;
  state.labels = before;
  Level level{view, image, synthesizer.tables->histogram.front(), {}, {}};
  level.wanted = grown(
      view.graph, worthRenewing(seams, before, carried.trust, carried.age, options.keepStretch, options.seed),
      kRenewalRim);
  const std::vector<std::uint8_t> large = searched(synthesizer, view.graph);
  for (std::size_t v = 0; v < large.size(); ++v) level.wanted[v] &= large[v];
  if (!any(level.wanted)) return state;

  state.value = state.average = lookUp(image, before);
  level.constraint.value = state.value;
  level.constraint.weight = constraintWeights(view, state.value, carried.trust, options.softConstraint);
  runPasses(synthesizer, level, 0, frame, options.laterIterations, 1, false, state, stats, progress);
  straightenSeams(seams, {kStretchCost, kLaterData, &state.average}, level.wanted, &before, kSeamSweeps,
                  state.labels);
  state.labels = settle(seams, before, state.labels, carried.trust, renewed);
  return state;
}

// The paper's way: colours carried, averaged, held to.
State synthesizeColors(Synthesizer& synthesizer, const MeshView& view, const Carried& carried, int frame,
                       SynthesisStats& stats, const Progress& progress) {
  State state;
  const int channels = synthesizer.exemplar.colorChannels;
  state.value.resize(carried.color.size());
  forEachIndex(state.value.size(),
               [&](std::uint32_t v) { state.value[v] = encoded(carried.color[v], channels); });
  Level level{view, synthesizer.tables->image.front(), synthesizer.tables->histogram.front(), {}, {}};
  level.constraint.value = state.value;
  level.constraint.weight =
      constraintWeights(view, state.value, carried.trust, synthesizer.options.softConstraint);
  runPasses(synthesizer, level, 0, frame, synthesizer.options.laterIterations, 1, true, state, stats,
            progress);
  return state;
}

void checkSizes(const SurfaceMesh& mesh, const Carried& carried) {
  const std::size_t count = mesh.positions.size();
  const auto right = [&](std::size_t size) { return size == count; };
  if (!right(mesh.normals.size()) || !right(mesh.orientation.size()))
    throw std::invalid_argument("synthesize: the surface must be oriented");
  if (carried.empty()) return;
  if (!right(carried.color.size()) || !right(carried.coordinate.size()) || !right(carried.gradient.size()) ||
      !right(carried.age.size()) || !right(carried.trust.size()) || !right(carried.previousPosition.size()))
    throw std::invalid_argument("synthesize: carried arrays must have one entry per vertex");
}

}  // namespace

Synthesizer makeSynthesizer(Exemplar exemplar, const SynthesisOptions& options) {
  Synthesizer synthesizer{std::move(exemplar), options, std::make_shared<SearchTables>()};
  // Carried colours have no feature channels: the paper's method matches by colour alone.
  if (options.method == Method::kwatra07) {
    for (Image& image : synthesizer.exemplar.match) {
      const int channels = synthesizer.exemplar.colorChannels;
      Image reduced{image.width, image.height, channels, {}};
      for (std::size_t i = 0; i < image.data.size(); ++i)
        if (int(i % std::size_t(image.channels)) < channels) reduced.data.push_back(image.data[i]);
      image = std::move(reduced);
    }
  }
  int largest = 3;
  for (const int window : options.windows) largest = std::max(largest, window);
  for (const Image& image : synthesizer.exemplar.match) {
    synthesizer.tables->image.push_back(
        makeTexelImage(image, synthesizer.exemplar.toroidal, largest / 2 + 3));
    synthesizer.tables->histogram.push_back(makeHistogramTarget(synthesizer.tables->image.back()));
    synthesizer.tables->seamUnit.push_back(
        seamUnit(synthesizer.tables->image.back(), seamChannels(synthesizer)));
  }
  if (windowsOf(synthesizer, 0).empty())
    throw std::invalid_argument("makeSynthesizer: no window fits the exemplar");
  return synthesizer;
}

TexturedSurface synthesize(Synthesizer& synthesizer, Surface surface, const Carried& carried, int frame,
                           double secondsSinceLast, SynthesisStats& stats, const Progress& progress) {
  stats = {};
  TexturedSurface result;
  result.exemplarWidth = synthesizer.exemplar.color.width;
  result.exemplarHeight = synthesizer.exemplar.color.height;
  if (surface.empty()) return result;
  SurfaceMesh& mesh = surface.levels.front();
  checkSizes(mesh, carried);
  const std::size_t count = mesh.positions.size();
  const bool labels = synthesizer.options.method == Method::coordinates;

  State state;
  std::vector<std::uint8_t> renewed(count, 1);
  if (carried.empty()) {
    state = synthesizeFirst(synthesizer, surface, frame, stats, progress);
  } else {
    const PreparedMesh prepared(mesh);
    state = labels ? synthesizeLater(synthesizer, prepared.view(), carried, frame, renewed, stats, progress)
                   : synthesizeColors(synthesizer, prepared.view(), carried, frame, stats, progress);
  }
  stats.renewed = double(std::accumulate(renewed.begin(), renewed.end(), std::size_t(0))) / double(count);

  result.spacing = mesh.spacing;
  result.color.resize(count);
  result.coordinate.resize(count);
  result.gradient.resize(count);
  result.age.assign(count, 0.0f);
  const TexelImage& image = synthesizer.tables->image.front();
  forEachIndex(count, [&](std::uint32_t v) {
    const Label& label = state.labels[v];
    const bool kept = !renewed[v];
    result.coordinate[v] = kept ? image.brought(carried.coordinate[v]) : label.texel;
    result.gradient[v] = kept ? carried.gradient[v]
                              : gradientOf(label, mesh.orientation[v], mesh.normals[v], mesh.spacingAt(v));
    if (kept) result.age[v] = carried.age[v] + float(secondsSinceLast);
    if (labels)
      sampleBilinear(synthesizer.exemplar.color, synthesizer.exemplar.toroidal, result.coordinate[v],
                     result.color[v].asPointer());
    else
      result.color[v] = decoded(state.value[v], synthesizer.exemplar.colorChannels);
  });
  if (progress) progress(1.0);
  result.trust = carried.empty() ? std::vector<float>(count, 0.0f) : carried.trust;
  result.previousPosition = carried.empty() ? mesh.positions : carried.previousPosition;
  result.positions = std::move(mesh.positions);
  result.normals = std::move(mesh.normals);
  result.orientation = std::move(mesh.orientation);
  result.triangles = std::move(mesh.triangles);
  result.scale = std::move(mesh.scale);
  return result;
}

}  // namespace fluidtex::texture
