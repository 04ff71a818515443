#include "tools/base/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cctype>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <fstream>
#include <mutex>
#include <set>
#include <system_error>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPrefix = ".tmp-";

// ".tmp-MACHINE-": without a - in it, so that no other machine's begins so.
const std::string& prefixOfMachine() {
  static const std::string prefix = [] {
    constexpr std::size_t kLongest = 30;
    char name[256] = "";
    gethostname(name, sizeof name - 1);
    std::string machine = std::string(name).substr(0, kLongest);
    for (char& c : machine)
      if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
    return kPrefix + machine + "-";
  }();
  return prefix;
}

fs::path temporaryName(const fs::path& file) {
  return file.parent_path() / (prefixOfMachine() + std::to_string(getpid()) + "-" + file.filename().string());
}

// Whether this is the temporary name of a process of this machine that has ended.
bool isLeftover(const std::string& name) {
  const std::string& prefix = prefixOfMachine();
  if (!name.starts_with(prefix)) return false;
  pid_t process = 0;
  const char* end = name.data() + name.size();
  const auto [after, error] = std::from_chars(name.data() + prefix.size(), end, process);
  return error == std::errc() && after != end && *after == '-' && process > 0 && kill(process, 0) != 0 &&
         errno == ESRCH;
}

template <typename Which>
void removeFrom(const fs::path& folder, const Which& which) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (which(entry.path().filename().string())) fs::remove_all(entry.path(), error);
}

// Once a folder: while this process writes there, nobody else is likely to be killed there.
void clearLeftovers(const fs::path& folder) {
  static std::mutex mutex;
  static std::set<fs::path> cleared;
  const std::lock_guard lock(mutex);
  if (cleared.insert(fs::absolute(folder)).second) removeFrom(folder, isLeftover);
}

[[noreturn]] void fail(const fs::path& file, const char* what) {
  throw std::system_error(errno, std::generic_category(), file.string() + ": " + what);
}

void flush(const fs::path& path) {
  const int descriptor = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW);
  if (descriptor < 0) fail(path, "cannot open to flush");
  const bool flushed = fsync(descriptor) == 0;
  close(descriptor);
  if (!flushed) fail(path, "cannot flush");
}

fs::path folderOf(const fs::path& path) {
  return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

// Does the work that makes the temporary path and takes it away, and removes what is left of it if that
// throws.
void guarded(const fs::path& temporary, const std::function<void()>& work) {
  try {
    work();
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(temporary, ignored);
    throw;
  }
}

}  // namespace

void writeAtomically(const fs::path& file, const std::function<void(const fs::path&)>& write) {
  fs::create_directories(folderOf(file));
  clearLeftovers(folderOf(file));
  const fs::path temporary = temporaryName(file);
  fs::remove_all(temporary);  // of an earlier process with this number
  guarded(temporary, [&] {
    write(temporary);
    flush(temporary);
    fs::rename(temporary, file);
  });
  flush(folderOf(file));
}

void writeFolderAtomically(const fs::path& folder, const std::function<void(const fs::path&)>& write) {
  fs::create_directories(folderOf(folder));
  clearLeftovers(folderOf(folder));
  const fs::path temporary = temporaryName(folder);
  fs::remove_all(temporary);
  fs::create_directory(temporary);
  guarded(temporary, [&] {
    write(temporary);
    for (const auto& entry : fs::directory_iterator(temporary)) flush(entry.path());
    flush(temporary);
    removeFolderAtomically(folder);
    fs::rename(temporary, folder);
  });
  flush(folderOf(folder));
}

void removeFolderAtomically(const fs::path& folder) {
  if (!fs::exists(fs::symlink_status(folder))) return;
  clearLeftovers(folderOf(folder));
  const fs::path removed = temporaryName(folder.parent_path() / ("old-" + folder.filename().string()));
  fs::remove_all(removed);
  fs::rename(folder, removed);
  fs::remove_all(removed);
}

void writeBytes(const fs::path& file, std::string_view bytes) {
  std::ofstream out(file, std::ios::binary);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) fail(file, "cannot write");
}

void writeTextAtomically(const fs::path& file, std::string_view text) {
  writeAtomically(file, [&](const fs::path& temporary) { writeBytes(temporary, text); });
}

void withTemporaryFolder(const fs::path& folder, const std::string& name,
                         const std::function<void(const fs::path&)>& work) {
  fs::create_directories(folder);
  clearLeftovers(folder);
  const fs::path temporary = temporaryName(folder / name);
  fs::remove_all(temporary);
  guarded(temporary, [&] {
    fs::create_directory(temporary);
    work(temporary);
  });
  fs::remove_all(temporary);
}

void removeTemporaries(const fs::path& folder) {
  removeFrom(folder, [](const std::string& name) { return name.starts_with(kPrefix); });
}

}  // namespace fluidtex::tools
