// A disk that refuses: whatever bears a final name is whole, and the run can be finished.
#include "tests/file_limit.h"
#include "tests/tools/program.h"
#include "tools/base/atomic_file.h"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <sys/resource.h>
#include <fstream>

namespace fs = std::filesystem;

namespace {

// The smallest run that writes every kind of file.
Words tinyRun(const fs::path& out) {
  return {"run",       kSmallScene,
          "--set",     "frames=2",
          "--set",     "domain.resolution=12",
          "--set",     "texture.points=300",
          "--set",     "render.size=[32, 18]",
          "--set",     "render.samples=1",
          "--set",     "texture.windows=[9]",
          "--set",     "texture.first_iterations=[1]",
          "--threads", "1",
          "--out",     out.string()};
}

void limitFiles(rlim_t bytes) {
  const rlimit limit{bytes, bytes};
  setrlimit(RLIMIT_FSIZE, &limit);
}

class TinyRun {
 public:
  TinyRun() {
    const Finished run = started([] {}, tinyRun(m_whole));
    INFO(run.all());
    REQUIRE(run.exitCode == 0);
    m_expected = resultsIn(m_whole);
    REQUIRE(m_expected.size() == 4);
  }

  // A run into a folder of its own with what `setUp` does to it, and its end without that.
  void failsWell(const std::function<void(const fs::path& out)>& setUp) const {
    const Scratch scratch;
    const fs::path out = scratch.path / "out";
    const Finished run = started([&] { setUp(out); }, tinyRun(out));
    INFO(run.exitCode << ": " << run.all());
    CHECK((run.exitCode == 0 || run.exitCode == 1 || run.exitCode == 2));
    if (run.exitCode != 0) {
      const std::size_t fault = run.err.find("error: ");
      REQUIRE(fault != std::string::npos);
      CHECK(run.err.find('\n', fault) + 1 == run.err.size());
      for (const char c : run.err) CHECK((c == '\n' || (c >= ' ' && c <= '~')));
    }
    isWhole(out, run.exitCode == 0);
    Words again = tinyRun(out);
    again.emplace_back("--resume");
    const Finished resumed = started([] {}, again);
    INFO(resumed.all());
    REQUIRE(resumed.exitCode == 0);
    isWhole(out, true);
  }

 private:
  // All share what the first has kept of the exemplar.
  Finished started(const std::function<void()>& setUp, const Words& args) const {
    return runProgramWith(
        [&] {
          setenv("XDG_CACHE_HOME", (m_scratch.path / "cache").c_str(), 1);
          setUp();
        },
        args);
  }

  // Every file that there is, and, where the run is `done`, that there is every file.
  void isWhole(const fs::path& out, bool done) const {
    Results results;
    if (fs::exists(out))
      for (const auto& file : resultsIn(out))
        if (file.first.find("/.tmp-") == std::string::npos) results.push_back(file);
    CHECK(differing(results, m_expected).empty());
    if (done) CHECK(namesOf(results) == namesOf(m_expected));
    CHECK((!done || fs::exists(out / "small.mp4")));
    if (fs::exists(out / "small.mp4"))
      CHECK((readBytes(out / "small.mp4") == readBytes(m_whole / "small.mp4")));
    if (fs::exists(out / "run.json")) {
      const auto report = nlohmann::json::parse(readBytes(out / "run.json"), nullptr, false);
      REQUIRE_FALSE(report.is_discarded());
      CHECK((!done || report.at("frames").size() == 2));
    }
  }

  Scratch m_scratch;
  fs::path m_whole = m_scratch.path / "whole";
  Results m_expected;
};

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kCanPreload = false;  // the sanitizers want to be the first that is loaded
#else
constexpr bool kCanPreload = true;
#endif

// Runs with a call that fails, the `first`, one `stride` later and so on until nothing has failed any more.
void callsFail(const TinyRun& tiny, const char* program, bool onward, int first, int stride) {
  int call = first;
  for (bool failed = true; failed; call += stride) {
    const Scratch marks;
    const fs::path mark = marks.path / "mark";
    INFO("call " << call << " of " << program << (onward ? " and all after it" : ""));
    tiny.failsWell([&](const fs::path& out) {
      setenv("LD_PRELOAD", FLUIDTEX_FAIL_WRITES, 1);
      setenv("FAIL_PROGRAM", program, 1);
      setenv("FAIL_FOLDER", out.c_str(), 1);
      setenv("FAIL_AT", std::to_string(call).c_str(), 1);
      setenv("FAIL_ONWARD", onward ? "1" : "0", 1);
      setenv("FAIL_MARK", mark.c_str(), 1);
    });
    failed = fs::exists(mark);
  }
  // Pictures, surfaces, states, journal, report: written, flushed and renamed.
  const int lastThatFailed = call - 2 * stride;
  CHECK(lastThatFailed >= (std::string(program) == "fluidtex" ? 40 : 1));
}

// With room for so many bytes in all that a program writes.
void roomFor(const TinyRun& tiny, const char* program, const char* bytes) {
  INFO(bytes << " bytes for " << program);
  tiny.failsWell([&](const fs::path& out) {
    setenv("LD_PRELOAD", FLUIDTEX_FAIL_WRITES, 1);
    setenv("FAIL_PROGRAM", program, 1);
    setenv("FAIL_FOLDER", out.c_str(), 1);
    setenv("FAIL_BYTES", bytes, 1);
  });
}

void filesUpTo(const TinyRun& tiny, rlim_t kilobytes) {
  INFO(kilobytes << " kB");
  tiny.failsWell([&](const fs::path&) { limitFiles(kilobytes << 10); });
}

// No multiple of the calls that one file takes.
constexpr int kStride = 23;

}  // namespace

TEST_CASE(
    "failing writes: a call that the disk refuses once leaves whole files and a run that can be finished",
    "[tools][slow]") {
  if (!kCanPreload) return;
  const TinyRun tiny;
  callsFail(tiny, "fluidtex", false, 1, kStride);
  callsFail(tiny, "ffmpeg", false, 1, kStride);
}

TEST_CASE("failing writes: and so does a disk that is full from some moment on", "[tools][slow]") {
  if (!kCanPreload) return;
  const TinyRun tiny;
  callsFail(tiny, "fluidtex", true, 2, kStride);
  callsFail(tiny, "ffmpeg", true, 1, kStride);
}

TEST_CASE("failing writes: every call of a run", "[tools][long]") {
  if (!kCanPreload) return;
  const TinyRun tiny;
  for (const bool onward : {false, true})
    for (const char* program : {"fluidtex", "ffmpeg"}) callsFail(tiny, program, onward, 1, 1);
}

TEST_CASE("failing writes: with room for a few kilobytes only", "[tools][slow]") {
  if (!kCanPreload) return;
  const TinyRun tiny;
  for (const char* bytes : {"6000", "60000"}) roomFor(tiny, "fluidtex", bytes);
  roomFor(tiny, "ffmpeg", "1");
}

TEST_CASE("failing writes: with room for a few kilobytes only, of all sizes", "[tools][long]") {
  if (!kCanPreload) return;
  const TinyRun tiny;
  for (const char* bytes : {"1", "4096", "6000", "9000", "20000", "60000", "200000", "700000"})
    for (const char* program : {"fluidtex", "ffmpeg"}) roomFor(tiny, program, bytes);
}

TEST_CASE("failing writes: files that may not grow beyond a size", "[tools][slow]") {
  const TinyRun tiny;
  for (const rlim_t kilobytes : {4, 64}) filesUpTo(tiny, kilobytes);
}

TEST_CASE("failing writes: files that may not grow beyond any size", "[tools][long]") {
  const TinyRun tiny;
  for (rlim_t kilobytes = 1; kilobytes <= 1024; kilobytes *= 2) filesUpTo(tiny, kilobytes);
}

TEST_CASE("failing writes: a text that does not fit is none", "[tools]") {
  const Scratch scratch;
  const fs::path file = scratch.path / "text";
  fluidtex::tools::writeTextAtomically(file, "old");
  std::string what;
  try {
    const FileLimit limit(1000);
    fluidtex::tools::writeTextAtomically(file, std::string(5000, 'x'));
  } catch (const std::system_error& error) {
    what = error.what();
  }
  CHECK_THAT(what, Catch::Contains("cannot write: File too large"));
  CHECK(readBytes(file) == "old");
  CHECK(filesIn(scratch.path) == Words{"text"});
}
