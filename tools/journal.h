// OUT/state/journal.txt: what a run has finished, a line each, only ever added to. What it costs grows with
// the number of frames and not with its square, and a kill can cut no line but the last.
#pragma once

#include "tools/fingerprint.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace fluidtex::tools {

// A line that is to be added.
struct JournalLine {
  nlohmann::ordered_json content;
};

// A frame's record, as in run.json.
JournalLine lineOfFrame(const nlohmann::ordered_json& record);
// A file of the run, relative to its folder, as it is now or about to be.
JournalLine lineOfFile(const std::string& name, const Fingerprint& content);

// Adds the lines, flushed to disk. Makes the file, and its folder, where missing. Throws std::system_error
// where the disk refuses, or where the name is a link.
void addToJournal(const std::filesystem::path& out, const std::vector<JournalLine>& lines);

struct Journal {
  std::map<int, nlohmann::ordered_json> frames;   // by number; of several records of one frame the last
  std::multimap<std::string, Fingerprint> files;  // all that a file has ever been
};

// Lines that are cut short or damaged, which their hash tells, are left out. Nothing where there is no
// journal.
Journal readJournal(const std::filesystem::path& out);

// Whether the file in `out` is there and as the journal says.
bool isWhole(const Journal& journal, const std::filesystem::path& out, const std::string& name);

bool hasJournal(const std::filesystem::path& out);

// In a folder of states; nothing where there is none.
void removeJournal(const std::filesystem::path& stateFolder);

}  // namespace fluidtex::tools
