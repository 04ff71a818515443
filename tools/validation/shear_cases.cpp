// Section C.5 of the reference: shear flows between walls. Nothing in them depends on the pressure, so the
// viscosity kernel is measured alone, in a slab one leaf thick with slippery sides. Ends of a channel are
// walls that move with the exact profile; figures are taken in its middle.
#include "tools/validation/viscous_cases.h"

#include "sim/viscosity/viscosity.h"
#include "tools/validation/order.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace fluidtex::validation {
namespace {

using sim::Coord;
using sim::Vec3d;
using std::numbers::pi;
using Field = std::function<Vec3d(const Vec3d&)>;

// A box full of liquid, its walls moving as given.
class Basin {
 public:
  explicit Basin(const sim::Options& options)
      : m_solid(*sim::Solids(options).at(0.0)),
        m_phi(sim::makePhi(options.voxelSize(), 6 * options.voxelSize())) {
    for (int i = -8; i < m_solid.domain.max()[0] + 9; i += 8) {
      for (int j = -8; j < m_solid.domain.max()[1] + 9; j += 8) {
        for (int k = -8; k < m_solid.domain.max()[2] + 9; k += 8) {
          sim::FloatLeaf* leaf = m_phi->tree().touchLeaf(Coord(i, j, k));
          leaf->fill(-static_cast<float>(options.voxelSize()), true);
        }
      }
    }
    velocity = sim::makeVelocity(options.voxelSize(), m_phi->tree());
  }

  // How the walls' surfaces slide along themselves, and how the solids move as a whole.
  void setWalls(const Field& speed) { m_solid.slide = fieldOf(speed); }
  void setSolids(const Field& speed) { m_solid.speed = fieldOf(speed); }

  void push(double change) {
    for (auto it = velocity.component[0]->beginValueOn(); it; ++it)
      it.setValue(static_cast<float>(*it + change));
  }

  bool apply(double kinematicViscosity, double dt) {
    sim::ViscosityOptions options;
    options.tolerance = 1e-9;
    return sim::applyViscosity(velocity, *m_phi, m_solid, dt, 1.0, {.constant = kinematicViscosity}, options)
        .converged;
  }

  // Calls body(world position, axis, value) at every face in the open.
  void visit(const std::function<void(const Vec3d&, int, double)>& body) const {
    for (int a = 0; a < 3; ++a) {
      for (auto it = velocity.component[a]->cbeginValueOn(); it; ++it) {
        Coord below = it.getCoord();
        below[a] -= 1;
        const double gap = m_solid.phi->tree().getValue(it.getCoord()) + m_solid.phi->tree().getValue(below);
        if (gap > 1e-3 * m_solid.voxelSize) body(velocity.component[a]->indexToWorld(it.getCoord()), a, *it);
      }
    }
  }

  sim::Velocity velocity;

 private:
  sim::Velocity fieldOf(const Field& speed) const {
    sim::Velocity field = sim::makeVelocity(m_solid.voxelSize, m_phi->tree());
    for (int a = 0; a < 3; ++a) {
      for (auto it = field.component[a]->beginValueOn(); it; ++it)
        it.setValue(static_cast<float>(speed(field.component[a]->indexToWorld(it.getCoord()))[a]));
    }
    return field;
  }

  sim::SolidField m_solid;
  sim::FloatGrid::Ptr m_phi;
};

constexpr double kChannelLength = 3.0;

// Walls at y = 0 and 1, ends at x = 0 and kChannelLength.
sim::Options channel(int resolution) {
  sim::Options options;
  options.resolution = static_cast<int>(kChannelLength) * resolution;
  options.size = Vec3d(kChannelLength, 1.0, 8.0 / resolution);
  using sim::DomainFace;
  for (const DomainFace face : {DomainFace::xLow, DomainFace::xHigh, DomainFace::yLow, DomainFace::yHigh})
    options.walls.push_back({face, {.kind = sim::WallKind::noSlip}});
  return options;
}

// Largest error of u in the middle tenth of the channel.
double errorInMiddle(const Basin& basin, const std::function<double(double)>& profile) {
  double largest = 0.0;
  basin.visit([&](const Vec3d& x, int axis, double value) {
    if (axis == 0 && std::abs(x[0] - 0.5 * kChannelLength) < 0.05 * kChannelLength)
      largest = std::max(largest, std::abs(value - profile(x[1])));
  });
  return largest;
}

Field along(const std::function<double(double)>& profile) {
  return [=](const Vec3d& x) { return Vec3d(profile(std::clamp(x[1], 0.0, 1.0)), 0.0, 0.0); };
}

Row failed(const std::string& test, int resolution) {
  return {test, resolution, "solves that did not converge", 1.0, 0.0, {}, false, {}, 0.0};
}

Result poiseuille(int resolution, const Progress&) {
  const auto profile = [](double y) { return 0.5 * y * (1.0 - y); };
  Basin basin(channel(resolution));
  basin.setWalls(along(profile));
  // One step as long as it takes: the flow is steady.
  constexpr double kTime = 1e5;
  basin.push(kTime);
  if (!basin.apply(1.0, kTime)) return {{failed("poiseuille", resolution)}, {}};
  const double exact = 1.0 / (8.0 * resolution * resolution);
  return {{{"poiseuille",
            resolution,
            "error of u, max, m/s",
            errorInMiddle(basin, profile),
            1.02 * exact,
            1e-8,
            false,
            {{exact, "h^2/8; Basilisk has the same"}},
            0.0}},
          {}};
}

Result couetteStart(int resolution, const Progress& progress) {
  const auto profile = [](double t) {
    return [t](double y) {
      double sum = y;
      for (int n = 1; n < 40; ++n) {
        const double k = n * pi;
        sum += 2.0 / k * (n % 2 == 0 ? 1.0 : -1.0) * std::exp(-k * k * t) * std::sin(k * y);
      }
      return sum;
    };
  };
  Basin basin(channel(resolution));
  constexpr double kEnd = 0.05;
  const int steps =
      4 * resolution;  // dt / h^2 grows with the resolution: first order in time, as one substep
  for (int n = 0; n < steps; ++n) {
    basin.setWalls(along(profile(kEnd * (n + 1) / steps)));
    if (!basin.apply(1.0, kEnd / steps)) return {{failed("couette", resolution)}, {}};
    if (progress) progress((n + 1.0) / steps);
  }
  double middle = 0.0, distance = 1.0;
  basin.visit([&](const Vec3d& x, int axis, double value) {
    if (axis != 0 || std::abs(x[0] - 0.5 * kChannelLength) > 0.05) return;
    const double off = std::abs(x[1] - 0.5);
    if (off >= distance) return;
    distance = off;
    middle = value - (profile(kEnd)(x[1]) - profile(kEnd)(0.5));
  });
  return {{{"couette",
            resolution,
            "error of u, max, m/s",
            errorInMiddle(basin, profile(kEnd)),
            {},
            {},
            false,
            {},
            0.0},
           {"couette",
            resolution,
            "u in the middle at 0.05 s, m/s",
            middle,
            {},
            {},
            false,
            {{0.113844, "series"}},
            0.0}},
          {}};
}

// The inner of two cylinders turns; figures of the speed around the axis.
Result cylinders(int resolution, const Progress&) {
  constexpr double kInner = 0.25, kOuter = 0.5;
  const double h = 1.0 / resolution;
  sim::Options options;
  options.size = Vec3d(1.0 + 4.0 * h, 1.0 + 4.0 * h, 8.0 * h);
  options.resolution = resolution + 4;
  const Vec3d middle(0.5 + 2.0 * h, 0.5 + 2.0 * h, 0.0), up(0.0, 0.0, 1.0);
  options.solids.resize(2);
  options.solids[0].shape.kind = sim::Cylinder{middle - up, middle + up, kInner};
  sim::Difference shell;
  shell.parts = {sim::Shape{sim::Box{Vec3d(-1.0), Vec3d(2.0)}},
                 sim::Shape{sim::Cylinder{middle - 2.0 * up, middle + 2.0 * up, kOuter}}};
  options.solids[1].shape.kind = shell;
  for (sim::Solid& solid : options.solids) solid.wall.kind = sim::WallKind::noSlip;
  const auto around = [](double r) { return r / 3.0 * (0.25 / (r * r) - 1.0); };
  const auto exact = [&](const Vec3d& x) {
    const Vec3d r(x[0] - middle[0], x[1] - middle[1], 0.0);
    const double length = std::max(r.length(), 1e-9);
    return up.cross(r / length) * around(std::clamp(length, kInner, kOuter));
  };
  // The inner one turns as a whole.
  const auto solids = [&](const Vec3d& x) {
    const Vec3d r(x[0] - middle[0], x[1] - middle[1], 0.0);
    return r.length() < 0.5 * (kInner + kOuter) ? up.cross(r) : Vec3d(0.0);
  };
  Basin basin(options);
  basin.setSolids(solids);
  if (!basin.apply(1.0, 1e5)) return {{failed("cylinders", resolution)}, {}};
  double sum = 0.0, largest = 0.0;
  int count = 0;
  basin.visit([&](const Vec3d& x, int axis, double value) {
    if (axis == 2) return;
    const double error = std::abs(value - exact(x)[axis]);
    sum += error;
    ++count;
    largest = std::max(largest, error);
  });
  std::vector<Published> mean, most;
  const auto published = [&](double a, double b) {
    mean = {{a, "Basilisk embed, couette"}};
    most = {{b, "Basilisk embed, couette"}};
  };
  if (resolution == 16) published(4.5e-3, 2.3e-2);
  if (resolution == 32) published(1.09e-3, 4.5e-3);
  if (resolution == 64) published(2.6e-4, 1.25e-3);
  if (resolution == 128) published(6.3e-5, 2.9e-4);
  return {{{"cylinders", resolution, "error of u, mean, m/s", sum / count, {}, {}, false, mean, 0.0},
           {"cylinders", resolution, "error of u, max, m/s", largest, {}, {}, false, most, 0.0}},
          {}};
}

}  // namespace

std::vector<Case> shearCases() {
  const auto order = [](const char* measure, std::optional<double> must) {
    return [=](const std::vector<Row>& rows) { return orderRows(rows, measure, must, {}); };
  };
  return {{"poiseuille",
           "viscous",
           "Flow between plates",
           {8, 16, 32, 64},
           {8, 16, 32},
           poiseuille,
           order("error of u, max, m/s", 1.9)},
          {"couette",
           "viscous",
           "A plate begins to move",
           {8, 16, 32, 64},
           {8, 16},
           couetteStart,
           order("error of u, max, m/s", {})},
          {"cylinders",
           "viscous",
           "Flow between a turning and a resting cylinder",
           {16, 32, 64, 128},
           {},
           cylinders,
           order("error of u, mean, m/s", 1.9)}};
}

}  // namespace fluidtex::validation
