// A line: the hash of its text, a space, its text (JSON on one line).
#include "tools/run_folder/journal.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kName = "journal.txt";

fs::path journalOf(const fs::path& out) {
  return out / "state" / kName;
}

[[noreturn]] void fail(const fs::path& file, const char* what) {
  throw std::system_error(errno, std::generic_category(), file.string() + ": " + what);
}

struct Descriptor {
  int number;
  ~Descriptor() { close(number); }
};

// Whether the last line was cut short: the next one must not go on there.
bool endsWithinLine(int descriptor, const fs::path& file) {
  struct stat status {};
  if (fstat(descriptor, &status) != 0) fail(file, "cannot be read");
  char last = '\n';
  return status.st_size > 0 && (pread(descriptor, &last, 1, status.st_size - 1) != 1 || last != '\n');
}

}  // namespace

JournalLine lineOfFrame(const Json& record) {
  return {record};
}

JournalLine lineOfFile(const std::string& name, const Fingerprint& content) {
  return {{{"file", name}, {"bytes", content.bytes}, {"hash", content.hash}}};
}

void addToJournal(const fs::path& out, const std::vector<JournalLine>& lines) {
  const fs::path file = journalOf(out);
  fs::create_directories(file.parent_path());
  const Descriptor journal{open(file.c_str(), O_RDWR | O_CREAT | O_APPEND | O_NOFOLLOW | O_CLOEXEC, 0644)};
  if (journal.number < 0) fail(file, "cannot be opened");
  std::string text = endsWithinLine(journal.number, file) ? "\n" : "";
  for (const JournalLine& line : lines) {
    const std::string content = line.content.dump();
    text += hashOf(content) + " " + content + "\n";
  }
  for (std::size_t done = 0; done < text.size();) {
    const ssize_t count = write(journal.number, text.data() + done, text.size() - done);
    if (count < 0 && errno != EINTR) fail(file, "cannot write");
    if (count > 0) done += static_cast<std::size_t>(count);
  }
  if (fsync(journal.number) != 0) fail(file, "cannot flush");
}

Journal readJournal(const fs::path& out) {
  Journal journal;
  std::ifstream in(journalOf(out), std::ios::binary);
  for (std::string line; std::getline(in, line);) {
    const std::size_t space = line.find(' ');
    if (space == std::string::npos ||
        hashOf(std::string_view(line).substr(space + 1)) != line.substr(0, space))
      continue;
    Json content =
        Json::parse(line.begin() + static_cast<std::ptrdiff_t>(space) + 1, line.end(), nullptr, false);
    if (content.is_discarded()) continue;
    if (content.contains("frame")) {
      const int frame = content["frame"].get<int>();
      journal.frames[frame] = std::move(content);
    } else if (content.contains("file")) {
      journal.files.emplace(
          content["file"].get<std::string>(),
          Fingerprint{content["bytes"].get<std::uint64_t>(), content["hash"].get<std::string>()});
    }
  }
  return journal;
}

bool isWhole(const Journal& journal, const fs::path& out, const std::string& name) {
  const auto [begin, end] = journal.files.equal_range(name);
  if (begin == end || !fs::is_regular_file(out / name)) return false;
  const Fingerprint now = fingerprintOf(out / name);
  return std::any_of(begin, end, [&](const auto& entry) { return entry.second == now; });
}

bool hasJournal(const fs::path& out) {
  return fs::exists(journalOf(out));
}

void removeJournal(const fs::path& stateFolder) {
  fs::remove(stateFolder / kName);
}

}  // namespace fluidtex::tools
