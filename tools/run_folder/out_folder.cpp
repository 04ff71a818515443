// The lock is flock() on a file in the folder, which the system lets go of however the process ends. The file
// itself says who holds it, and goes when the last one is done; after a kill it stays, and means nothing.
#include "tools/run_folder/out_folder.h"

#include "tools/base/errors.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <system_error>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

constexpr const char* kLock = ".fluidtex-lock";

void make(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error && !fs::is_directory(folder)) error = std::make_error_code(std::errc::not_a_directory);
  if (error)
    throw UsageError(fmt::format("--out {}: is no folder and none can be made there: {}", folder.string(),
                                 error.message()));
}

void refuseLinks(const fs::path& folder) {
  for (const char* name :
       {"frames", "surface", "glb", "obj", "usd", "vtp", "onto", "exemplar", "state", "log.txt"}) {
    const fs::path inside = folder / name;
    std::error_code error;
    if (fs::is_symlink(fs::symlink_status(inside, error)))
      throw UsageError(fmt::format(
          "{}: is a link, and what it leads to would be written or removed; remove the link, or give another "
          "folder with --out",
          inside.string()));
  }
}

// "process 1234", as far as the file says.
std::string holder(int lock) {
  char digits[24] = {};
  const ssize_t count = pread(lock, digits, sizeof digits - 1, 0);
  const long process = count > 0 ? std::strtol(digits, nullptr, 10) : 0;
  return process > 0 ? fmt::format("process {}", process) : "another process";
}

// Whether the name still is that of the open file: its last holder may have removed it meanwhile.
bool bears(const fs::path& name, int descriptor) {
  struct stat open {
  }, named{};
  return fstat(descriptor, &open) == 0 && lstat(name.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
         open.st_ino == named.st_ino;
}

}  // namespace

OutFolder::OutFolder(const fs::path& folder, Holding holding) : m_lock(folder / kLock) {
  make(folder);
  refuseLinks(folder);
  for (;;) {
    m_descriptor = open(m_lock.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_CLOEXEC, 0644);
    if (m_descriptor < 0)
      throw UsageError(fmt::format("{}: cannot be written into: {}", folder.string(), std::strerror(errno)));
    // A file system that knows no locks has to do without.
    if (flock(m_descriptor, (holding == Holding::alone ? LOCK_EX : LOCK_SH) | LOCK_NB) != 0 &&
        errno == EWOULDBLOCK) {
      const std::string other = holder(m_descriptor);
      close(m_descriptor);
      throw UsageError(
          fmt::format("{}: {} is writing into this folder; wait until it is done, or give another folder",
                      folder.string(), other));
    }
    if (bears(m_lock, m_descriptor)) break;
    close(m_descriptor);
  }
  const std::string process = fmt::format("{}\n", getpid());
  // A disk so full that this fails is told of by what is written next.
  if (ftruncate(m_descriptor, 0) != 0 ||
      pwrite(m_descriptor, process.data(), process.size(), 0) != static_cast<ssize_t>(process.size())) {
  }
}

OutFolder::~OutFolder() {
  // While others hold it, the file is theirs.
  if (flock(m_descriptor, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) unlink(m_lock.c_str());
  close(m_descriptor);
}

}  // namespace fluidtex::tools
