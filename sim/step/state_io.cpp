#include "sim/step/state_io.h"

#include "sim/grid/write_grids.h"

#include <openvdb/io/File.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace fluidtex::sim {
namespace {

// Grids of every state; others are there only where the liquid has them.
constexpr std::string_view kAlways[] = {"phi", "u", "v", "w"};

// A block as bytes: origin, number of markers, markers.
void append(std::string& bytes, const MarkerBlock& block) {
  const std::int32_t head[4] = {block.origin[0], block.origin[1], block.origin[2],
                                static_cast<std::int32_t>(block.markers.size())};
  bytes.append(reinterpret_cast<const char*>(head), sizeof head);
  bytes.append(reinterpret_cast<const char*>(block.markers.data()), block.markers.size() * sizeof(Marker));
}

void extract(const std::string& bytes, Markers& markers) {
  for (std::size_t at = 0; at < bytes.size();) {
    std::int32_t head[4];
    if (bytes.size() - at < sizeof head) throw openvdb::ValueError("the markers end early");
    std::memcpy(head, bytes.data() + at, sizeof head);
    at += sizeof head;
    const std::size_t size = static_cast<std::size_t>(head[3]) * sizeof(Marker);
    if (head[3] <= 0 || bytes.size() - at < size) throw openvdb::ValueError("the markers end early");
    markers.push_back({openvdb::Coord(head[0], head[1], head[2]), std::vector<Marker>(head[3])});
    std::memcpy(markers.back().markers.data(), bytes.data() + at, size);
    at += size;
  }
}

// Markers are kept in metadata, in parts: a string there has a length of 32 bits.
constexpr std::size_t kPart = std::size_t{1} << 28;

std::string partName(int part) {
  return "markers" + std::to_string(part);
}

void writeMarkers(const Markers& markers, openvdb::MetaMap& metadata) {
  std::string bytes;
  int part = 0;
  for (std::size_t n = 0; n < markers.size(); ++n) {
    append(bytes, markers[n]);
    if (bytes.size() < kPart && n + 1 < markers.size()) continue;
    metadata.insertMeta(partName(part++), openvdb::StringMetadata(bytes));
    bytes.clear();
  }
  metadata.insertMeta("marker_parts", openvdb::Int32Metadata(part));
}

}  // namespace

void writeState(const State& state, const std::filesystem::path& file) {
  openvdb::GridCPtrVec out;
  forEachGrid(state, [&](const char* name, const FloatGrid::Ptr& from, int) {
    if (from == nullptr) return;
    const auto grid = toOpenVdb(*from);
    grid->setName(name);
    grid->setSaveFloatAsHalf(false);
    out.push_back(grid);
  });
  openvdb::MetaMap metadata;
  metadata.insertMeta("frame", openvdb::Int32Metadata(state.frame));
  metadata.insertMeta("steps", openvdb::Int64Metadata(state.steps));
  metadata.insertMeta("time", openvdb::DoubleMetadata(state.time));
  metadata.insertMeta("leapfrog_offset", openvdb::DoubleMetadata(state.leapfrogOffset));
  std::string poured;
  for (const bool done : state.poured) poured += done ? '1' : '0';
  metadata.insertMeta("poured", openvdb::StringMetadata(poured));
  writeMarkers(state.markers, metadata);

  writeGrids(out, metadata, file);
}

State readState(const std::filesystem::path& file) {
  openvdb::initialize();
  State state;
  try {
    openvdb::io::File vdb(file.string());
    vdb.open(false);
    const auto metadata = vdb.getMetadata();
    state.frame = metadata->metaValue<std::int32_t>("frame");
    state.steps = metadata->metaValue<std::int64_t>("steps");
    state.time = metadata->metaValue<double>("time");
    state.leapfrogOffset = metadata->metaValue<double>("leapfrog_offset");
    for (const char digit : metadata->metaValue<std::string>("poured")) state.poured.push_back(digit == '1');
    for (int part = 0; part < metadata->metaValue<std::int32_t>("marker_parts"); ++part)
      extract(metadata->metaValue<std::string>(partName(part)), state.markers);
    forEachGrid(state, [&](const char* name, FloatGrid::Ptr& to, int) {
      const bool always = std::find(std::begin(kAlways), std::end(kAlways), name) != std::end(kAlways);
      if (!always && !vdb.hasGrid(name)) return;
      const auto grid = openvdb::gridPtrCast<openvdb::FloatGrid>(vdb.readGrid(name));
      if (grid == nullptr) throw openvdb::TypeError(std::string("grid ") + name + " is not of floats");
      to = fromOpenVdb(*grid);
    });
  } catch (const std::exception& error) {
    // A truncated file fails in many ways (no memory, unknown types); for the caller it is one error.
    throw openvdb::IoError(file.string() + " does not hold a state of the solver: " + error.what());
  }
  return state;
}

}  // namespace fluidtex::sim
