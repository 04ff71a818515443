#include "caches/layouts/nothing_here.h"

#include "caches/formats/read_geometry.h"

#include <algorithm>
#include <system_error>
#include <vector>

namespace fluidtex::caches {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t kNamed = 3;  // of folders below

std::vector<fs::path> entriesOf(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
    if (!entry->path().filename().string().starts_with(".")) entries.push_back(entry->path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

// As far as names tell; no file is read.
bool looksLikeCache(const fs::path& folder) {
  const std::vector<fs::path> entries = entriesOf(folder);
  return std::any_of(entries.begin(), entries.end(), [](const fs::path& entry) {
    const std::string name = entry.filename().string();
    std::error_code unknown;
    if (fs::is_directory(entry, unknown)) return name == "config" || name == "bakefiles";
    return name == "cache.json" || entry.extension() == ".vdb" || isGeometryFile(entry);
  });
}

}  // namespace

std::string nothingHere(const fs::path& folder) {
  std::vector<std::string> caches;
  std::string unread;
  for (const fs::path& entry : entriesOf(folder)) {
    std::error_code unknown;
    if (fs::is_directory(entry, unknown)) {
      if (looksLikeCache(entry)) caches.push_back(entry.filename().string());
    } else if (const std::string advice = adviceFor(entry); unread.empty() && !advice.empty()) {
      unread = entry.string() + ": " + advice;
    }
  }
  if (!caches.empty()) {
    std::string names;
    for (std::size_t n = 0; n < std::min(caches.size(), kNamed); ++n)
      names += (n == 0 ? "" : ", ") + caches[n];
    if (caches.size() > kNamed) names += " and others";
    return folder.string() + ": is no cache, but holds folders that may be (" + names +
           "); give one of them, as " + (folder / caches.front()).string();
  }
  if (!unread.empty()) return unread;
  return folder.string() +
         ": holds nothing that can be read as a liquid; give Blender's or FLIP Fluids' cache folder, or a "
         "folder of numbered files: .vdb, .ply, .obj, .stl, .vtp, .vtk, .bobj, .bgeo";
}

}  // namespace fluidtex::caches
