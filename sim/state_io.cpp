#include "sim/solver.h"

#include <openvdb/io/File.h>

#include <string>

namespace fluidtex::sim {
namespace {

using openvdb::FloatGrid;

constexpr const char* kGridNames[4] = {"phi", "u", "v", "w"};

}  // namespace

void writeState(const State& state, const std::filesystem::path& file) {
  const FloatGrid::Ptr grids[4] = {state.phi, state.u, state.v, state.w};
  openvdb::GridCPtrVec out;
  for (int n = 0; n < 4; ++n) {
    // A shallow copy: its own name and settings, the same tree.
    const auto grid = grids[n]->copy();
    grid->setName(kGridNames[n]);
    grid->setSaveFloatAsHalf(false);
    out.push_back(grid);
  }
  openvdb::MetaMap metadata;
  metadata.insertMeta("frame", openvdb::Int32Metadata(state.frame));
  metadata.insertMeta("time", openvdb::DoubleMetadata(state.time));
  std::string poured;
  for (const bool done : state.poured) poured += done ? '1' : '0';
  metadata.insertMeta("poured", openvdb::StringMetadata(poured));

  openvdb::initialize();
  openvdb::io::File vdb(file.string());
  vdb.setCompression(openvdb::io::COMPRESS_NONE);
  vdb.write(out, metadata);
  vdb.close();
}

State readState(const std::filesystem::path& file) {
  openvdb::initialize();
  State state;
  try {
    openvdb::io::File vdb(file.string());
    vdb.open(false);
    const auto metadata = vdb.getMetadata();
    state.frame = metadata->metaValue<std::int32_t>("frame");
    state.time = metadata->metaValue<double>("time");
    for (const char digit : metadata->metaValue<std::string>("poured")) state.poured.push_back(digit == '1');
    FloatGrid::Ptr* grids[4] = {&state.phi, &state.u, &state.v, &state.w};
    for (int n = 0; n < 4; ++n) {
      *grids[n] = openvdb::gridPtrCast<FloatGrid>(vdb.readGrid(kGridNames[n]));
      if (!*grids[n]) throw openvdb::TypeError(std::string("grid ") + kGridNames[n] + " is not of floats");
    }
  } catch (const std::exception& error) {
    // A file cut short fails in many ways (no memory, unknown types); for the caller it is one.
    throw openvdb::IoError(file.string() + " does not hold a state of the solver: " + error.what());
  }
  return state;
}

}  // namespace fluidtex::sim
