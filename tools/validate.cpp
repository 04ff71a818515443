// fluidtex validate [NAME...]: the reference tests, each figure beside its bar and what others measured.
#include "tools/base/atomic_file.h"
#include "tools/base/console.h"
#include "tools/base/errors.h"
#include "tools/base/work.h"
#include "tools/commands.h"
#include "tools/frames/progress.h"
#include "tools/summaries/plot.h"
#include "tools/validation/case.h"
#include "tools/validation_page.h"

#include <fmt/core.h>
#include <tbb/global_control.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <set>

namespace fluidtex::tools {
namespace {

using validation::Case;
using validation::Row;

struct ValidateOptions {
  std::vector<std::string> names;
  std::filesystem::path json, plots, page, figures;
  int resolution = 0;
  int threads = 0;
  bool list = false;
};

// A case and one of its resolutions.
struct Job {
  const Case* test;
  int resolution;
};

constexpr const char* kQuick = "quick";

std::vector<Job> planJobs(const ValidateOptions& options) {
  std::set<std::string> known{kQuick};
  for (const Case& c : validation::cases()) known.insert({c.name, c.group});
  for (const std::string& name : options.names) {
    if (known.count(name) != 0) continue;
    std::string all;
    for (const std::string& word : known) all += (all.empty() ? "" : ", ") + word;
    throw UsageError(name + ": no such test or set of tests; there are: " + all);
  }
  const auto asked = [&](const std::string& name) {
    return std::find(options.names.begin(), options.names.end(), name) != options.names.end();
  };
  std::vector<Job> jobs;
  for (const Case& c : validation::cases()) {
    const bool whole = options.names.empty() || asked(c.name) || asked(c.group);
    if (!whole && !asked(kQuick)) continue;
    if (options.resolution > 0) {
      if (whole || !c.quick.empty()) jobs.push_back({&c, options.resolution});
      continue;
    }
    for (const int resolution : whole ? c.resolutions : c.quick) jobs.push_back({&c, resolution});
  }
  return jobs;
}

std::string bound(const Row& row, const std::optional<double>& value) {
  return value ? fmt::format("{}{:.3g}", row.atLeast ? ">= " : "", *value) : "-";
}

void printHead() {
  print("{:<21} {:>5}  {:<28} {:>11} {:>9} {:>9}  {}\n", "test", "cells", "measure", "value", "must", "goal",
        "published");
}

void printRow(const Row& row) {
  std::string others;
  for (const auto& [value, source] : row.published)
    others += fmt::format("{}{:.3g} ({})", others.empty() ? "" : "; ", value, source);
  print("{:<21} {:>5}  {:<28} {:>11.4g} {:>9} {:>9}  {}{}\n", row.test, row.resolution, row.measure,
        row.value, bound(row, row.must), bound(row, row.goal), row.ok() ? "" : "FAILS  ", others);
  std::fflush(stdout);
}

nlohmann::ordered_json toJson(const Row& row) {
  const auto orNull = [](const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
  };
  nlohmann::ordered_json published = nlohmann::ordered_json::array();
  for (const auto& [value, source] : row.published)
    published.push_back({{"value", value}, {"source", source}});
  return {{"test", row.test},         {"resolution", row.resolution},
          {"measure", row.measure},   {"value", row.value},
          {"must", orNull(row.must)}, {"goal", orNull(row.goal)},
          {"published", published},   {"ok", row.ok()},
          {"seconds", row.seconds}};
}

// The bar of the test that runs now, redrawn on a terminal only.
class JobProgress {
 public:
  JobProgress(const Job& job, std::size_t number, std::size_t count)
      : m_label(fmt::format("{} {} ({} of {})", job.test->name, job.resolution, number, count)),
        m_start(Clock::now()) {}
  ~JobProgress() { clearStatus(); }

  void update(double part) {
    const auto now = Clock::now();
    if (!drawsStatus() || now - m_drawn < std::chrono::milliseconds(100)) return;
    m_drawn = now;
    const double gone = std::chrono::duration<double>(now - m_start).count();
    showStatus(fmt::format("{}: {:.0f}%, {} left", m_label, 100.0 * part,
                           part > 0.01 ? humanDuration(gone / part - gone) : "?"));
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::string m_label;
  Clock::time_point m_start, m_drawn;
};

// Error over resolution, one plot for each measure of a case that was run at several.
void plotConvergence(const std::string& name, const std::vector<Row>& rows,
                     const std::filesystem::path& folder) {
  std::vector<std::string> measures;
  for (const Row& row : rows) {
    if (std::find(measures.begin(), measures.end(), row.measure) == measures.end())
      measures.push_back(row.measure);
  }
  validation::Plot plot{
      name + "_convergence", name + ": error over resolution", "cells", "error", true, false, {}};
  for (const std::string& measure : measures) {
    validation::Curve curve{measure, {}, validation::Curve::Style::line};
    for (const Row& row : rows) {
      if (row.measure == measure && row.value != 0.0)
        curve.points.push_back({double(row.resolution), std::abs(row.value)});
    }
    if (curve.points.size() > 1) plot.curves.push_back(std::move(curve));
  }
  if (!plot.curves.empty()) writePlot(plot, folder / (plot.name + ".svg"));
}

void listCases() {
  for (const Case& c : validation::cases()) {
    std::string resolutions;
    for (const int n : c.resolutions) resolutions += fmt::format(" {}", n);
    print("{:<21} {:<10} {};{}\n", c.name, c.group, c.title, resolutions);
  }
}

// Brings the tables of a page up to date; of the pages, one has the rows that have to clear a bar and one the
// others.
void updatePage(const std::filesystem::path& page, const std::vector<Row>& rows) {
  std::ifstream in(page);
  if (!in) throw UsageError(page.string() + ": cannot be read");
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  try {
    writeTextAtomically(page, updatedPage(text, rows));
  } catch (const PageError& error) {
    throw UsageError(page.string() + ": " + error.what());
  }
}

int validate(const ValidateOptions& options) {
  if (options.list) {
    listCases();
    return kDone;
  }
  std::unique_ptr<tbb::global_control> limit;
  if (options.threads > 0)
    limit =
        std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism, options.threads);
  const std::vector<Job> jobs = planJobs(options);
  nowAt(kOnMotion);

  std::vector<Row> all;
  bool holds = true;
  std::vector<Row> ofCase;
  const auto take = [&](const Row& row) {
    printRow(row);
    all.push_back(row);
    holds = holds && row.ok();
    ofCase.push_back(row);
  };
  printHead();
  for (std::size_t n = 0; n < jobs.size(); ++n) {
    const Job& job = jobs[n];
    const auto start = std::chrono::steady_clock::now();
    validation::Result result;
    {
      JobProgress progress(job, n + 1, jobs.size());
      result = job.test->run(job.resolution, [&](double part) { progress.update(part); });
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    for (Row& row : result.rows) {
      row.seconds = seconds;
      take(row);
    }
    if (!options.plots.empty()) {
      for (const validation::Plot& plot : result.plots) writePlot(plot, options.plots / (plot.name + ".svg"));
    }
    if (n + 1 < jobs.size() && jobs[n + 1].test == job.test) continue;
    if (job.test->summarize) {
      for (const Row& row : job.test->summarize(ofCase)) take(row);
    }
    if (!options.plots.empty()) plotConvergence(job.test->name, ofCase, options.plots);
    ofCase.clear();
  }
  if (!options.json.empty()) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const Row& row : all) json.push_back(toJson(row));
    writeTextAtomically(options.json, json.dump(2) + "\n");
  }
  const auto others =
      std::stable_partition(all.begin(), all.end(), [](const Row& row) { return bool(row.must); });
  if (!options.page.empty()) updatePage(options.page, {all.begin(), others});
  if (!options.figures.empty()) updatePage(options.figures, {others, all.end()});
  return holds ? kDone : kFailed;
}

}  // namespace

Command validateCommand() {
  const auto options = std::make_shared<ValidateOptions>();
  Command command{"validate", "Run the reference tests and print each figure beside its bar"};
  command.options = {
      {"names", &options->names, "NAME",
       "Tests, or sets of them (level_set, fluid, quick); all when none is named"},
      {"--json", &options->json, "FILE", "Write the figures to this file"},
      {"--plots", &options->plots, "DIR", "Write the plots into this folder, as SVG"},
      {"--docs", &options->page, "PAGE",
       "Bring the tables of this page up to date (docs/results/validation.md)"},
      {"--figures", &options->figures, "PAGE",
       "The same for the page of figures without a bar (docs/results/figures.md)"},
      {"--resolution", &options->resolution, "N", "Run at this resolution only", {.least = 8, .most = 4096}},
      {"--threads",
       &options->threads,
       "N",
       "Threads to use; one a core where not given",
       {.least = 1, .most = 4096}},
      {"--list", &options->list, "", "Print the tests and their resolutions"},
  };
  command.footer =
      "Example:\n  fluidtex validate zalesak vortex_8 --plots docs/validation --json figures.json";
  command.run = [options] { return validate(*options); };
  return command;
}

}  // namespace fluidtex::tools
