#include "tools/run_folder/earlier_frames.h"

#include "tools/base/errors.h"
#include "tools/run_folder/earlier_run.h"
#include "tools/run_folder/input_files.h"
#include "tools/run_folder/journal.h"
#include "tools/run_folder/state.h"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace fluidtex::tools {
namespace {

// The records of all frames that are done. That of the last is in the state; the journal lacks it after a
// kill right behind that.
std::vector<Json> recordsUpTo(int done, Json last, const Journal& journal, const std::filesystem::path& out) {
  std::vector<Json> records;
  for (int frame = 1; frame < done; ++frame) {
    const auto record = journal.frames.find(frame);
    if (record == journal.frames.end())
      throw std::runtime_error(fmt::format("{}: lacks frame {}; remove the state folder to start anew",
                                           (out / "state" / "journal.txt").string(), frame));
    records.push_back(record->second);
  }
  if (const auto record = journal.frames.find(done); record != journal.frames.end())
    last = record->second;
  else
    addToJournal(out, {lineOfFrame(last)});
  records.push_back(std::move(last));
  return records;
}

}  // namespace

std::optional<EarlierFrames> earlierFrames(const scenes::Scene& scene, const RunOptions& options,
                                           const Report& now, int last) {
  removeLeftovers(options.out);
  std::optional<RunState> state = loadState(options.out / "state");
  if (!state) return std::nullopt;
  Report report = parseReport(state->report);
  if (report.frames.empty()) throw std::runtime_error("run.json of the state is damaged: it holds no frame");
  const auto refuse = [&](const std::string& why) {
    throw UsageError(fmt::format("{}: {}; run without --resume to start anew", options.out.string(), why));
  };
  const std::string difference = sceneDifference(report.scene, now.scene, report.inputs);
  if (!difference.empty()) refuse("was made by other settings: " + difference);
  const std::string changed = contentDifference(report.inputs, now.inputs, scene);
  if (!changed.empty()) refuse(changed);
  const int done = state->solver.frame;
  const Journal journal = readJournal(options.out);
  const std::optional<Broken> broken = firstBroken(options.out, journal, options.firstFrame,
                                                   std::min(done, last), frameFilesOf(scene, options.render));
  // Of the last frame all is there that its files are made of.
  const bool again = broken && broken->written && broken->frame == done;
  if (broken && !again)
    refuse(fmt::format("frames 1 to {} are done, but {} is not {}", done, broken->name,
                       broken->there ? "as the run wrote it" : "there"));
  return EarlierFrames{std::move(state->solver), std::move(state->surface),
                       recordsUpTo(done, std::move(report.frames.back()), journal, options.out), again};
}

}  // namespace fluidtex::tools
