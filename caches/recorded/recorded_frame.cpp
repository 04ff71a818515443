#include "caches/recorded/recorded_frame.h"

#include "caches/layouts/numbered_files.h"
#include "caches/recorded/recorded_sight.h"
#include "sim/grid/mac_grid.h"
#include "sim/grid/write_grids.h"

#include <openvdb/io/File.h>

#include <array>
#include <string>

namespace fluidtex::caches {
namespace {

using sim::FloatGrid;

constexpr std::array kFaces{"u.", "v.", "w."};
constexpr const char* kSurface = "surface";
constexpr const char* kSolid = "solid";
constexpr const char* kField = "field ";  // before a field's name

std::array<FloatGrid::ConstPtr, 3> facesOf(const sim::Substep& substep) {
  return {substep.u, substep.v, substep.w};
}

void add(const openvdb::FloatGrid::ConstPtr& grid, const std::string& name, openvdb::GridCPtrVec& grids) {
  // A grid of the same tree under a name of its own.
  const openvdb::FloatGrid::Ptr named = openvdb::FloatGrid::create(*grid);
  named->setTree(std::const_pointer_cast<openvdb::FloatTree>(grid->constTreePtr()));
  named->setName(name);
  named->setSaveFloatAsHalf(false);
  grids.push_back(named);
}

openvdb::MetaMap metadataOf(const sim::Frame& frame, double h) {
  openvdb::MetaMap metadata;
  metadata.insertMeta("fluidtex_frame", openvdb::Int32Metadata(frame.index));
  metadata.insertMeta("time", openvdb::DoubleMetadata(frame.time));
  metadata.insertMeta("voxel", openvdb::DoubleMetadata(h));
  metadata.insertMeta("substeps", openvdb::Int32Metadata(int(frame.substeps.size())));
  for (std::size_t n = 0; n < frame.substeps.size(); ++n)
    metadata.insertMeta("dt." + std::to_string(n), openvdb::DoubleMetadata(frame.substeps[n].dt));
  const sim::FrameStats& stats = frame.stats;
  metadata.insertMeta("dt_min", openvdb::DoubleMetadata(stats.dtMin));
  metadata.insertMeta("cells", openvdb::Int64Metadata(stats.cells));
  metadata.insertMeta("volume", openvdb::DoubleMetadata(stats.volume));
  metadata.insertMeta("deficit", openvdb::DoubleMetadata(stats.deficit));
  metadata.insertMeta("pressure_iterations", openvdb::Int32Metadata(stats.pressureIterations));
  metadata.insertMeta("viscosity_iterations", openvdb::Int32Metadata(stats.viscosityIterations));
  metadata.insertMeta("pressure_residual", openvdb::DoubleMetadata(stats.pressureResidual));
  return metadata;
}

sim::Frame frameOf(openvdb::io::File& vdb) {
  const openvdb::MetaMap::Ptr metadata = vdb.getMetadata();
  const auto number = [&](const std::string& name) { return metadata->metaValue<double>(name); };
  const double h = number("voxel");
  // Reading a transform can change its last bits.
  const auto grid = [&](const std::string& name) {
    auto read = openvdb::gridPtrCast<openvdb::FloatGrid>(vdb.readGrid(name));
    if (!read) throw openvdb::TypeError("grid " + name + " is not of floats");
    return read;
  };
  const auto centred = [&](const std::string& name) {
    FloatGrid::Ptr result = sim::fromOpenVdb(*grid(name));
    result->setTransform(sim::cellTransform(h));
    return result;
  };
  sim::Frame frame;
  frame.index = metadata->metaValue<std::int32_t>("fluidtex_frame");
  frame.time = number("time");
  const openvdb::FloatGrid::Ptr surface = grid(kSurface);
  surface->setTransform(sim::cellTransform(h));
  frame.surfacePhi = surface;
  if (vdb.hasGrid(kSolid)) frame.solidPhi = centred(kSolid);
  for (int n = 0; n < metadata->metaValue<std::int32_t>("substeps"); ++n) {
    std::array<FloatGrid::Ptr, 3> faces;
    for (int axis = 0; axis < 3; ++axis) {
      faces[axis] = sim::fromOpenVdb(*grid(kFaces[axis] + std::to_string(n)));
      faces[axis]->setTransform(sim::faceTransform(h, axis));
    }
    frame.substeps.push_back({number("dt." + std::to_string(n)), faces[0], faces[1], faces[2]});
  }
  readSight(vdb, frame.substeps);
  for (auto name = vdb.beginName(); name != vdb.endName(); ++name)
    if ((*name).starts_with(kField))
      frame.fields[(*name).substr(std::string(kField).size())] = centred(*name);
  sim::FrameStats& stats = frame.stats;
  stats.dtMin = number("dt_min");
  stats.cells = metadata->metaValue<std::int64_t>("cells");
  stats.volume = number("volume");
  stats.deficit = number("deficit");
  stats.pressureIterations = metadata->metaValue<std::int32_t>("pressure_iterations");
  stats.viscosityIterations = metadata->metaValue<std::int32_t>("viscosity_iterations");
  stats.pressureResidual = number("pressure_residual");
  return frame;
}

}  // namespace

void writeRecordedFrame(const sim::Frame& frame, double h, const std::filesystem::path& file) {
  openvdb::GridCPtrVec grids;
  add(frame.surfacePhi, kSurface, grids);
  if (frame.solidPhi) add(sim::toOpenVdb(*frame.solidPhi), kSolid, grids);
  for (std::size_t n = 0; n < frame.substeps.size(); ++n) {
    const auto faces = facesOf(frame.substeps[n]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      add(sim::toOpenVdb(*faces[axis]), kFaces[axis] + std::to_string(n), grids);
  }
  for (const auto& [name, field] : frame.fields) add(sim::toOpenVdb(*field), kField + name, grids);
  openvdb::MetaMap metadata = metadataOf(frame, h);
  addSight(frame, grids, metadata);
  sim::writeGrids(grids, metadata, file);
}

sim::Frame readRecordedFrame(const std::filesystem::path& file) {
  openvdb::initialize();
  try {
    openvdb::io::File vdb(file.string());
    vdb.open(false);
    return frameOf(vdb);
  } catch (const std::exception& error) {
    throw LayoutError(file.string() + ": is no frame that `fluidtex simulate` has written (" + error.what() +
                      "); simulate it again");
  }
}

}  // namespace fluidtex::caches
