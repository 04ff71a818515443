#include "tools/benchmarks/measure.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <functional>
#include <thread>
#include <vector>

using namespace fluidtex::benchmarks;
using Catch::Contains;

namespace {

// What is printed meanwhile.
std::string printed(const std::function<void()>& print) {
  const Scratch scratch;
  const std::string file = scratch.path / "printed.txt";
  std::fflush(stdout);
  const int before = dup(STDOUT_FILENO), out = open(file.c_str(), O_CREAT | O_WRONLY, 0600);
  REQUIRE(dup2(out, STDOUT_FILENO) == STDOUT_FILENO);
  print();
  std::fflush(stdout);
  REQUIRE(dup2(before, STDOUT_FILENO) == STDOUT_FILENO);
  close(out);
  close(before);
  return readBytes(file);
}

// Keeps what the rows that ran have measured.
class Rows : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& report) override {
    runs.insert(runs.end(), report.begin(), report.end());
  }
  std::vector<Run> runs;
};

std::vector<benchmark::BenchmarkReporter::Run> ranRows() {
  Rows rows;
  benchmark::RunSpecifiedBenchmarks(&rows);
  benchmark::ClearRegisteredBenchmarks();
  return rows.runs;
}

}  // namespace

TEST_CASE("measure: the middle one of numbers in any order, the mean of two middle ones", "[benchmarks]") {
  CHECK(median({7.0}) == 7.0);
  CHECK(median({9.0, -1.0, 4.0}) == 4.0);
  CHECK(median({8.0, 1.0, 100.0, 2.0}) == 5.0);
}

TEST_CASE("measure: a thread that waits takes time by the wall, and none of the processor", "[benchmarks]") {
  const double processor = processorSeconds(), wall = wallSeconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  CHECK(wallSeconds() - wall >= 0.06);
  CHECK(processorSeconds() - processor < 0.03);
}

TEST_CASE("measure: the work of all threads is counted", "[benchmarks]") {
  const double before = processorSeconds(), wall = wallSeconds();
  const auto work = [] {
    timespec now{};
    do clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    while (double(now.tv_sec) + 1e-9 * double(now.tv_nsec) < 0.02);
  };
  std::vector<std::thread> threads;
  for (int n = 0; n < 4; ++n) threads.emplace_back(work);
  for (std::thread& thread : threads) thread.join();
  CHECK(processorSeconds() - before >= 0.08);
  CHECK(wallSeconds() - wall >= 0.02);
}

TEST_CASE("measure: the most memory that was held, also once it is given back", "[benchmarks]") {
  const auto bytes = std::size_t(peakBytes()) + (std::size_t(16) << 20);
  {
    std::vector<char> much(bytes, 1);
    CHECK(much[bytes / 2] == 1);
  }
  CHECK(peakBytes() >= double(bytes));
  CHECK(peakBytes() < 4.0 * double(bytes));
}

TEST_CASE("measure: peers are compared with our row of the same name and quantity", "[benchmarks]") {
  keep("rows/8", "seconds", 2.0);
  CHECK(printed(printRatios).empty());
  keep("rows/8/peer:first", "seconds", 100.0);
  keep("rows/8/peer:first", "seconds", 3.0);  // the last repetition counts
  keep("rows/8/peer:second", "seconds", 1.0);
  keep("rows/8/peer:second", "bytes", 1000.0);  // ours did not count any
  keep("rows/80/peer:first", "seconds", 7.0);   // there is no row of ours
  const std::string text = printed(printRatios);
  CHECK_THAT(text, Contains("peer / ours"));
  CHECK(std::count(text.begin(), text.end(), '\n') == 4);
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1)
    lines.push_back(text.substr(at, text.find('\n', at) - at));
  CHECK_THAT(lines[2], Catch::StartsWith("rows/8/peer:first ") && Contains(" seconds ") &&
                           Catch::EndsWith(" 2            3   1.50"));
  CHECK_THAT(lines[3], Catch::StartsWith("rows/8/peer:second ") && Catch::EndsWith(" 2            1   0.50"));
}

TEST_CASE("measure: a row runs once, and takes the time that it says", "[benchmarks]") {
  int times = 0;
  addRow("row", [&](benchmark::State& state) {
    for ([[maybe_unused]] auto _ : state) {
      ++times;
      state.SetIterationTime(0.5);
    }
  });
  addRow(
      "row in seconds",
      [](benchmark::State& state) {
        for ([[maybe_unused]] auto _ : state) state.SetIterationTime(3.0);
      },
      benchmark::kSecond);
  const auto runs = ranRows();
  CHECK(times == 1);
  REQUIRE(runs.size() == 2);
  CHECK_THAT(runs[0].benchmark_name(), Catch::StartsWith("row/"));
  CHECK(runs[0].iterations == 1);
  CHECK(runs[0].GetAdjustedRealTime() == Approx(500.0));  // ms
  CHECK(runs[1].GetAdjustedRealTime() == Approx(3.0));
}

// What this program answers below when it is run with this test's name.
TEST_CASE("measure: answer of a program that counts", "[.]") {
  std::printf("{\"bytes\": 3e6, \"cells\": 1200, \"seconds\": 0.25}\n");
}

TEST_CASE("measure: memory is counted in a run of this very program", "[benchmarks]") {
  std::optional<double> bytes, none = 1.0;
  addRow("counted", [&](benchmark::State& state) {
    for ([[maybe_unused]] auto _ : state)
      bytes = measureMemory(state, "\"measure: answer of a program that counts\" --out /dev/null", "cell");
  });
  addRow("failed", [&](benchmark::State& state) {
    for ([[maybe_unused]] auto _ : state)
      none = measureMemory(state, "--no-such-option >/dev/null 2>&1", "cell");
  });
  const auto runs = ranRows();
  REQUIRE(bytes);
  CHECK(*bytes == 2500.0);
  CHECK_FALSE(none);
  REQUIRE(runs.size() == 2);
  CHECK(runs[0].GetAdjustedRealTime() == Approx(250.0));
  CHECK(runs[0].counters.at("bytes_per_cell") == 2500.0);
  CHECK(runs[0].counters.at("cells") == 1200.0);
  CHECK(runs[0].counters.at("peak_MB") == 3.0);
  CHECK(runs[1].counters.empty());
}
