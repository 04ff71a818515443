#include "tools/stress_scenes/random_scene.h"

#include "tools/stress_scenes/dice.h"
#include "tools/stress_scenes/scene_text.h"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <numbers>

namespace fluidtex::stress {
namespace {

constexpr int kFrames = 20;
constexpr double kGravity = 9.81;
// Of all scenes: those whose shapes lie on quarters of cells, as people place them.
constexpr double kAligned = 0.2;

class Writer {
 public:
  Writer(std::uint64_t seed, int number) : m_random(seed, number) {
    const double across = std::array{0.2, 1.0, 1.0, 1.0, 5.0}[m_random.whole(0, 4)];
    const int cells = m_random.whole(24, 32);
    m_h = across / cells;
    const bool even = m_random.chance(0.5);  // sides of a whole number of cells
    const int longest = m_random.whole(0, 2);
    for (int a = 0; a < 3; ++a) {
      const double share = m_random.number(0.45, 1.0);
      m_size[a] = a == longest ? across : (even ? std::round(share * cells) * m_h : share * across);
    }
    m_frameRate = std::round(24.0 / std::sqrt(across));
    m_speed = std::sqrt(kGravity * m_size[2]);
    m_aligned = Dice(~seed, number).chance(kAligned);
    m_still = m_random.chance(0.3);
    m_parts.push_back(fmt::format(
        "# Scene {} of seed {}.\nframes = {}\nframe_rate = {}\ndomain.size = [{:.9g}, {:.9g}, {:.9g}]\n"
        "domain.resolution = {}\ntexture.exemplar = \"{}/green_scales.png\"\ntexture.points = 2000\n",
        number, seed, kFrames, m_frameRate, m_size[0], m_size[1], m_size[2], cells, FLUIDTEX_EXEMPLARS));
    settings();
    walls();
    if (m_still) {
      still();
    } else {
      const int kind = m_random.whole(0, 9);
      if (kind < 2) movers();
      if (kind == 2 || kind == 3) flows();
      if (kind > 3) comings();
      fixtures(m_random.whole(kind < 4 ? 0 : 1, kind < 4 ? 1 : 3));
      liquids(m_random.whole(1, kind < 2 ? 1 : 3), kind < 2);
    }
  }

  SceneParts take() { return std::move(m_parts); }

 private:
  double end() const { return (kFrames - 1) / m_frameRate; }
  void key(const std::string& name, const std::string& value) {
    m_parts.push_back(fmt::format("{} = {}\n", name, value));
  }
  void table(const std::string& name, const std::string& content) {
    m_parts.push_back(fmt::format("\n[[{}]]\n{}\n", name, content));
  }

  // On the nearest quarter of a cell where the scene's shapes lie on these: on faces and centres exactly.
  double placed(double x) const { return m_aligned ? 0.25 * std::round(4.0 * x / m_h) * m_h : x; }
  Vec3d placed(const Vec3d& x) const { return {placed(x[0]), placed(x[1]), placed(x[2])}; }
  // Where a pool ends that leaves no gap at that far side, even when it is placed.
  double beyondSide(int axis) const { return m_size[axis] + (m_aligned ? 0.125 * m_h : 0.0); }
  double sized(double x) const { return m_aligned ? std::max(placed(x), 0.5 * m_h) : x; }
  std::string box(const Vec3d& low, const Vec3d& high) const {
    if (!m_aligned) return stress::box(low, high);
    const Vec3d from = placed(low), least = from + Vec3d(0.5 * m_h), to = placed(high);
    return stress::box(from, openvdb::math::maxComponent(to, least));
  }
  std::string sphere(const Vec3d& center, double radius) const {
    return stress::sphere(placed(center), sized(radius));
  }
  std::string cylinder(const Vec3d& from, const Vec3d& to, double radius) const {
    return stress::cylinder(placed(from), placed(to), sized(radius));
  }

  void settings() {
    if (m_random.chance(0.6)) key("fluid.viscosity", text(m_random.power(1e-3, 1e6)));
    double density = 1000.0;
    if (m_random.chance(0.3)) key("fluid.density", text(density = m_random.power(1.0, 1e4)));
    if (m_random.chance(0.2)) {
      // So that a frame takes up to eight steps.
      const double dt = 1.0 / m_frameRate / m_random.whole(1, 8);
      key("fluid.surface_tension",
          text(density * m_h * m_h * m_h / (4.0 * std::numbers::pi * dt * dt) / 2.0));
    }
    const Vec3d upright(0.0, 0.0, -kGravity);
    Vec3d gravity = upright;
    if (!m_still && m_random.chance(0.1)) gravity = m_random.direction() * kGravity;
    if (!m_still && m_random.chance(0.05)) gravity = Vec3d(0.0);
    if (gravity != upright) key("fluid.gravity", text(gravity));
    if (m_random.chance(0.3)) key("simulation.cfl", text(m_random.number(0.5, 4.0)));
    if (m_random.chance(0.2)) {
      key("heat.simulate", "true");
      key("heat.emissivity", text(m_random.number(0.0, 1.0)));
      key("heat.ambient", text(m_random.number(250.0, 2000.0)));
      if (m_random.chance(0.5)) key("heat.wall_transfer", text(m_random.power(1.0, 1e4)));
      if (m_random.chance(0.7)) {
        key("heat.law", "\"exponential\"");
        key("heat.slope", text(m_random.number(0.0, 0.05)));
        if (m_random.chance(0.5)) key("heat.solidus", text(m_random.number(300.0, 1200.0)));
      }
    }
    if (m_still || m_random.chance(0.6)) return;
    static constexpr const char* kSides[] = {"x_low", "x_high", "y_low", "y_high", "z_high", "z_low"};
    static constexpr const char* kKinds[] = {"open", "stream", "symmetry", "unbounded"};
    for (const char* side : kSides) {
      if (m_random.chance(side == kSides[5] ? 0.15 : 0.4))
        key(std::string("domain.sides.") + side, fmt::format("\"{}\"", kKinds[m_random.whole(0, 3)]));
    }
  }

  // The keys of a wall.
  std::string surface() {
    const int kind = m_random.whole(0, 3);
    if (kind == 1) return "wall = \"no_slip\"\n";
    if (kind == 2)
      return fmt::format("wall = \"friction\"\nslip_length = {}\n", text(m_h * m_random.power(0.01, 10.0)));
    return "";
  }

  void walls() {
    if (const std::string wall = surface(); !wall.empty()) table("wall", wall);
    if (!m_still && m_random.chance(0.1))
      table("wall", fmt::format("face = \"z_low\"\nwall = \"no_slip\"\nwall_velocity = {}",
                                text(Vec3d(m_random.number(-m_speed, m_speed), 0.0, 0.0))));
  }

  std::string simpleShape(const Vec3d& low, const Vec3d& high) {
    const Vec3d middle = m_random.inBox(low, high), extent = high - low;
    const double radius = m_random.number(0.12, 0.3) * std::min({extent[0], extent[1], extent[2]});
    const int kind = m_random.whole(0, 2);
    if (kind == 0) return sphere(middle, radius);
    if (kind == 1)
      return cylinder(middle - m_random.direction() * radius, middle + m_random.direction() * 2.0 * radius,
                      radius);
    const Vec3d half = m_random.inBox(extent * 0.08, extent * 0.3);
    return box(middle - half, middle + half);
  }

  std::string shape(const Vec3d& low, const Vec3d& high) {
    if (m_random.chance(0.6)) return simpleShape(low, high);
    const std::string one = simpleShape(low, high), other = simpleShape(low, high);
    return joined(m_random.chance(0.5) ? "union" : "difference", {one, other});
  }

  // Thickness of a wall; around something of that size there is room left within.
  double thick() { return m_random.number(0.5, 4.0) * m_h; }
  double thick(const Vec3d& outer) {
    return std::min(thick(), 0.25 * std::min({outer[0], outer[1], outer[2]}));
  }

  // Up to that height of an open box or cylinder; liquid may reach into its walls.
  void cup(bool full) {
    const Vec3d outer(m_random.number(0.35, 0.8) * m_size[0], m_random.number(0.35, 0.8) * m_size[1],
                      m_random.number(0.4, 0.75) * m_size[2]);
    const double wall = thick(outer), deep = std::max(wall, thick(outer));
    const Vec3d low = m_random.inBox(Vec3d(0.0), Vec3d(m_size) - outer), high = low + outer;
    const bool onFloor = m_random.chance(0.5);
    const Vec3d foot(low[0], low[1], onFloor ? -m_h : low[2]);
    const Vec3d inside = low + Vec3d(wall, wall, deep), rim(high[0] - wall, high[1] - wall, high[2]);
    const double level = inside[2] + m_random.number(0.3, 0.85) * (high[2] - inside[2]);
    const double into = m_random.chance(0.5) ? 0.5 * wall : 0.0;
    if (m_random.chance(0.7)) {
      table("solid", joined("difference", {box(foot, high), box(inside, rim + Vec3d(0.0, 0.0, m_h))}) + "\n" +
                         surface());
      if (full) table("liquid", box(inside - Vec3d(into), {rim[0] + into, rim[1] + into, level}));
      return;
    }
    const Vec3d middle = 0.5 * (low + high);
    const double radius = 0.5 * std::min(outer[0], outer[1]);
    const auto at = [&](double z) { return Vec3d(middle[0], middle[1], z); };
    table("solid", joined("difference", {cylinder(at(foot[2]), at(high[2]), radius),
                                         cylinder(at(inside[2]), at(high[2] + m_h), radius - wall)}) +
                       "\n" + surface());
    if (full) table("liquid", cylinder(at(inside[2] - into), at(level), radius - wall + into));
  }

  // A box that is shut, with liquid in it.
  void shut(bool full) {
    const Vec3d outer(m_random.number(0.4, 0.8) * m_size[0], m_random.number(0.4, 0.8) * m_size[1],
                      m_random.number(0.4, 0.8) * m_size[2]);
    const double wall = thick(outer);
    const Vec3d low = m_random.inBox(Vec3d(0.0), Vec3d(m_size) - outer), high = low + outer;
    const Vec3d inside = low + Vec3d(wall), top = high - Vec3d(wall);
    table("solid", joined("difference", {box(low, high), box(inside, top)}) + "\n" + surface());
    if (full)
      table("liquid",
            box(inside, {top[0], top[1], inside[2] + m_random.number(0.2, 0.8) * (top[2] - inside[2])}));
  }

  // A wall across the whole domain, as one or as several that touch.
  void divider(bool full) {
    const int axis = m_random.whole(0, 1), boards = m_random.chance(0.3) ? m_random.whole(2, 4) : 1;
    const double wall = thick(), at = m_random.number(0.35, 0.65) * m_size[axis],
                 height = m_random.number(0.6, 1.1);
    Vec3d low(-m_h), high = Vec3d(m_size) + Vec3d(m_h);
    low[axis] = at - 0.5 * wall;
    high[axis] = at + 0.5 * wall;
    high[2] = height * m_size[2];
    for (int n = 0; n < boards; ++n) {
      Vec3d from = low, to = high;
      const int along = 1 - axis;
      from[along] = low[along] + (high[along] - low[along]) * n / boards;
      to[along] = low[along] + (high[along] - low[along]) * (n + 1) / boards;
      table("solid", box(from, to) + "\n" + surface());
    }
    if (!full) return;
    Vec3d end(beyondSide(0), beyondSide(1), 0.0);
    end[axis] = at - (m_random.chance(0.5) ? 0.0 : 0.5 * wall);
    end[2] = m_random.number(0.3, 0.8) * std::min(height, 1.0) * m_size[2];
    table("liquid", box(Vec3d(0.0), end));
  }

  // A plate across the domain with holes.
  void sieve() {
    const double z = m_random.number(0.25, 0.6) * m_size[2], wall = thick();
    std::string parts = "{ " + box({-m_h, -m_h, z}, {m_size[0] + m_h, m_size[1] + m_h, z + wall}) + " }";
    for (int n = m_random.whole(1, 4); n > 0; --n) {
      const Vec3d hole = m_random.inBox(Vec3d(0.0), m_size);
      parts += ", { " +
               cylinder({hole[0], hole[1], z - m_h}, {hole[0], hole[1], z + wall + m_h},
                        m_random.number(1.0, 4.0) * m_h) +
               " }";
    }
    table("solid", "difference = [" + parts + "]\n" + surface());
  }

  void still() {
    const int kind = m_random.whole(0, 4);
    if (kind == 0) cup(true);
    if (kind == 1) shut(true);
    if (kind == 2) divider(true);
    if (kind > 2) {
      const double level = m_random.number(0.15, 0.7) * m_size[2];
      table("liquid", box(Vec3d(0.0), {beyondSide(0), beyondSide(1), level}));
      for (int n = m_random.whole(0, 2); n > 0; --n)
        table("solid", shape(Vec3d(0.1 * m_size), Vec3d(0.9 * m_size)) + "\n" + surface());
    }
  }

  void fixtures(int count) {
    for (; count > 0; --count) {
      const int kind = m_random.whole(0, 6);
      if (kind == 0) cup(m_random.chance(0.5));
      if (kind == 1) divider(false);
      if (kind == 2) sieve();
      if (kind == 3) shut(m_random.chance(0.5));
      if (kind > 3) table("solid", shape(Vec3d(0.1 * m_size), Vec3d(0.9 * m_size)) + "\n" + surface());
    }
  }

  std::string speed(double share) {
    return "velocity = " + text(m_random.direction() * m_speed * m_random.number(0.0, share));
  }

  void liquids(int count, bool low) {
    for (int n = 0; n < count; ++n) {
      std::string content;
      if (n == 0 && (low || m_random.chance(0.6))) {
        const double level = m_random.number(0.15, 0.45) * m_size[2];
        const double part = low || m_random.chance(0.4) ? 1.0 : m_random.number(0.3, 0.8);
        content = box(Vec3d(0.0), {part * m_size[0], m_size[1], level});
      } else {
        content = shape(Vec3d(0.1 * m_size), Vec3d(0.85 * m_size));
      }
      if (m_random.chance(0.3)) content += '\n' + speed(0.7);
      if (n > 0 && m_random.chance(0.4)) content += "\nfrom = " + text(m_random.number(0.0, end()));
      if (m_random.chance(0.3)) content += "\ntemperature = " + text(m_random.number(300.0, 1800.0));
      table("liquid", content);
    }
  }

  std::string keyframe(double time, const Vec3d& move, double turn) {
    std::string content = "\n[[solid.keyframe]]\ntime = " + text(time);
    if (move != Vec3d(0.0)) content += "\nmove = " + text(move);
    if (turn != 0.0) content += "\nturn = " + text(turn);
    return content;
  }

  void movers() {
    const int kind = m_random.whole(0, 3);
    const double start = m_random.chance(0.5) ? 0.0 : 0.2 * end();
    if (kind == 0) {  // a piston: it leaves the liquid room to rise
      const double wall = thick(), way = m_random.number(0.1, 0.35) * m_size[0];
      table("solid", box(Vec3d(-2.0 * m_h), {wall, m_size[1] + m_h, m_size[2] + m_h}) + "\n" + surface() +
                         keyframe(start, Vec3d(0.0), 0.0) + keyframe(end(), {way, 0.0, 0.0}, 0.0));
    } else if (kind == 1) {  // a paddle
      const Vec3d middle(0.5 * m_size[0], 0.5 * m_size[1], 0.35 * m_size[2]);
      const Vec3d half(0.5 * thick(), 0.25 * m_size[1], 0.25 * m_size[2]);
      table("solid",
            box(middle - half, middle + half) + "\n" + surface() + "pivot = " + text(middle) +
                "\naxis = " + text(m_random.chance(0.5) ? Vec3d(0.0, 0.0, 1.0) : m_random.direction()) +
                keyframe(start, Vec3d(0.0), 0.0) +
                keyframe(end(), Vec3d(0.0), m_random.number(-360.0, 360.0)));
    } else {  // something that is dropped in, or drawn out
      const Vec3d middle(m_random.number(0.3, 0.7) * m_size[0], m_random.number(0.3, 0.7) * m_size[1],
                         0.75 * m_size[2]);
      const double radius = m_random.number(0.1, 0.2) * std::min({m_size[0], m_size[1], m_size[2]});
      const Vec3d down(m_random.number(-0.1, 0.1) * m_size[0], 0.0, -0.45 * m_size[2]);
      const bool out = m_random.chance(0.4);
      table("solid", (m_random.chance(0.5) ? sphere(middle, radius)
                                           : box(middle - Vec3d(radius), middle + Vec3d(radius))) +
                         "\n" + surface() + keyframe(start, out ? down : Vec3d(0.0), 0.0) +
                         keyframe(end(), out ? Vec3d(0.0) : down, 0.0));
    }
  }

  // Solids that appear or vanish.
  void comings() {
    if (m_random.chance(0.7)) return;
    const double time = m_random.number(0.1, 0.8) * end();
    table("solid", simpleShape(Vec3d(0.2 * m_size), Vec3d(0.8 * m_size)) + "\n" + surface() +
                       (m_random.chance(0.5) ? "from = " : "until = ") + text(time));
  }

  void flows() {
    if (m_random.chance(0.7)) {
      const Vec3d middle(m_random.number(0.3, 0.7) * m_size[0], m_random.number(0.3, 0.7) * m_size[1],
                         m_random.number(0.5, 0.8) * m_size[2]);
      const double radius = m_random.number(1.5, 4.0) * m_h;
      std::string content =
          m_random.chance(0.5) ? sphere(middle, radius) : box(middle - Vec3d(radius), middle + Vec3d(radius));
      if (m_random.chance(0.8)) {
        const Vec3d velocity = m_random.chance(0.5)
                                   ? Vec3d(0.0, 0.0, -m_speed * m_random.number(0.1, 0.6))
                                   : m_random.direction() * m_speed * m_random.number(0.1, 0.6);
        content += "\nvelocity = " + text(velocity);
      }
      if (m_random.chance(0.4)) content += "\nfrom = " + text(m_random.number(0.0, 0.4) * end());
      if (m_random.chance(0.4)) content += "\nuntil = " + text(m_random.number(0.5, 1.0) * end());
      if (m_random.chance(0.3)) content += "\ntemperature = " + text(m_random.number(300.0, 1800.0));
      table("source", content);
    }
    if (m_random.chance(0.6)) {
      std::string content =
          simpleShape(Vec3d(0.1 * m_size), Vec3d(0.9 * m_size[0], 0.9 * m_size[1], 0.3 * m_size[2]));
      if (m_random.chance(0.3)) content += "\nfrom = " + text(m_random.number(0.0, 0.5) * end());
      table("drain", content);
    }
  }

  Dice m_random;
  SceneParts m_parts;
  Vec3d m_size;
  double m_h = 0.0, m_frameRate = 24.0, m_speed = 0.0;
  bool m_still = false;    // nothing should move
  bool m_aligned = false;  // to quarters of cells
};

}  // namespace

std::string textOf(const SceneParts& parts) {
  std::string all;
  for (const std::string& part : parts) all += part;
  return all;
}

SceneParts randomScene(std::uint64_t seed, int number) {
  return Writer(seed, number).take();
}

}  // namespace fluidtex::stress
