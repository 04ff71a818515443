// OUT/state/journal.txt: what a run has finished, one line each, append-only. Its cost grows linearly with
// the number of frames, and a kill can truncate only the last line.
#pragma once

#include "tools/base/fingerprint.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace fluidtex::tools {

// A line to be appended.
struct JournalLine {
  nlohmann::ordered_json content;
};

// The record of a frame, as in run.json.
JournalLine lineOfFrame(const nlohmann::ordered_json& record);
// The content of a file of the run, relative to its folder, as it is or is about to be.
JournalLine lineOfFile(const std::string& name, const Fingerprint& content);

// Appends the lines, flushed to disk. Creates the file and its folder if missing. Throws std::system_error of
// the disk, or if the name is a link.
void addToJournal(const std::filesystem::path& out, const std::vector<JournalLine>& lines);

struct Journal {
  std::map<int, nlohmann::ordered_json> frames;   // by number; the last record of each frame
  std::multimap<std::string, Fingerprint> files;  // every content that a file has had
};

// Skips truncated or damaged lines, detected by their hash. Nothing without a journal.
Journal readJournal(const std::filesystem::path& out);

// Whether the file exists in `out` with a content that the journal records.
bool isWhole(const Journal& journal, const std::filesystem::path& out, const std::string& name);

bool hasJournal(const std::filesystem::path& out);

// Removes the journal from a folder of states, if there is one.
void removeJournal(const std::filesystem::path& stateFolder);

}  // namespace fluidtex::tools
