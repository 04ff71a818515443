#include "tools/base/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

constexpr const char* kPrefix = ".tmp-";

fs::path temporaryName(const fs::path& file) {
  return file.parent_path() / (kPrefix + file.filename().string());
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
  const fs::path temporary = temporaryName(file);
  fs::remove_all(temporary);
  guarded(temporary, [&] {
    write(temporary);
    flush(temporary);
    fs::rename(temporary, file);
  });
  flush(folderOf(file));
}

void writeFolderAtomically(const fs::path& folder, const std::function<void(const fs::path&)>& write) {
  const fs::path temporary = temporaryName(folder);
  fs::remove_all(temporary);
  fs::create_directories(temporary);
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
  const fs::path removed = folder.parent_path() / (kPrefix + ("old-" + folder.filename().string()));
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

void removeTemporaries(const fs::path& folder) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().filename().string().starts_with(kPrefix)) fs::remove_all(entry.path(), error);
}

}  // namespace fluidtex::tools
