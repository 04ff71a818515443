// Reading of a cache: a frame with its velocities and the motion to it from the last one, and the level set
// of its mesh alone beside OpenVDB's.
#include "caches/liquid/cached_flow.h"
#include "caches/liquid/level_set.h"
#include "caches/liquid/read_frame.h"
#include "caches/liquid/survey.h"
#include "tests/scratch.h"
#include "tools/benchmarks/measure.h"

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/MeshToVolume.h>
#include <zlib.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace fluidtex::benchmarks {
namespace {

namespace fs = std::filesystem;
using caches::SurfaceTriangles;
using openvdb::Coord;
using openvdb::Vec3d;
using openvdb::Vec3f;

constexpr int kFrames = 5;
constexpr double kRate = 24.0;       // frames a second
const Vec3d kDrift(1.3, 0.4, -0.7);  // m/s

// A ball of radius 1 m with waves of several lengths, which drifts: an octahedron, each of whose sides is a
// lattice of `side` triangles an edge.
SurfaceTriangles wavyBall(int side, double time) {
  SurfaceTriangles surface;
  const auto point = [&](const Vec3d& flat) {
    const Vec3d x = flat.unit();
    const double r = 1.0 + 0.05 * std::sin(9.0 * x[0] + 5.0 * x[1]) +
                     0.03 * std::sin(17.0 * x[1] - 11.0 * x[2]) + 0.01 * std::sin(41.0 * x[2] + 29.0 * x[0]);
    return Vec3f(r * x + time * kDrift);
  };
  // The octahedron's lattice of rows by height: row n has 4 min(n, 2 side - n) points, one at the poles.
  std::vector<std::uint32_t> first;
  for (int row = 0; row <= 2 * side; ++row) {
    first.push_back(std::uint32_t(surface.points.size()));
    const int count = std::min(row, 2 * side - row);
    const double height = double(side - row) / side, ring = 1.0 - std::abs(height);
    for (int n = 0; n < std::max(1, 4 * count); ++n) {
      const double at = count > 0 ? double(n % count) / count : 0.0;
      const int quarter = count > 0 ? n / count : 0;
      const double a = 1.0 - at, b = at;
      const Vec3d corner[4] = {{a, b, 0}, {-b, a, 0}, {-a, -b, 0}, {b, -a, 0}};
      surface.points.push_back(point(ring * corner[quarter] + Vec3d(0, 0, height)));
    }
  }
  const auto number = [&](int row, int quarter, int n) {
    const int count = 4 * std::min(row, 2 * side - row);
    if (count == 0) return first[std::size_t(row)];
    return first[std::size_t(row)] + std::uint32_t((quarter * count / 4 + n) % count);
  };
  // Between a row and the next longer one: of the upper half downward, of the lower half upward.
  for (const bool isUpper : {true, false})
    for (int n = 0; n < side; ++n)
      for (int quarter = 0; quarter < 4; ++quarter)
        for (int k = 0; k <= n; ++k) {
          const int shorter = isUpper ? n : 2 * side - n, longer = isUpper ? n + 1 : 2 * side - n - 1;
          const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            surface.triangles.push_back(isUpper ? openvdb::Vec3I(a, b, c) : openvdb::Vec3I(a, c, b));
          };
          add(number(shorter, quarter, k), number(longer, quarter, k), number(longer, quarter, k + 1));
          if (k < n)
            add(number(shorter, quarter, k), number(longer, quarter, k + 1), number(shorter, quarter, k + 1));
        }
  return surface;
}

// As Blender writes it: points, normals, triangles, each with their number.
void writeMesh(const SurfaceTriangles& surface, const fs::path& file) {
  gzFile out = gzopen(file.c_str(), "wb1");
  const auto write = [&](const void* data, std::size_t rows) {
    const auto count = std::int32_t(rows);
    gzwrite(out, &count, sizeof count);
    gzwrite(out, data, unsigned(12 * rows));
  };
  write(surface.points.data(), surface.points.size());
  write(surface.points.data(), surface.points.size());
  write(surface.triangles.data(), surface.triangles.size());
  gzclose(out);
}

// At faces, in 16 bits, in cells of twice the mesh's.
void writeVelocity(double h, double time, const fs::path& file) {
  const auto grid = openvdb::Vec3SGrid::create(Vec3f(0.0f));
  grid->setName("velocity");
  grid->setGridClass(openvdb::GRID_STAGGERED);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(2.0 * h));
  grid->setSaveFloatAsHalf(true);
  const Vec3d middle = time * kDrift;
  const int reach = int(1.25 / (2.0 * h));
  const Coord at = Coord::round(middle / (2.0 * h));
  grid->denseFill(openvdb::CoordBBox(at.offsetBy(-reach), at.offsetBy(reach)), Vec3f(kDrift), true);
  grid->tree().voxelizeActiveTiles();
  for (auto value = grid->beginValueOn(); value; ++value) {
    const Vec3d x = grid->indexToWorld(value.getCoord()) - middle;
    value.setValue(Vec3f(kDrift) + 0.01f * Vec3f(float(std::sin(7.0 * x[1])), float(std::sin(7.0 * x[2])),
                                                 float(std::sin(7.0 * x[0]))));
  }
  openvdb::io::File(file.string()).write({grid});
}

caches::Cache cacheIn(const fs::path& folder, int triangles) {
  const int side = int(std::lround(std::sqrt(triangles / 8.0)));
  const double h = caches::meanEdge(wavyBall(side, 0.0));
  for (int frame = 1; frame <= kFrames; ++frame) {
    char name[32];
    std::snprintf(name, sizeof name, "%04d", frame);
    const double time = (frame - 1) / kRate;
    writeMesh(wavyBall(side, time), folder / (std::string("mesh_") + name + ".bobj.gz"));
    writeVelocity(h, time, folder / (std::string("velocity_") + name + ".vdb"));
  }
  caches::Options options;
  options.path = folder;
  caches::Survey survey = caches::survey(options);
  return {options, std::move(survey.layout), survey.voxel, kRate};
}

// On all threads.
void frame(benchmark::State& state, int triangles) {
  openvdb::initialize();
  const Scratch folder;
  const caches::Cache cache = cacheIn(folder.path, triangles);
  for ([[maybe_unused]] auto _ : state) {
    caches::CachedFlow flow(cache);
    flow.next();
    std::vector<double> seconds, processor;
    double explained = 0.0;
    for (int n = 2; n <= kFrames; ++n) {
      const double from = wallSeconds(), used = processorSeconds();
      explained = flow.next().stats.explained.value_or(0.0);
      seconds.push_back(wallSeconds() - from);
      processor.push_back(processorSeconds() - used);
    }
    const double before = wallSeconds();
    const SurfaceTriangles surface = caches::readSurface(cache, 2);
    state.counters["mesh_s"] = wallSeconds() - before;
    state.SetIterationTime(median(seconds));
    state.counters["wall_s"] = median(seconds);
    state.counters["cpu_s"] = median(processor);
    state.counters["explained"] = explained;
    state.counters["triangles"] = double(surface.triangles.size());
  }
}

template <class Work>
void measureLevelSet(benchmark::State& state, const std::string& row, int triangles, const Work& work) {
  openvdb::initialize();
  const SurfaceTriangles surface = wavyBall(int(std::lround(std::sqrt(triangles / 8.0))), 0.0);
  const double h = caches::meanEdge(surface);
  for ([[maybe_unused]] auto _ : state) {
    std::vector<double> seconds;
    openvdb::FloatGrid::Ptr phi;
    for (int round = 0; round < 3; ++round) {
      const double from = processorSeconds();
      phi = work(surface, h);
      seconds.push_back(processorSeconds() - from);
    }
    state.SetIterationTime(median(seconds));
    state.counters["cpu_s"] = median(seconds);
    state.counters["voxels"] = double(phi->activeVoxelCount());
    keep(row, "cpu s", median(seconds));
  }
}

// Triangles as OpenVDB asks for them.
struct IndexTriangles {
  const SurfaceTriangles& surface;
  double h;

  std::size_t polygonCount() const { return surface.triangles.size(); }
  std::size_t pointCount() const { return surface.points.size(); }
  std::size_t vertexCount(std::size_t) const { return 3; }
  void getIndexSpacePoint(std::size_t polygon, std::size_t corner, Vec3d& x) const {
    x = Vec3d(surface.points[surface.triangles[polygon][int(corner)]]) / h - Vec3d(0.5);
  }
};

}  // namespace

void registerCacheFrames() {
  for (const int triangles : {100000, 500000}) {
    const std::string size = "/" + std::to_string(triangles), row = "cache_level_set" + size;
    addRow("cache_frame" + size, [=](benchmark::State& state) { frame(state, triangles); });
    addRow(row, [=](benchmark::State& state) {
      measureLevelSet(state, row, triangles, [](const SurfaceTriangles& surface, double h) {
        return caches::levelSetOf(surface, h).phi;
      });
    });
    const std::string peer = row + "/peer:openvdb";
    addRow(peer, [=](benchmark::State& state) {
      measureLevelSet(state, peer, triangles, [](const SurfaceTriangles& surface, double h) {
        return openvdb::tools::meshToVolume<openvdb::FloatGrid>(
            IndexTriangles{surface, h}, *sim::cellTransform(h), caches::kBand, caches::kBand);
      });
    });
  }
}

}  // namespace fluidtex::benchmarks
