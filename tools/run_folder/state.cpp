#include "tools/run_folder/state.h"

#include "render/frame_name.h"
#include "sim/step/state_io.h"
#include "texture/vertex_arrays.h"
#include "tools/base/atomic_file.h"
#include "tools/base/fingerprint.h"
#include "tools/run_folder/journal.h"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <system_error>
#include <type_traits>
#include <vector>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

constexpr char kMagic[8] = {'f', 't', 'x', 's', 'u', 'r', 'f', '6'};

constexpr const char* kSolver = "solver.vdb";
constexpr const char* kSurface = "surface.bin";
constexpr const char* kReport = "run.json";
constexpr const char* kManifest = "manifest.txt";

[[noreturn]] void refuse(const fs::path& file, const std::string& what) {
  throw std::runtime_error(file.string() + ": " + what + "; remove the state folder to start anew");
}

// Visits every part of a surface in the one order that both directions share.
template <typename Surface, typename Visit>
void eachPart(Surface& surface, Visit&& visit) {
  visit(surface.spacing);
  visit(surface.exemplarWidth);
  visit(surface.exemplarHeight);
  visit(surface.triangles);
  const auto array = [&](auto& values, texture::Array) { visit(values); };
  texture::forEachMeshArray(surface, array);
  texture::forEachTextureArray(surface, array);
  visit(surface.velocity);
  visit(surface.contact);
  visit(surface.maps);
  visit(surface.vectors);
}

struct Writer {
  std::ofstream& out;
  template <typename T>
  void operator()(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    out.write(reinterpret_cast<const char*>(&value), sizeof(T));
  }
  template <typename T>
  void operator()(const std::vector<T>& values) {
    (*this)(std::uint64_t{values.size()});
    out.write(reinterpret_cast<const char*>(values.data()),
              static_cast<std::streamsize>(values.size() * sizeof(T)));
  }
  void operator()(const std::string& text) { (*this)(std::vector<char>(text.begin(), text.end())); }
  template <typename T>
  void operator()(const std::map<std::string, T>& named) {
    (*this)(std::uint64_t{named.size()});
    for (const auto& [name, values] : named) {
      (*this)(name);
      (*this)(values);
    }
  }
};

struct Reader {
  std::ifstream& in;
  std::uint64_t left;  // bytes of the file not read yet: no size inside the file may ask for more
  const fs::path& file;

  void take(void* target, std::uint64_t bytes) {
    if (bytes > left || !in.read(static_cast<char*>(target), static_cast<std::streamsize>(bytes)))
      refuse(file, "the file is cut short");
    left -= bytes;
  }
  template <typename T>
  void operator()(T& value) {
    take(&value, sizeof(T));
  }
  template <typename T>
  void operator()(std::vector<T>& values) {
    std::uint64_t count = 0;
    (*this)(count);
    if (count > left / sizeof(T)) take(nullptr, left + 1);
    values.resize(count);
    take(values.data(), count * sizeof(T));
  }
  void operator()(std::string& text) {
    std::vector<char> characters;
    (*this)(characters);
    text.assign(characters.begin(), characters.end());
  }
  template <typename T>
  void operator()(std::map<std::string, T>& named) {
    std::uint64_t count = 0;
    (*this)(count);
    for (std::uint64_t i = 0; i < count; ++i) {
      std::string name;
      (*this)(name);
      (*this)(named[name]);
    }
  }
};

// Whether every array has a value for each vertex and every corner of a triangle is a vertex.
bool fitsTogether(const texture::TexturedSurface& surface) {
  const std::size_t count = surface.positions.size();
  bool fitting = true;
  texture::forEachVertexArray(surface, [&](const auto& values, texture::Array array) {
    fitting = fitting && texture::fits(values, array, count);
  });
  return fitting && std::all_of(surface.triangles.begin(), surface.triangles.end(),
                                [&](const auto& t) { return t[0] < count && t[1] < count && t[2] < count; });
}

// A state's frame; nothing for anything else that lies in the folder of states.
std::optional<int> frameOf(const fs::path& folder) {
  return render::frameNumber(folder.filename().string());
}

std::ifstream opened(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) refuse(file, "cannot be read");
  return in;
}

std::string readText(const fs::path& file) {
  std::ifstream in = opened(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A line of the manifest: name, size in bytes, hash.
std::string manifestLine(const fs::path& file) {
  if (!fs::is_regular_file(file)) refuse(file, "cannot be read");
  const Fingerprint content = fingerprintOf(file);
  return fmt::format("{} {} {}\n", file.filename().string(), content.bytes, content.hash);
}

std::string manifestOf(const fs::path& folder) {
  std::string lines;
  for (const char* name : {kSolver, kSurface, kReport}) lines += manifestLine(folder / name);
  return lines;
}

// Refuses a state whose files are not those that were written.
void checkFiles(const fs::path& folder) {
  const std::string lines = readText(folder / kManifest);
  for (const char* name : {kSolver, kSurface, kReport})
    if (lines.find(manifestLine(folder / name)) == std::string::npos)
      refuse(folder / name, "is damaged: not the size or the content that was written");
}

void removeStatesBut(std::optional<int> kept, const fs::path& stateFolder) {
  std::vector<fs::path> old;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(stateFolder, missing))
    if (const std::optional<int> frame = frameOf(entry.path()); frame && frame != kept)
      old.push_back(entry.path());
  for (const fs::path& folder : old) removeFolderAtomically(folder);
}

}  // namespace

void writeSurface(const texture::TexturedSurface& surface, const fs::path& file) {
  std::vector<char> buffer(std::size_t{1} << 20);
  std::ofstream out;
  out.rdbuf()->pubsetbuf(buffer.data(), static_cast<std::streamsize>(buffer.size()));
  out.open(file, std::ios::binary);
  Writer write{out};
  out.write(kMagic, sizeof kMagic);
  eachPart(surface, write);
  out.close();
  if (!out) throw std::system_error(errno, std::generic_category(), file.string() + ": cannot write");
}

texture::TexturedSurface readSurface(const fs::path& file) {
  std::ifstream in = opened(file);
  Reader read{in, fs::file_size(file), file};
  char magic[sizeof kMagic];
  read.take(magic, sizeof magic);
  if (std::memcmp(magic, kMagic, sizeof magic) != 0) refuse(file, "is no surface of this version");
  texture::TexturedSurface surface;
  eachPart(surface, read);
  if (read.left > 0) refuse(file, "goes on after its end");
  if (!fitsTogether(surface)) refuse(file, "is damaged: its arrays and triangles do not fit together");
  return surface;
}

void saveState(const sim::State& solver, const texture::TexturedSurface& surface, const std::string& report,
               const fs::path& stateFolder) {
  writeFolderAtomically(stateFolder / render::frameName(solver.frame), [&](const fs::path& folder) {
    sim::writeState(solver, folder / kSolver);
    writeSurface(surface, folder / kSurface);
    writeBytes(folder / kReport, report);
    writeBytes(folder / kManifest, manifestOf(folder));
  });
  removeStatesBut(solver.frame, stateFolder);
}

std::optional<RunState> loadState(const fs::path& stateFolder) {
  std::optional<int> newest;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(stateFolder, missing))
    newest = std::max(newest, frameOf(entry.path()));
  if (!newest) return std::nullopt;
  const fs::path folder = stateFolder / render::frameName(*newest);
  checkFiles(folder);
  RunState state;
  state.solver = sim::readState(folder / kSolver);
  state.surface = readSurface(folder / kSurface);
  state.report = readText(folder / kReport);
  return state;
}

void removeStates(const fs::path& stateFolder) {
  removeStatesBut(std::nullopt, stateFolder);
  removeJournal(stateFolder);
  std::error_code notEmpty;
  fs::remove(stateFolder, notEmpty);
}

}  // namespace fluidtex::tools
