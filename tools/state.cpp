#include "tools/state.h"

#include "tools/atomic_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>
#include <system_error>
#include <type_traits>

namespace fluidtex::tools {
namespace fs = std::filesystem;
namespace {

constexpr char kMagic[8] = {'f', 't', 'x', 's', 'u', 'r', 'f', '1'};

// Visits every part of a surface in the one order that both directions share.
template <typename Surface, typename Visit>
void eachPart(Surface& surface, Visit&& visit) {
  visit(surface.spacing);
  visit(surface.exemplarWidth);
  visit(surface.exemplarHeight);
  visit(surface.positions);
  visit(surface.normals);
  visit(surface.orientation);
  visit(surface.triangles);
  visit(surface.color);
  visit(surface.coordinate);
  visit(surface.gradient);
  visit(surface.age);
  visit(surface.trust);
  visit(surface.previousPosition);
  visit(surface.velocity);
  visit(surface.contact);
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
};

struct Reader {
  std::ifstream& in;
  std::uint64_t left;  // bytes of the file not read yet: no size inside the file may ask for more
  const fs::path& file;

  void take(void* target, std::uint64_t bytes) {
    if (bytes > left || !in.read(static_cast<char*>(target), static_cast<std::streamsize>(bytes)))
      throw std::runtime_error(file.string() +
                               ": the file is cut short; remove the state folder to start anew");
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
};

fs::path frameFolder(const fs::path& stateFolder, int frame) {
  std::ostringstream name;
  name.width(4);
  name.fill('0');
  name << frame;
  return stateFolder / name.str();
}

// Number of the frame a folder of states belongs to; -1 for anything else.
int frameOf(const fs::path& folder) {
  const std::string name = folder.filename().string();
  if (name.empty() || name.find_first_not_of("0123456789") != std::string::npos) return -1;
  return std::stoi(name);
}

std::string readText(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw std::runtime_error(file.string() + ": cannot be read; remove the state folder to start anew");
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

void writeSurface(const texture::TexturedSurface& surface, const fs::path& file) {
  std::ofstream out(file, std::ios::binary);
  Writer write{out};
  out.write(kMagic, sizeof kMagic);
  eachPart(surface, write);
  write(std::uint64_t{surface.maps.size()});
  for (const auto& [name, values] : surface.maps) {
    write(name);
    write(values);
  }
  out.close();
  if (!out) throw std::system_error(errno, std::generic_category(), file.string() + ": cannot write");
}

texture::TexturedSurface readSurface(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in)
    throw std::runtime_error(file.string() + ": cannot be read; remove the state folder to start anew");
  Reader read{in, fs::file_size(file), file};
  char magic[sizeof kMagic];
  read.take(magic, sizeof magic);
  if (std::memcmp(magic, kMagic, sizeof magic) != 0)
    throw std::runtime_error(file.string() +
                             ": is no surface of this version; remove the state folder to start anew");
  texture::TexturedSurface surface;
  eachPart(surface, read);
  std::uint64_t maps = 0;
  read(maps);
  for (std::uint64_t i = 0; i < maps; ++i) {
    std::string name;
    read(name);
    read(surface.maps[name]);
  }
  return surface;
}

void saveState(const RunState& state, const fs::path& stateFolder) {
  writeFolderAtomically(frameFolder(stateFolder, state.solver.frame), [&](const fs::path& folder) {
    sim::writeState(state.solver, folder / "solver.vdb");
    writeSurface(state.surface, folder / "surface.bin");
    std::ofstream report(folder / "run.json", std::ios::binary);
    report << state.report;
    report.close();
    if (!report) throw std::system_error(errno, std::generic_category(), folder.string() + ": cannot write");
  });
  for (const auto& entry : fs::directory_iterator(stateFolder)) {
    const int frame = frameOf(entry.path());
    if (frame >= 0 && frame != state.solver.frame) fs::remove_all(entry.path());
  }
}

std::optional<RunState> loadState(const fs::path& stateFolder) {
  fs::path newest;
  std::error_code missing;
  for (const auto& entry : fs::directory_iterator(stateFolder, missing))
    if (frameOf(entry.path()) >= 0 && (newest.empty() || frameOf(newest) < frameOf(entry.path())))
      newest = entry.path();
  if (newest.empty()) return std::nullopt;
  RunState state;
  state.solver = sim::readState(newest / "solver.vdb");
  state.surface = readSurface(newest / "surface.bin");
  state.report = readText(newest / "run.json");
  return state;
}

}  // namespace fluidtex::tools
