#include "tests/caches/liquid/cache_files.h"

#include "tests/caches/liquid/geometry_bytes.h"

#include <fmt/core.h>

namespace fluidtex::caches {
namespace {

namespace fs = std::filesystem;
using openvdb::Coord;
using openvdb::Mat3d;
using openvdb::Mat4d;
using openvdb::Vec3f;
using openvdb::Vec3I;
using openvdb::Vec3s;
using Transform = openvdb::math::Transform;

// Voxels beyond the ball that hold velocities, and half width of level sets.
constexpr int kVelocityReach = 6, kHalfWidth = 3;
// How a file's numbers lie in the world: world = origin + unit * (x axes[0] + y axes[1] + z axes[2]).
struct Axes {
  Vec3d axes[3]{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  double unit = 1.0;
  Vec3d origin{0.0};

  Vec3d toWorld(const Vec3d& x) const {
    return origin + unit * (x[0] * axes[0] + x[1] * axes[1] + x[2] * axes[2]);
  }
  Vec3d vectorToFile(const Vec3d& v) const {
    return Vec3d(v.dot(axes[0]), v.dot(axes[1]), v.dot(axes[2])) / unit;
  }
  Vec3d toFile(const Vec3d& x) const { return vectorToFile(x - origin); }
};

// x to the right, y up, z to the viewer; millimetres.
Axes yUp() {
  Axes axes;
  axes.axes[1] = Vec3d(0, 0, 1);
  axes.axes[2] = Vec3d(0, -1, 0);
  axes.unit = 0.001;
  return axes;
}

// Turned about z by 30 degrees around the middle of the scene.
Axes turnedDomain() {
  Axes axes;
  const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
  axes.axes[0] = Vec3d(c, s, 0);
  axes.axes[1] = Vec3d(-s, c, 0);
  axes.origin = Vec3d(0.5);
  return axes;
}

struct Place {
  Axes axes;
  Transform::Ptr transform;

  Vec3d worldAt(const Vec3d& index) const { return axes.toWorld(transform->indexToWorld(index)); }
};

Place cubes(const Axes& axes, double h) {
  return {axes, Transform::createLinearTransform(h / axes.unit)};
}

// Calls visit(coord) for all voxels within `reach` voxels of the ball.
template <class Visit>
void around(const Place& place, const Ball& ball, double h, int reach, const Visit& visit) {
  const Vec3d middle = place.transform->worldToIndex(place.axes.toFile(ball.center));
  const int n = int(ball.radius / h) + reach + 1;
  const Coord c = Coord::round(middle);
  for (int i = -n; i <= n; ++i)
    for (int j = -n; j <= n; ++j)
      for (int k = -n; k <= n; ++k) visit(c.offsetBy(i, j, k));
}

openvdb::FloatGrid::Ptr levelSet(const Place& place, const Ball& ball, double h) {
  const double band = kHalfWidth * h;
  const openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(float(band / place.axes.unit));
  grid->setTransform(place.transform);
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setName("surface");
  auto to = grid->getAccessor();
  around(place, ball, h, kHalfWidth + 1, [&](const Coord& at) {
    const double d = ball.distance(place.worldAt(at.asVec3d()));
    if (std::abs(d) < band)
      to.setValue(at, float(d / place.axes.unit));
    else if (d < 0.0)
      to.setValueOff(at, float(-band / place.axes.unit));
  });
  return grid;
}

openvdb::FloatGrid::Ptr density(const Place& place, const Ball& ball, double h) {
  const openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(0.0f);
  grid->setTransform(place.transform);
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  grid->setName("density");
  around(place, ball, h, kHalfWidth, [&](const Coord& at) {
    const double d = ball.distance(place.worldAt(at.asVec3d()));
    if (const double value = std::clamp(0.5 - 0.25 * d / h, 0.0, 1.0); value > 0.0)
      grid->tree().setValue(at, float(value));
  });
  return grid;
}

openvdb::Vec3SGrid::Ptr velocityVectors(const Place& place, const Clip& clip, int frame, bool onFaces) {
  const Ball ball = clip.at(frame);
  const openvdb::Vec3SGrid::Ptr grid = openvdb::Vec3SGrid::create(Vec3s(0.0f));
  grid->setTransform(place.transform);
  grid->setName("vel");
  if (onFaces) grid->setGridClass(openvdb::GRID_STAGGERED);
  auto to = grid->getAccessor();
  around(place, ball, clip.h, kVelocityReach, [&](const Coord& at) {
    if (ball.distance(place.worldAt(at.asVec3d())) > kVelocityReach * clip.h) return;
    Vec3d v;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3d index = at.asVec3d();
      if (onFaces) index[axis] -= 0.5;
      v[axis] = place.axes.vectorToFile(clip.flow.velocity(place.worldAt(index), clip.time(frame)))[axis];
    }
    to.setValue(at, Vec3s(clip.velocityScale * v));
  });
  return grid;
}

openvdb::FloatGrid::Ptr component(const openvdb::Vec3SGrid& vectors, int axis, const std::string& name) {
  const openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(0.0f);
  grid->setTransform(vectors.transform().copy());
  grid->setName(name);
  for (auto value = vectors.cbeginValueOn(); value; ++value)
    grid->tree().setValue(value.getCoord(), (*value)[axis]);
  return grid;
}

void writeGrids(const fs::path& file, const openvdb::GridCPtrVec& grids) {
  openvdb::initialize();
  fs::create_directories(file.parent_path());
  openvdb::io::File(file.string()).write(grids);
}

fs::path numbered(const fs::path& folder, const char* before, int frame, const char* after) {
  return folder / fmt::format("{}{:04}{}", before, frame, after);
}

// A mesh as fine as the grids.
constexpr int kHalvings = 4;

struct Mesh {
  std::vector<Vec3d> points, velocities;
  std::vector<Vec3I> triangles;
};

Mesh meshOf(const Axes& axes, const Clip& clip, int frame) {
  Mesh mesh;
  ballMesh(clip.at(frame), kHalvings, mesh.points, mesh.triangles);
  for (Vec3d& x : mesh.points) {
    mesh.velocities.push_back(clip.velocityScale *
                              axes.vectorToFile(clip.flow.velocity(x, clip.time(frame))));
    x = axes.toFile(x);
  }
  return mesh;
}

// A domain of Blender's liquid around the scene, of cells of side h.
struct Domain {
  Axes axes;
  Coord resolution;

  int longest() const { return std::max({resolution[0], resolution[1], resolution[2]}); }
  // Index space is that of the centres of cells; a metre is 1 / h cells.
  Place cells(double h) const {
    Axes place = axes;
    place.unit = h;
    const Transform::Ptr transform = Transform::createLinearTransform(1.0);
    transform->postTranslate(Vec3d(0.5) - 0.5 * resolution.asVec3d());
    return {place, transform};
  }
};

std::string configBytes(const Domain& domain, const Clip& clip, int frame) {
  std::string bytes;
  const std::vector<double> cells{double(domain.resolution[0]), double(domain.resolution[1]),
                                  double(domain.resolution[2])};
  put(bytes, std::int32_t(0));
  bytes += bytesOf<std::int32_t>(cells);
  const double frameTime = 0.1 * 25.0 / clip.frameRate;
  bytes += bytesOf<float>({1.0 / domain.longest(), frameTime, -1, -1, -1, 1, 1, 1, 0, 0, 0});
  bytes += bytesOf<std::int32_t>({0, 0, 0});
  bytes += bytesOf<float>({0, 0, 0});
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3d column = domain.axes.axes[axis] * (0.5 * clip.h * cells[std::size_t(axis)]);
    bytes += bytesOf<float>({column[0], column[1], column[2], 0});
  }
  bytes += bytesOf<float>({domain.axes.origin[0], domain.axes.origin[1], domain.axes.origin[2], 1});
  bytes += bytesOf<std::int32_t>(cells) + bytesOf<std::int32_t>({0, 0, 0}) + bytesOf<std::int32_t>(cells);
  bytes += bytesOf<float>({0, 0, 0, (frame - 1) * frameTime});
  return bytes + "C01" + std::string(1, '\0');
}

void writeMantaflow(const Domain& domain, const Clip& clip, bool asMesh, const fs::path& folder) {
  const Place place = domain.cells(clip.h);
  for (int frame = 1; frame <= clip.frames; ++frame) {
    writeBytes(numbered(folder / "config", "config_", frame, ".uni"),
               gzipped(configBytes(domain, clip, frame)));
    const openvdb::Vec3SGrid::Ptr velocity = velocityVectors(place, clip, frame, true);
    // In cells a unit of the solver's time, of which a second has 2.5, whatever the frame rate.
    for (auto value = velocity->beginValueOn(); value; ++value) value.setValue(*value / 2.5f);
    // What the file says of its place is not the world's.
    velocity->setTransform(Transform::createLinearTransform(1.0 / domain.longest()));
    velocity->setName("velocity");
    openvdb::GridCPtrVec grids{velocity};
    if (asMesh) {
      velocity->setSaveFloatAsHalf(true);
      Axes axes = domain.axes;
      axes.unit = clip.h * domain.longest();
      const Mesh mesh = meshOf(axes, clip, frame);
      writeBytes(numbered(folder / "mesh", "fluid_mesh_", frame, ".bobj.gz"),
                 gzipped(bobjBytes(mesh.points, mesh.triangles, true)));
    } else {
      const openvdb::FloatGrid::Ptr phi = openvdb::FloatGrid::create(0.0f), wall = phi->deepCopy();
      for (const openvdb::FloatGrid::Ptr& grid : {phi, wall}) grid->setGridClass(openvdb::GRID_LEVEL_SET);
      phi->setName("phi");
      wall->setName("phi_obstacle");
      const openvdb::CoordBBox box(Coord(0), domain.resolution.offsetBy(-1));
      wall->denseFill(box, 5.0f, true);
      for (auto at = box.begin(); at; ++at) {
        const double d = clip.at(frame).distance(place.worldAt((*at).asVec3d())) / clip.h;
        phi->tree().setValue(*at, float(std::clamp(d, -7.0, 5.0)));
      }
      grids.push_back(phi);
      grids.push_back(wall);
    }
    writeGrids(numbered(folder / "data", "fluid_data_", frame, ".vdb"), grids);
  }
}

void writeFlipFluids(const Clip& clip, const fs::path& folder) {
  constexpr double kSimulationUnit = 2.5;  // metres
  for (int frame = 1; frame <= clip.frames; ++frame) {
    const Mesh mesh = meshOf({}, clip, frame);
    const auto write = [&](const char* name, const std::string& bytes) {
      writeBytes(folder / "bakefiles" / fmt::format("{}{:06}.bobj", name, frame), bytes);
    };
    write("", bobjBytes(mesh.points, mesh.triangles, false));
    const auto vectors = [&](double factor) {
      return withCount(mesh.points.size(), bytesOf<float>(numbersOf(mesh.velocities, factor))) +
             withCount(0, "");
    };
    write("velocity", vectors(1.0 / kSimulationUnit));
    write("blur", vectors(1.0 / clip.frameRate));
  }
}

// Particles a cell apart that move as if they were frozen into the flow.
void writeParticles(const Clip& clip, const fs::path& folder) {
  const std::vector<Vec3d> first = latticeIn(clip.ball, clip.h);
  for (int frame = 1; frame <= clip.frames; ++frame) {
    std::vector<Vec3d> points, velocities;
    for (const Vec3d& x : first) {
      points.push_back(clip.flow.moved(x, clip.time(frame)));
      velocities.push_back(clip.velocityScale * clip.flow.velocity(points.back(), clip.time(frame)));
    }
    writeBytes(folder / fmt::format("ParticleData_Fluid_{}.vtk", frame), vtkBytes(points, velocities));
  }
}

void writeVolumes(Way way, const Place& place, const Clip& clip, const fs::path& folder) {
  for (int frame = 1; frame <= clip.frames; ++frame) {
    const bool onFaces = way == Way::staggered || way == Way::yUpMillimeters;
    const openvdb::Vec3SGrid::Ptr velocity = velocityVectors(place, clip, frame, onFaces);
    openvdb::GridCPtrVec grids{way == Way::fog ? density(place, clip.at(frame), clip.h)
                                               : levelSet(place, clip.at(frame), clip.h)};
    if (way == Way::collocated) velocity->setSaveFloatAsHalf(true);
    if (way == Way::threeGrids) {
      for (int axis = 0; axis < 3; ++axis)
        grids.push_back(component(*velocity, axis, std::string("vel.") + "xyz"[axis]));
    } else {
      grids.push_back(velocity);
    }
    writeGrids(numbered(folder, "water_", frame, ".vdb"), grids);
  }
}

void writeMeshes(Way way, const Axes& axes, const Clip& clip, const fs::path& folder) {
  for (int frame = 1; frame <= clip.frames; ++frame) {
    Mesh mesh = meshOf(axes, clip, frame);
    if (way == Way::plyAndGrids) {
      mesh.velocities.clear();
      writeGrids(numbered(folder, "velocity_", frame, ".vdb"),
                 {velocityVectors(cubes(axes, clip.h), clip, frame, true)});
    }
    writeBytes(numbered(folder, "water.", frame, ".ply"),
               plyBytes(mesh.points, mesh.triangles, mesh.velocities));
  }
}

}  // namespace

std::string nameOf(Way way) {
  constexpr const char* kNames[] = {
      "staggered",  "collocated", "threeGrids",  "fog",           "turned",           "yUpMillimeters",
      "ply",        "plyYUp",     "plyAndGrids", "mantaflowMesh", "mantaflowAligned", "mantaflowGrids",
      "flipFluids", "vtk"};
  return kNames[std::size_t(way)];
}

void writeBytes(const fs::path& file, const std::string& bytes) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << bytes;
}

CacheFiles writeCache(Way way, const Clip& clip, const fs::path& folder) {
  openvdb::initialize();
  CacheFiles files;
  files.options.path = folder;
  switch (way) {
    case Way::staggered:
    case Way::collocated:
    case Way::threeGrids:
    case Way::fog:
      writeVolumes(way, cubes({}, clip.h), clip, folder);
      break;
    case Way::turned: {
      Place place;
      place.axes.unit = files.options.unit = 0.1;
      const auto transform = Transform::createLinearTransform(clip.h / 0.1);
      transform->postRotate(0.5, openvdb::math::X_AXIS);
      transform->postRotate(0.3, openvdb::math::Z_AXIS);
      transform->postTranslate(Vec3d(0.123, 0.456, 0.789));
      place.transform = transform;
      writeVolumes(way, place, clip, folder);
      break;
    }
    case Way::yUpMillimeters:
      writeVolumes(way, cubes(yUp(), clip.h), clip, folder);
      files.options.up = UpAxis::y;
      files.options.unit = 0.001;
      break;
    case Way::ply:
    case Way::plyAndGrids:
      writeMeshes(way, {}, clip, folder);
      break;
    case Way::plyYUp:
      writeMeshes(way, yUp(), clip, folder);
      files.options.up = UpAxis::y;
      files.options.unit = 0.001;
      break;
    case Way::mantaflowMesh:
      writeMantaflow({turnedDomain(), Coord(44, 36, 40)}, clip, true, folder);
      break;
    case Way::mantaflowAligned:
    case Way::mantaflowGrids: {
      Axes axes;
      axes.origin = Vec3d(0.5);
      writeMantaflow({axes, Coord(34, 36, 40)}, clip, way == Way::mantaflowAligned, folder);
      break;
    }
    case Way::flipFluids:
      writeFlipFluids(clip, folder);
      break;
    case Way::vtk:
      writeParticles(clip, folder);
      files.accuracy = 0.5;
      break;
  }
  return files;
}

}  // namespace fluidtex::caches
