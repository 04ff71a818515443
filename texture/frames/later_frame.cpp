#include "texture/frames/later_frame.h"

#include "numerics/random.h"
#include "texture/frames/first_frame.h"
#include "texture/frames/fresh_start.h"
#include "texture/frames/look_ahead.h"
#include "texture/frames/renewal.h"
#include "texture/labels/chips.h"
#include "texture/labels/fresh.h"
#include "texture/labels/guidance.h"
#include "texture/loops/complex.h"
#include "texture/loops/parallel.h"

#include <algorithm>
#include <cmath>

namespace fluidtex::texture {
namespace {

// Rings around discs whose labels may change too, so that seams find a path.
constexpr int kRim = 5;
// Where the flow wears out much: the share of the renewed surface that discs cover; the rest lies between
// them.
constexpr double kDiscsOfAll = 0.65;
// Weight of the data term: difference of the labels' colours from the last average.
constexpr float kLaterData = 0.4f;
// Upper bound on the compression of new texture (log), besides kMostAhead: beyond it, flattening would take
// the strained surface for a folded one.
constexpr double kMostStrain = 0.45;
// Spacing of the vertices that sample the surface at half detail: 1 to 2 of its pixels.
constexpr float kHalfRadius = 0.8f;
// Rings beyond the renewed region within which windows at half detail see its surroundings. Wider windows are
// cut off there: the full reach of a 33 pixel window, 47, gives no better texture and takes longer.
constexpr int kHalfReach = 20;

// Inputs shared by the steps of one frame.
struct Job {
  Synthesizer& synthesizer;
  const Surface& surface;
  const SeamModel& seams;
  int frame;
  SynthesisStats& stats;
  const Progress& progress;
};

// What is renewed in a frame.
struct Renewal {
  std::vector<Disc> discs;
  std::vector<std::uint8_t> wanted;    // #V: in discs, or lost
  std::vector<std::uint8_t> withRims;  // #V: these and the rims around them, within which labels are joined
};

// Texel x of the full exemplar lies at (x - 1/2) / 2 of the halved one. Jacobians stay: pixels double as
// texels do.
Labels halved(const Labels& labels, const TexelImage& half) {
  Labels result = labels;
  forEachIndex(labels.size(), [&](std::uint32_t v) {
    result[v].texel = half.brought((labels[v].texel - Vec2f(0.5f, 0.5f)) * 0.5f);
  });
  return result;
}

// Takes the members' labels to full detail and continues them over the wanted vertices between them.
void spread(const TexelImage& image, const MeshView& view, const std::vector<std::uint8_t>& wanted,
            const Labels& coarse, Labels& labels) {
  std::vector<std::uint8_t> placed(labels.size(), 0);
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    if (!wanted[v] || !view.isMember(v)) continue;
    labels[v] = {image.brought(coarse[v].texel * 2.0f + Vec2f(0.5f, 0.5f)), coarse[v].jacobian};
    placed[v] = 1;
  }
  handOn(image, view, wanted, std::move(placed), labels);
}

// Lays out the wanted vertices at half detail: features cover half as many pixels, of twice the size.
void layOut(const Job& job, const std::vector<std::uint8_t>& wanted, Labels& labels) {
  const SearchTables& tables = *job.synthesizer.tables;
  const MeshView& view = job.seams.view;
  MeshView half{view.mesh, view.graph, view.connection, 2.0f, nullptr};
  std::vector<std::uint8_t> members(labels.size(), 0);
  for (const std::uint32_t v : selectCenters(half, kHalfRadius, grown(view.graph, wanted, kHalfReach)))
    members[v] = 1;
  half.members = &members;

  State state;
  state.labels = halved(labels, tables.image[1]);
  state.value = lookUp(tables.image[1], state.labels);
  Level level{half, tables.image[1], tables.histogram[1], {}, wanted};
  const std::size_t windows = windowsOf(job.synthesizer, 1).size();
  runPasses(job.synthesizer, level,
            {1, job.frame, job.synthesizer.options.laterIterations, 1, true, 0,
             std::max<std::size_t>(windows, 2) - 1},
            state, job.stats, job.progress);
  spread(tables.image.front(), half, wanted, state.labels, labels);
}

// Textures wide fresh surface like a first frame, where the surface has coarser levels.
void startFromNothing(const Job& job, const std::vector<float>& trust, Labels& labels) {
  const auto& [synthesizer, surface, seams, frame, stats, progress] = job;
  const MeshView& view = seams.view;
  if (surface.levels.size() < 2 || synthesizer.tables->image.size() < 2) return;
  const std::vector<std::uint8_t> wide =
      wideFresh(view.graph, freshVertices(trust), synthesizer.options.windows.front());
  if (!any(wide)) return;
  const State coarse = synthesizeFromNothing(synthesizer, surface, 1, frame, stats, {});
  const Labels fine =
      refineLabels(surface.levels[1], coarse.labels, view.mesh, synthesizer.tables->image.front());
  for (std::uint32_t v = 0; v < labels.size(); ++v)
    if (wide[v]) labels[v] = fine[v];
}

// Labels of the renewed surface: discs start from blocks of the exemplar, wide fresh surface from a coarser
// level; all of it is laid out at half detail first, then at full detail within the rims, and joined along
// the least visible seams.
Labels layAnew(const Job& job, Renewal renewal, const std::vector<float>& trust, const Labels& before) {
  const auto& [synthesizer, surface, seams, frame, stats, progress] = job;
  const SynthesisOptions& options = synthesizer.options;
  const SearchTables& tables = *synthesizer.tables;
  const TexelImage& image = tables.image.front();
  const MeshView& view = seams.view;
  State state;
  state.labels = before;
  state.average = lookUp(image, before);
  holdGuidance(image, view.mesh, state.average);
  startAfresh(view, image, renewal.discs, options.renewalRadius, state.average,
              keyOf(synthesizer, frame, 0, 2), state.labels);
  startFromNothing(job, trust, state.labels);
  if (tables.image.size() > 1) layOut(job, renewal.wanted, state.labels);
  state.value = lookUp(image, state.labels);

  const Level level{view, image, tables.histogram.front(), {}, std::move(renewal.withRims)};
  const std::size_t windows = windowsOf(synthesizer, 0).size();
  runPasses(synthesizer, level,
            {0, frame, options.laterIterations, 1, false, windows > 1 ? std::size_t(1) : 0}, state, stats,
            progress);
  joinLabels(seams, state, kLaterData, level.wanted, &before, keyOf(synthesizer, frame, 0, 1), state.labels);
  return std::move(state.labels);
}

// Texture that is renewed sooner is laid less compressed, or it would count as worn.
std::vector<Strain> aheadOf(const std::vector<Strain>& rates, const SynthesisOptions& options,
                            const std::vector<float>& factor) {
  const double most = std::min(kMostAhead * std::log(options.keepStretch), kMostStrain);
  std::vector<Strain> ahead = strainAhead(rates, options.lookAhead, most);
  forEachIndex(factor.size(), [&](std::uint32_t v) {
    const float share = 1.0f / std::max(factor[v], 1.0f);
    ahead[v] = {ahead[v].mean * share, ahead[v].deviator * share};
  });
  return ahead;
}

// #V, 1 where labels may change. Droplets keep theirs, and so do vertices within a cross-fade, whose colour
// would jump, surface that the flow goes through, and texture that is never renewed.
std::vector<std::uint8_t> renewable(const Synthesizer& synthesizer, const VertexGraph& graph,
                                    const Carried& carried) {
  std::vector<std::uint8_t> result = searched(synthesizer, graph);
  if (result.empty()) result.assign(carried.trust.size(), 1);
  for (std::size_t v = 0; v < result.size(); ++v)
    if ((carried.fading.weight[v] > 0.0f || (!carried.stays.empty() && carried.stays[v]) ||
         !(carried.renewalAt(std::uint32_t(v)) > 0.0f)) &&
        believed(carried.trust[v]))
      result[v] = 0;
  return result;
}

// #V: free and (a or b).
std::vector<std::uint8_t> freeWhereEither(const std::vector<std::uint8_t>& free, std::vector<std::uint8_t> a,
                                          const std::vector<std::uint8_t>& b) {
  for (std::size_t v = 0; v < free.size(); ++v) a[v] = free[v] && (a[v] || b[v]);
  return a;
}

}  // namespace

LaterFrame synthesizeLater(Synthesizer& synthesizer, const Surface& surface, const MeshView& now,
                           const Carried& carried, const FrameTime& frame, SynthesisStats& stats,
                           const Progress& progress) {
  const SynthesisOptions& options = synthesizer.options;
  const Labels labels = labelsOf(now.mesh, carried.coordinate, carried.gradient);
  const std::size_t count = labels.size();
  SeamModel worn = seamModel(synthesizer, now, 0);
  worn.stays = &carried.stays;
  worn.original = &carried.original;
  const Wear wear = scaled(wearAround(worn, labels, carried.trust), carried.renewal);
  const std::vector<Strain> rates =
      strainRates(now, carried.previousPosition, carried.trust, frame.secondsSinceLast);
  LaterFrame result{labels, std::vector<std::uint8_t>(count, 0), std::vector<float>(count)};
  forEachIndex(count, [&](std::uint32_t v) {
    result.fadingSpeed[v] = fadingSpeed(largest(rates[v]), options.keepStretch, options.fade);
  });

  // From here on the surface is the strained one ahead in time, and labels are as it has them.
  const std::vector<Strain> ahead = aheadOf(rates, options, carried.renewal);
  const Connection connection = strained(now, ahead);
  const MeshView view{now.mesh, now.graph, connection, now.pixel, now.members};
  SeamModel seams = seamModel(synthesizer, view, 0);
  seams.stays = &carried.stays;
  seams.original = &carried.original;
  const Labels before = strained(labels, ahead);

  const std::vector<std::uint8_t> free = renewable(synthesizer, view.graph, carried);
  Renewal renewal;
  const double budget = options.renewalRate * frame.secondsSinceLast;
  // More where the flow wears texture out faster.
  const double urgentBudget = std::max(
      budget, kDiscsOfAll * wornShare(rates, frame.secondsSinceLast, options.keepStretch, carried.renewal));
  renewal.discs = worstDiscs(seams, labels, wear, free,
                             {options.keepStretch, options.renewalRadius, budget, urgentBudget},
                             streamOf(options.seed, Stream::renewal));
  std::vector<std::uint8_t> inDiscs(count, 0);
  for (const Disc& disc : renewal.discs)
    for (const std::uint32_t v : disc.members) inDiscs[v] = 1;
  const std::vector<std::uint8_t> lost = lostLabels(seams, before, carried.trust);
  renewal.wanted = freeWhereEither(free, inDiscs, lost);
  if (!any(renewal.wanted)) return result;
  renewal.withRims = freeWhereEither(free, grown(view.graph, inDiscs, kRim), lost);

  Labels proposed = layAnew({synthesizer, surface, seams, frame.index, stats, progress}, std::move(renewal),
                            carried.trust, before);
  absorbChips(seams, free, proposed);
  // What is kept longer is judged as all else once it is to be renewed.
  std::vector<float> sooner = carried.renewal;
  for (float& factor : sooner) factor = std::max(factor, 1.0f);
  result.labels = unstrained(settle(seams, before, proposed, carried.trust, result.renewed, sooner), ahead);
  return result;
}

}  // namespace fluidtex::texture
