// Fans where they suffice, else ear clipping: Meisters, "Polygons have ears", 1975. CGAL's triangulation
// takes no polygon that touches itself, as those with holes do, whose rims are joined by a slit.
#include "sim/meshes/cut_polygon.h"

#include "sim/meshes/closed_surface.h"

#include <cmath>

namespace fluidtex::sim {

namespace {

using Triangles = std::vector<std::array<std::size_t, 3>>;

// A place in the plane that the polygon is laid into.
struct Place {
  double x = 0.0, y = 0.0;
  bool operator==(const Place&) const = default;
};

double turn(const Place& a, const Place& b, const Place& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Along the axis that it faces most, so that it is counter-clockwise.
std::vector<Place> laidFlat(const std::vector<Vec3d>& x) {
  Vec3d normal(0.0);
  for (std::size_t i = 0; i < x.size(); ++i) normal += (x[i] - x[0]).cross(x[(i + 1) % x.size()] - x[0]);
  int axis = 0;
  for (int a = 1; a < 3; ++a)
    if (std::abs(normal[a]) > std::abs(normal[axis])) axis = a;
  const int s = (axis + 1) % 3, t = (axis + 2) % 3;
  std::vector<Place> flat;
  flat.reserve(x.size());
  for (const Vec3d& p : x) flat.push_back(normal[axis] > 0.0 ? Place{p[s], p[t]} : Place{p[t], p[s]});
  return flat;
}

// What is left of a polygon.
class Ears {
 public:
  explicit Ears(std::vector<Place> places) : m_places(std::move(places)) {
    for (std::size_t i = 0; i < m_places.size(); ++i) m_left.push_back(i);
  }

  Triangles cut() {
    Triangles triangles;
    std::size_t at = 0;
    while (m_left.size() > 3) {
      const std::size_t ear = next(at);
      triangles.push_back({before(ear), m_left[ear], behind(ear)});
      m_left.erase(m_left.begin() + std::ptrdiff_t(ear));
      // The next corner may have become an ear; continuing there avoids a fan of slivers.
      at = ear < m_left.size() ? ear : 0;
    }
    triangles.push_back({m_left[0], m_left[1], m_left[2]});
    return triangles;
  }

 private:
  std::size_t before(std::size_t i) const { return m_left[(i + m_left.size() - 1) % m_left.size()]; }
  std::size_t behind(std::size_t i) const { return m_left[(i + 1) % m_left.size()]; }
  double turnAt(std::size_t i) const {
    return turn(m_places[before(i)], m_places[m_left[i]], m_places[behind(i)]);
  }

  // The first ear from a corner on; where there is none, a straight corner, or else any.
  std::size_t next(std::size_t from) const {
    std::size_t second = from;
    double flattest = kForever;
    for (std::size_t n = 0; n < m_left.size(); ++n) {
      const std::size_t i = (from + n) % m_left.size();
      const double turned = turnAt(i);
      if (turned > 0.0 && isEmpty(i)) return i;
      if (std::abs(turned) < flattest) {
        flattest = std::abs(turned);
        second = i;
      }
    }
    return second;
  }

  // Whether no other corner lies in the triangle at one; those at its own corners' places aside.
  bool isEmpty(std::size_t i) const {
    const Place &a = m_places[before(i)], &b = m_places[m_left[i]], &c = m_places[behind(i)];
    for (const std::size_t other : m_left) {
      const Place& p = m_places[other];
      if (p == a || p == b || p == c) continue;
      if (turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0) return false;
    }
    return true;
  }

  std::vector<Place> m_places;
  std::vector<std::size_t> m_left;
};

}  // namespace

Triangles cutPolygon(const std::vector<Vec3d>& points, const std::vector<std::size_t>& corners) {
  const std::size_t n = corners.size();
  if (n == 3) return {{corners[0], corners[1], corners[2]}};
  std::vector<Vec3d> x;
  x.reserve(n);
  for (const std::size_t corner : corners) x.push_back(points[corner]);
  const Fan fan = bestFan(x);
  constexpr std::size_t kMost = 8192;  // the search for ears takes the square of it
  Triangles triangles;
  if (n > 4 && n <= kMost && !fan.isWhole) {
    triangles = Ears(laidFlat(x)).cut();
  } else {
    for (std::size_t i = 1; i + 1 < n; ++i)
      triangles.push_back({fan.start, (fan.start + i) % n, (fan.start + i + 1) % n});
  }
  for (auto& triangle : triangles)
    for (std::size_t& corner : triangle) corner = corners[corner];
  return triangles;
}

}  // namespace fluidtex::sim
