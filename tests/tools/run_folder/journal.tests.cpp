#include "tools/run_folder/journal.h"

#include "tests/scratch.h"
#include "tests/tools/formats/sample_surface.h"
#include "tools/run_folder/report.h"

#include <catch2/catch.hpp>

#include <fstream>

using namespace fluidtex;
using namespace fluidtex::tools;
namespace fs = std::filesystem;

namespace {

// Bytes that this process has handed to the system so far.
long long written() {
  std::ifstream in("/proc/self/io");
  for (std::string key; in >> key;) {
    long long value = 0;
    in >> value;
    if (key == "wchar:") return value;
  }
  return -1;
}

Json recordOf(int frame) {
  sim::Frame motion;
  motion.index = frame;
  Json record = frameRecord(motion, sampleSurface(), std::vector<texture::Singularity>(8), {});
  recordCost(record, {});
  return record;
}

struct Bytes {
  long long written = 0, left = 0;  // in all; and in the end, in run.json
};

// Of run.json and the journal of a run of so many frames.
Bytes bytesOf(int frames) {
  const Scratch scratch;
  Report report;
  ReportFile file(scratch.path);
  const long long before = written();
  for (int frame = 1; frame <= frames; ++frame) {
    report.frames.push_back(recordOf(frame));
    addToJournal(scratch.path, {lineOfFrame(report.frames.back())});
    file.frameDone(report);
  }
  file.write(report);
  const long long bytes = written() - before;
  CHECK(parseReport(readBytes(scratch.path / "run.json")).frames.size() == std::size_t(frames));
  return {bytes, static_cast<long long>(fs::file_size(scratch.path / "run.json"))};
}

}  // namespace

TEST_CASE("journal: what was added is read back, of one frame the last record", "[tools]") {
  const Scratch scratch;
  CHECK(readJournal(scratch.path).frames.empty());
  CHECK_FALSE(hasJournal(scratch.path));
  addToJournal(scratch.path, {lineOfFrame({{"frame", 1}, {"volume", 0.1}}), lineOfFile("a b", {3, "abc"})});
  addToJournal(scratch.path, {lineOfFrame({{"frame", 2}})});
  addToJournal(scratch.path,
               {lineOfFrame({{"frame", 1}, {"volume", 0.30000000000000004}}), lineOfFile("a b", {4, "d"})});
  const Journal journal = readJournal(scratch.path);
  REQUIRE(journal.frames.size() == 2);
  CHECK(journal.frames.at(1).at("volume").get<double>() == 0.1 + 0.2);
  CHECK(journal.files.count("a b") == 2);
}

TEST_CASE("journal: cut anywhere, it lacks its last line and no other, and goes on", "[tools]") {
  const Scratch scratch;
  for (int frame = 1; frame <= 3; ++frame) addToJournal(scratch.path, {lineOfFrame({{"frame", frame}})});
  const fs::path file = scratch.path / "state" / "journal.txt";
  const std::string whole = readBytes(file);
  const std::size_t third = whole.find('\n', whole.find('\n') + 1) + 1;
  for (std::size_t size = third; size + 1 < whole.size(); ++size) {
    std::ofstream(file, std::ios::binary) << whole.substr(0, size);
    REQUIRE(readJournal(scratch.path).frames.size() == 2);
    addToJournal(scratch.path, {lineOfFrame({{"frame", 4}})});
    REQUIRE(readJournal(scratch.path).frames.size() == 3);
    REQUIRE(readJournal(scratch.path).frames.contains(4));
  }
}

TEST_CASE("journal: a line that was changed is none", "[tools]") {
  const Scratch scratch;
  addToJournal(scratch.path, {lineOfFrame({{"frame", 1}}), lineOfFrame({{"frame", 2}})});
  const fs::path file = scratch.path / "state" / "journal.txt";
  const std::string whole = readBytes(file);
  for (std::size_t at = 0; at < whole.find('\n'); ++at) {
    std::string changed = whole;
    changed[at] ^= 1;
    std::ofstream(file, std::ios::binary) << changed;
    const Journal journal = readJournal(scratch.path);
    REQUIRE((journal.frames.size() == 1 && journal.frames.contains(2)));
  }
}

TEST_CASE("journal: a link is not followed", "[tools]") {
  const Scratch scratch;
  fs::create_directories(scratch.path / "state");
  std::ofstream(scratch.path / "mine") << "mine";
  fs::create_symlink(scratch.path / "mine", scratch.path / "state" / "journal.txt");
  CHECK_THROWS_AS(addToJournal(scratch.path, {lineOfFrame({{"frame", 1}})}), std::system_error);
  CHECK(readBytes(scratch.path / "mine") == "mine");
}

TEST_CASE("run.json: what a run writes of its frames grows with their number, not with its square",
          "[tools]") {
  const Bytes some = bytesOf(250), more = bytesOf(1000);
  INFO("250 and 1000 frames: " << some.written << " and " << more.written << " bytes written, " << some.left
                               << " and " << more.left << " in run.json");
  CHECK(more.written < 5 * some.written);
  // Rewritten when an eighth has come, it is written nine times over.
  CHECK(more.written < 11 * more.left);
}
