// Side Effects Software, "Documentation on the Public Domain Geometry Library (GPD), version 5": all
// big-endian. W. Disney Animation Studios' Partio, which most particle solvers write by, packs it by gzip.
#include "caches/formats/build_geometry.h"
#include "caches/formats/geometry_formats.h"
#include "caches/formats/numbers.h"
#include "sim/meshes/text_scan.h"

namespace fluidtex::caches {

namespace {

struct Column {
  std::string name;
  std::uint16_t components = 0;
  bool isInteger = false, isText = false;
  std::size_t first = 0;  // byte of a row
};

struct Columns {
  std::vector<Column> columns;
  std::size_t rowSize = 0;  // bytes
};

class BgeoReader {
 public:
  explicit BgeoReader(std::string_view bytes) : m_bytes(bytes, std::endian::big) {}

  Geometry read() {
    takeHeader();
    takePoints();
    takePrimitives();
    return std::move(m_geometry);  // of attributes of the whole and groups, which follow, nothing is read
  }

 private:
  void takeHeader() {
    const std::string_view magic = m_bytes.size() < 4 ? std::string_view() : m_bytes.take(4);
    if (magic == "\x7fNSJ")
      throw std::runtime_error(
          "is written in the format of Houdini 12 and later, which is not read; write .ply or .vdb with a "
          "File "
          "Cache or ROP Geometry Output node, or classic geometry with the ending .bhclassic");
    if (magic != "Bgeo" || m_bytes.take<char>() != 'V' || m_bytes.take<std::int32_t>() != 5)
      throw std::runtime_error("is no Houdini geometry: classic .bgeo begins with 'BgeoV' and version 5");
    for (const auto count : {&m_pointCount, &m_primitiveCount, &m_pointGroups, &m_primitiveGroups,
                             &m_pointColumns, &m_vertexColumns, &m_primitiveColumns, &m_otherColumns}) {
      const auto number = m_bytes.take<std::int32_t>();
      if (number < 0)
        throw std::runtime_error("says in its header that it has " + std::to_string(number) +
                                 " of something; counts are 0 or more");
      *count = static_cast<std::uint64_t>(number);
    }
  }

  // What is known of the attributes of a kind before the values.
  Columns takeColumns(std::uint64_t count) {
    Columns of;
    for (std::uint64_t n = 0; n < count; ++n) {
      Column& column = of.columns.emplace_back();
      column.name = m_bytes.take(m_bytes.take<std::uint16_t>());
      column.components = m_bytes.take<std::uint16_t>();
      column.first = of.rowSize;
      // The upper half tells of what an index is one.
      switch (const int type = m_bytes.take<std::int32_t>() & 0xffff; type) {
        case 0:
        case 1:
        case 5:  // floats, integers, vectors of floats; with the value that is nowhere else
          column.isInteger = type == 1;
          m_bytes.take(4 * std::uint64_t(column.components));
          break;
        case 4: {  // numbers of the texts that are listed here
          column.isText = true;
          const auto texts = m_bytes.take<std::int32_t>();
          for (std::int32_t t = 0; t < texts; ++t) m_bytes.take(m_bytes.take<std::uint16_t>());
          break;
        }
        default:
          throw std::runtime_error("its attribute " + sim::inQuotes(column.name) + " is of kind " +
                                   std::to_string(type) +
                                   "; only numbers (0, 1, 5) and indexed texts (4) are read");
      }
      of.rowSize += 4 * std::size_t(column.components);
    }
    return of;
  }

  void takePoints() {
    constexpr std::size_t kPosition = 16;  // x y z w
    const Columns of = takeColumns(m_pointColumns);
    const std::size_t rowSize = kPosition + of.rowSize;
    if (m_pointCount > m_bytes.size() / rowSize)
      throw std::runtime_error("says that it has " + counted(m_pointCount, "point") +
                               ", for which it is too short; write or copy it anew");
    const std::string_view rows = m_bytes.take(m_pointCount * rowSize);
    m_geometry.points.resize(m_pointCount);
    for (std::size_t n = 0; n < m_pointCount; ++n)
      for (int a = 0; a < 3; ++a)
        m_geometry.points[n][a] =
            numberAt<float>(rows.data() + n * rowSize + 4 * std::size_t(a), std::endian::big);
    for (const Column& column : of.columns) {
      if (column.isText || column.components == 0) continue;
      std::vector<float> values(m_pointCount * column.components);
      float* value = values.data();
      for (std::size_t n = 0; n < m_pointCount; ++n) {
        const char* at = rows.data() + n * rowSize + kPosition + column.first;
        for (int c = 0; c < column.components; ++c, at += 4)
          *value++ = column.isInteger ? static_cast<float>(numberAt<std::int32_t>(at, std::endian::big))
                                      : numberAt<float>(at, std::endian::big);
      }
      addAttribute(column.name, column.components, std::move(values), m_geometry);
    }
  }

  void takePrimitives() {
    m_vertexSize = takeColumns(m_vertexColumns).rowSize;
    m_primitiveSize = takeColumns(m_primitiveColumns).rowSize;
    std::uint64_t n = 0;
    while (n < m_primitiveCount) {
      constexpr std::int32_t kRun = -1;  // many of one kind
      std::uint64_t run = 1;
      auto kind = m_bytes.take<std::int32_t>();
      if (kind == kRun) {
        run = m_bytes.take<std::uint16_t>();
        kind = m_bytes.take<std::int32_t>();
      }
      for (; run > 0; --run, ++n) takePrimitive(kind, n);
    }
  }

  void takePrimitive(std::int32_t kind, std::size_t number) {
    constexpr std::int32_t kPolygon = 1, kParticles = 0x8000;
    if (kind != kPolygon && kind != kParticles)
      throw std::runtime_error("primitive " + std::to_string(number + 1) + " is of kind " +
                               std::to_string(kind) +
                               "; only polygons (1) and particles (32768) are read: convert it to polygons");
    const auto vertices = m_bytes.take<std::int32_t>();
    // Particles are the points themselves.
    const bool isFace = kind == kPolygon && takeClosed(number);
    const std::uint64_t indexSize = m_pointCount > 65535 ? 4 : 2;
    const std::uint64_t each = indexSize + m_vertexSize;
    if (vertices < 0 || std::uint64_t(vertices) > m_bytes.size() / each)
      throw std::runtime_error("primitive " + std::to_string(number + 1) + " says that it has " +
                               std::to_string(vertices) + " vertices, for which the file is too short");
    const std::string_view rows = m_bytes.take(std::uint64_t(vertices) * each);
    m_bytes.take(m_primitiveSize);
    if (!isFace) return;
    m_corners.resize(std::size_t(vertices));
    for (std::size_t v = 0; v < m_corners.size(); ++v) {
      const char* at = rows.data() + v * each;
      m_corners[v] = indexSize == 4 ? std::int64_t(numberAt<std::int32_t>(at, std::endian::big))
                                    : std::int64_t(numberAt<std::uint16_t>(at, std::endian::big));
    }
    addPolygon(m_corners, number, m_geometry);
  }

  // Whether a polygon is a face and not an open line.
  bool takeClosed(std::size_t number) {
    const char mark = m_bytes.take<char>();
    if (mark == '<') return true;
    if (mark == ':') return false;
    throw std::runtime_error("polygon " + std::to_string(number + 1) +
                             " is marked as neither closed '<' nor open ':'; write or copy the file anew");
  }

  Bytes m_bytes;
  Geometry m_geometry;
  std::uint64_t m_pointCount = 0, m_primitiveCount = 0, m_pointGroups = 0, m_primitiveGroups = 0,
                m_pointColumns = 0, m_vertexColumns = 0, m_primitiveColumns = 0, m_otherColumns = 0;
  std::size_t m_vertexSize = 0, m_primitiveSize = 0;  // bytes of attributes
  std::vector<std::int64_t> m_corners;
};

}  // namespace

Geometry geometryOfBgeo(std::string_view bytes) {
  return BgeoReader(bytes).read();
}

}  // namespace fluidtex::caches
