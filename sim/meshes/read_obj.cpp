// Wavefront, "Object files (.obj)", Advanced Visualizer manual, appendix B1.
#include "sim/meshes/mesh_formats.h"
#include "sim/meshes/text_scan.h"

#include <utility>

namespace fluidtex::sim {
namespace {

[[noreturn]] void fail(std::size_t line, const std::string& what) {
  throw std::runtime_error("line " + std::to_string(line) + ": " + what);
}

// Whether a line continues in the next one; removes the mark of that.
bool goesOn(std::string_view& line) {
  const std::size_t last = line.find_last_not_of(" \t");
  if (last == std::string_view::npos || line[last] != '\\') return false;
  line = line.substr(0, last);
  return true;
}

class Reader {
 public:
  explicit Reader(SoupUv* uv) : m_uv(uv) {}

  MeshSoup read(std::string_view text) {
    text = withoutMark(text);
    while (!text.empty()) {
      ++m_line;
      std::string_view line = takeLine(text);
      std::string_view rest = line;
      const std::string keyword = inLowerCase(takeWord(rest));
      const bool isFace = keyword == "f" || keyword == "fo";
      if (keyword == "surf" || keyword == "curv" || keyword == "curv2")
        fail(m_line,
             "holds a free-form surface (" + keyword + "); only faces (f) can be read: export polygons");
      // Of others than vertices and faces nothing counts, and a comment or a folder's name may end with
      // a backslash too.
      const bool isPlace = m_uv != nullptr && keyword == "vt";
      if (keyword != "v" && !isFace && !isPlace) continue;
      const std::size_t first = m_line;
      std::string joined;
      if (goesOn(rest)) {
        bool more = true;
        while (more) {
          joined.append(rest).append(" ");
          more = !text.empty();
          if (!more) break;
          rest = takeLine(text);
          ++m_line;
          more = goesOn(rest);
        }
        joined.append(rest);
        rest = joined;
      }
      isFace ? addFace(rest, first) : isPlace ? addPlace(rest, first) : addVertex(rest, first);
    }
    const auto count = static_cast<long long>(m_soup.points.size());
    if (m_highest >= count)
      fail(m_highestAt, "a face names vertex " + std::to_string(m_highest + 1) + ", but there are " +
                            std::to_string(count));
    if (m_uv != nullptr) checkPlaces();
    return std::move(m_soup);
  }

 private:
  void addVertex(std::string_view words, std::size_t line) {
    Vec3d x;
    for (int a = 0; a < 3; ++a) {
      const std::string_view word = takeWord(words);
      if (word.empty()) fail(line, "a vertex needs three numbers");
      if (!parseNumber(word, x[a])) fail(line, inQuotes(word) + " is not a number");
    }
    m_soup.points.push_back(x);
  }

  // v is 0 where it is left out, of a texture along a line.
  void addPlace(std::string_view words, std::size_t line) {
    openvdb::Vec2d place(0.0, 0.0);
    for (int a = 0; a < 2; ++a) {
      const std::string_view word = takeWord(words);
      if (word.empty() && a == 0) fail(line, "a texture coordinate needs a number");
      if (word.empty() || word.starts_with('#')) break;
      if (!parseNumber(word, place[a]) || !std::isfinite(place[a]))
        fail(line, inQuotes(word) + " is not a finite number");
    }
    m_uv->places.push_back(place);
  }

  // The second number of a corner, v/vt or v/vt/vn; kNone where there is none.
  std::size_t placeOf(std::string_view word, std::size_t line) const {
    const std::size_t slash = word.find('/');
    if (slash == word.npos) return SoupUv::kNone;
    const std::string_view rest = word.substr(slash + 1), number = rest.substr(0, rest.find('/'));
    if (number.empty()) return SoupUv::kNone;
    long long index = 0;
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), index);
    const auto count = static_cast<long long>(m_uv->places.size());
    if (error != std::errc() || end != number.data() + number.size() || index == 0 || index < -count)
      fail(line, inQuotes(word) + " names no texture coordinate");
    return static_cast<std::size_t>(index > 0 ? index - 1 : count + index);
  }

  // They may stand behind the faces.
  void checkPlaces() const {
    for (std::size_t n = 0; n < m_uv->corners.size(); ++n)
      for (const std::size_t place : m_uv->corners[n])
        if (place != SoupUv::kNone && place >= m_uv->places.size())
          throw std::runtime_error("face " + std::to_string(n + 1) + " names texture coordinate " +
                                   std::to_string(place + 1) + ", but there are " +
                                   std::to_string(m_uv->places.size()));
  }

  // Corners are v, v/vt, v//vn or v/vt/vn; from 1 on, or from the last vertex so far, -1, backwards.
  void addFace(std::string_view words, std::size_t line) {
    std::vector<std::size_t> polygon, places;
    for (std::string_view word = takeWord(words); !word.empty(); word = takeWord(words)) {
      if (word.starts_with('#')) break;
      const std::string_view number = word.substr(0, word.find('/'));
      long long index = 0;
      const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), index);
      if (number.empty() || error != std::errc() || end != number.data() + number.size())
        fail(line, inQuotes(word) + " is no corner of a face: a whole number is needed");
      const auto count = static_cast<long long>(m_soup.points.size());
      if (index == 0) fail(line, "a face names vertex 0; they are counted from 1");
      if (index < -count)
        fail(line, "a face names vertex " + std::to_string(index) + ", but there are " +
                       std::to_string(count) + " before it");
      index = index > 0 ? index - 1 : count + index;
      if (index > m_highest) {
        m_highest = index;
        m_highestAt = line;
      }
      polygon.push_back(static_cast<std::size_t>(index));
      if (m_uv != nullptr) places.push_back(placeOf(word, line));
    }
    if (polygon.empty()) fail(line, "a face without corners");
    // One corner or two bound nothing: some programs write loose edges so.
    if (polygon.size() < 3) return;
    m_soup.polygons.push_back(std::move(polygon));
    if (m_uv != nullptr) m_uv->corners.push_back(std::move(places));
  }

  MeshSoup m_soup;
  SoupUv* m_uv;
  std::size_t m_line = 0, m_highestAt = 0;
  long long m_highest = -1;
};

}  // namespace

MeshSoup soupOfObj(std::string_view text, SoupUv* uv) {
  return Reader(uv).read(text);
}

}  // namespace fluidtex::sim
