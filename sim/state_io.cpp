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
  openvdb::io::File vdb(file.string());
  vdb.open(false);
  const auto metadata = vdb.getMetadata();
  State state;
  try {
    state.frame = metadata->metaValue<std::int32_t>("frame");
    state.time = metadata->metaValue<double>("time");
    for (const char digit : metadata->metaValue<std::string>("poured")) state.poured.push_back(digit == '1');
  } catch (const openvdb::LookupError&) {
    throw openvdb::IoError(file.string() + " holds no state of the solver");
  }
  FloatGrid::Ptr* grids[4] = {&state.phi, &state.u, &state.v, &state.w};
  for (int n = 0; n < 4; ++n) {
    if (!vdb.hasGrid(kGridNames[n])) throw openvdb::IoError(file.string() + " has no grid " + kGridNames[n]);
    *grids[n] = openvdb::gridPtrCast<FloatGrid>(vdb.readGrid(kGridNames[n]));
    if (!*grids[n]) throw openvdb::IoError(file.string() + ": grid " + kGridNames[n] + " is not of floats");
  }
  vdb.close();
  return state;
}

}  // namespace fluidtex::sim
