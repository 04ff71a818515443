#include "foreign/grid_file.h"

#include <openvdb/util/Name.h>

#include <cmath>
#include <cstdint>
#include <ios>

namespace fluidtex::foreign::here {
namespace {

using openvdb::Vec3d;

constexpr std::size_t kBuffer = 1 << 20;  // bytes

template <class Grid, class... Others>
bool isTypeOf(const std::string& type) {
  if (type == Grid::gridType()) return true;
  if constexpr (sizeof...(Others) > 0) return isTypeOf<Others...>(type);
  return false;
}

bool isReal(const std::string& type) {
  return isTypeOf<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Vec3SGrid, openvdb::Vec3DGrid>(type);
}

bool isScalar(const std::string& type) {
  return isTypeOf<openvdb::FloatGrid, openvdb::DoubleGrid, openvdb::Int32Grid, openvdb::Int64Grid,
                  openvdb::BoolGrid>(type);
}

bool isVector(const std::string& type) {
  return isTypeOf<openvdb::Vec3SGrid, openvdb::Vec3DGrid, openvdb::Vec3IGrid>(type);
}

// Nothing where it is not, or leads nowhere.
std::optional<std::array<double, 16>> affine(const openvdb::math::Transform& transform) {
  if (!transform.isLinear() || !isUsable(transform)) return std::nullopt;
  const openvdb::math::MapBase& map = *transform.baseMap();
  std::array<double, 16> matrix{};
  for (int column = 0; column < 4; ++column) {
    const Vec3d unit(column == 0, column == 1, column == 2);
    const Vec3d values = column == 3 ? map.applyMap(unit) : map.applyJacobian(unit);
    for (int row = 0; row < 3; ++row) matrix[std::size_t(4 * row + column)] = values[row];
  }
  matrix[15] = 1.0;
  return matrix;
}

}  // namespace

bool isUsable(const openvdb::math::Transform& transform) {
  for (const Vec3d& index : {Vec3d(0.0), Vec3d(1.0, 2.0, 3.0), Vec3d(-3.0, 1.0, 2.0)}) {
    const Vec3d world = transform.indexToWorld(index), back = transform.worldToIndex(world);
    for (int axis = 0; axis < 3; ++axis)
      if (!std::isfinite(world[axis]) || !(std::abs(back[axis] - index[axis]) < 1e-3)) return false;
  }
  return true;
}

GridFile::GridFile(const std::filesystem::path& file)
    : m_file(file), m_buffer(std::make_unique<char[]>(kBuffer)) {
  m_in.rdbuf()->pubsetbuf(m_buffer.get(), kBuffer);
  m_in.open(file, std::ios::binary);
  if (!m_in) throw Unreadable("is no OpenVDB file that can be read: it cannot be opened");
  m_in.exceptions(std::ios::failbit | std::ios::badbit);
  readHeader(m_in);
  openvdb::io::setStreamMetadataPtr(m_in, m_metadata);
  setFormatVersion(m_in);
  setLibraryVersion(m_in);
  setDataCompression(m_in);
  openvdb::MetaMap().readMeta(m_in);
  m_left = readGridCount(m_in);
}

// As the library reads it, which stops at types that it does not know.
bool GridFile::next() {
  if (m_inside) skipVoxels();
  if (m_left <= 0) return false;
  --m_left;
  const std::string uniqueName = openvdb::readString(m_in);
  std::string type = openvdb::readString(m_in);
  m_head = {};
  m_head.type = type;
  const std::string halfFloat = "_HalfFloat";
  const bool isHalf = type.ends_with(halfFloat);
  if (isHalf) type.resize(type.size() - halfFloat.size());
  m_descriptor = openvdb::io::GridDescriptor(uniqueName, type, isHalf);
  m_head.half = isHalf && isReal(type);  // which is said of whole numbers too
  if (openvdb::io::getFormatVersion(m_in) >= openvdb::OPENVDB_FILE_VERSION_GRID_INSTANCING)
    m_descriptor.setInstanceParentName(openvdb::readString(m_in));
  std::int64_t places[3] = {};
  m_in.read(reinterpret_cast<char*>(places), sizeof places);
  m_descriptor.setGridPos(places[0]);
  m_descriptor.setBlockPos(places[1]);
  m_descriptor.setEndPos(places[2]);
  if (inputHasGridOffsets()) {
    if (places[2] <= m_in.tellg())
      throw Unreadable("is no OpenVDB file that can be read: it is damaged");  // and would never end
    m_descriptor.seekToGrid(m_in);
  }
  m_begin = m_in.tellg();
  m_inside = true;
  readHead();
  return true;
}

void GridFile::readHead() {
  m_head.name = m_descriptor.gridName();
  m_head.vectors = isVector(type());
  readGridCompression(m_in);
  openvdb::MetaMap notes;
  notes.readMeta(m_in);
  using openvdb::GridBase;
  const auto kind = notes.getMetadata<openvdb::StringMetadata>(GridBase::META_GRID_CLASS);
  m_head.gridClass = GridBase::gridClassToString(kind != nullptr ? GridBase::stringToGridClass(kind->value())
                                                                 : openvdb::GRID_UNKNOWN);
  const auto count = notes.getMetadata<openvdb::Int64Metadata>(GridBase::META_FILE_VOXEL_COUNT);
  if (count != nullptr) m_head.activeVoxels = count->value();
  try {
    if (openvdb::io::getFormatVersion(m_in) < openvdb::OPENVDB_FILE_VERSION_GRID_INSTANCING) {
      if (GridBase::isRegistered(type())) GridBase::createGrid(type())->readTopology(m_in);
    }
    openvdb::math::Transform transform;
    transform.read(m_in);
    m_head.transform = affine(transform);
  } catch (const openvdb::Exception&) {
    // Of an unknown kind, or one whose inverse the library looks for and does not find.
  }
  m_head.readable = m_head.transform && (m_head.vectors || isScalar(type()));
}

void GridFile::skipVoxels() {
  m_inside = false;
  if (inputHasGridOffsets())
    m_descriptor.seekToEnd(m_in);
  else if (openvdb::GridBase::isRegistered(type()))
    read();
  else
    m_left = 0;
}

openvdb::GridBase::Ptr GridFile::read() {
  openvdb::GridBase::Ptr grid = openvdb::GridBase::createGrid(type());
  grid->setSaveFloatAsHalf(m_descriptor.saveFloatAsHalf());
  m_in.seekg(m_begin);
  readGrid(grid, m_descriptor, m_in);
  m_inside = inputHasGridOffsets();
  if (isInstance()) {
    GridFile again(m_file);
    bool found = false;
    while (!found && again.next())
      found = again.m_descriptor.uniqueName() == m_descriptor.instanceParentName() && !again.isInstance();
    if (!found) throw Unreadable("is no OpenVDB file that can be read: it is damaged");
    grid->setTree(again.read()->baseTreePtr());  // which throws where it is of another type
  }
  grid->setName(m_head.name);
  return grid;
}

}  // namespace fluidtex::foreign::here
