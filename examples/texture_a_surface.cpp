// Textures the surface of a liquid that this program has itself: a drop that falls and is drawn out, known in
// closed form. Each frame is a level set and a velocity, as OpenVDB grids; out come meshes with texture.
//
//   texture_a_surface EXEMPLAR.png [FRAMES] [FOLDER]     writes FOLDER/drop_0001.ply, ...
#include "pipeline/given_flow.h"
#include "pipeline/texture_frame.h"
#include "texture/exemplar/srgb.h"
#include "texture/joints/places.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

using openvdb::Vec3d;
using openvdb::Vec3f;

namespace {

constexpr double kRadius = 0.1;          // metres
constexpr double kVoxel = 0.008;         // metres
constexpr double kSeconds = 1.0 / 24.0;  // from frame to frame
constexpr double kRate = 0.3;            // 1/s, by which the drop is drawn out along z
constexpr bool kToroidal = true;         // the exemplar's left edge continues at its right one
const Vec3d kFall(0.0, 0.0, -0.5);       // m/s

// The flow u = fall + rate (-x/2, -y/2, z) around the drop's centre takes a ball to an ellipsoid of the same
// volume: lengths along z grow as exp(rate t), those across shrink as exp(-rate t / 2).
Vec3d centre(double t) {
  return kFall * t;
}

double distance(const Vec3d& x, double t) {
  const double along = std::exp(kRate * t), across = std::exp(-0.5 * kRate * t);
  const Vec3d stretch(across, across, along), q = (x - centre(t)) / stretch, slope = q / stretch;
  // To first order: the value of a function that is 0 on the surface, over the length of its gradient.
  return 0.5 * (q.lengthSqr() - kRadius * kRadius) / std::max(slope.length(), 1e-6);
}

Vec3d velocity(const Vec3d& x, double t) {
  const Vec3d q = x - centre(t);
  return kFall + kRate * Vec3d(-0.5 * q.x(), -0.5 * q.y(), q.z());
}

// The level set at a time, metres, negative inside, and the velocity, m/s, on voxels around the surface. What
// a program has as grids it passes on as it is.
struct Grids {
  openvdb::FloatGrid::Ptr phi;
  openvdb::Vec3SGrid::Ptr velocity;
};

Grids gridsAt(double t) {
  constexpr double kBand = 6.0 * kVoxel;  // velocity is needed where the surface goes until the next frame
  Grids grids{openvdb::createLevelSet<openvdb::FloatGrid>(kVoxel, 6.0f), openvdb::Vec3SGrid::create()};
  grids.velocity->setTransform(grids.phi->transformPtr());
  auto phi = grids.phi->getAccessor();
  auto u = grids.velocity->getAccessor();
  const int side = int(std::ceil(2.0 * kRadius * std::exp(kRate * t) / kVoxel));
  const openvdb::Coord middle = openvdb::Coord::round(grids.phi->worldToIndex(centre(t)));
  for (auto voxel = openvdb::CoordBBox(middle.offsetBy(-side), middle.offsetBy(side)).begin(); voxel;
       ++voxel) {
    const Vec3d x = grids.phi->indexToWorld(*voxel);
    const double d = distance(x, t);
    if (d < -kBand) phi.setValueOff(*voxel, float(-kBand));  // inside, off the band
    if (std::abs(d) > kBand) continue;
    phi.setValue(*voxel, float(d));
    u.setValue(*voxel, Vec3f(velocity(x, t)));
  }
  return grids;
}

// A mesh as text: points with normals, colours as sRGB bytes, and places in the exemplar, 0 to 1 from the top
// left corner.
void writePly(const fluidtex::texture::TexturedSurface& surface, const std::string& file) {
  std::ofstream out(file);
  out << "ply\nformat ascii 1.0\nelement vertex " << surface.positions.size()
      << "\nproperty float x\nproperty float y\nproperty float z"
         "\nproperty float nx\nproperty float ny\nproperty float nz"
         "\nproperty uchar red\nproperty uchar green\nproperty uchar blue"
         "\nproperty float s\nproperty float t\nelement face "
      << surface.triangles.size() << "\nproperty list uchar int vertex_indices\nend_header\n";
  const fluidtex::texture::Torus exemplar(surface, kToroidal);
  for (std::size_t v = 0; v < surface.positions.size(); ++v) {
    for (int i = 0; i < 3; ++i) out << surface.positions[v][i] << ' ';
    for (int i = 0; i < 3; ++i) out << surface.normals[v][i] << ' ';
    for (int i = 0; i < 3; ++i)
      out << std::lround(255.0f * fluidtex::texture::encodeSrgb(std::clamp(surface.color[v][i], 0.0f, 1.0f)))
          << ' ';
    const openvdb::Vec2f place =
        (exemplar.brought(surface.coordinate[v]) + openvdb::Vec2f(0.5f)) / exemplar.size;
    out << place[0] << ' ' << place[1] << '\n';
  }
  for (const auto& t : surface.triangles) out << "3 " << t[0] << ' ' << t[1] << ' ' << t[2] << '\n';
  if (!out.flush()) throw std::runtime_error(file + ": cannot be written");
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc < 2) throw std::runtime_error("usage: texture_a_surface EXEMPLAR.png [FRAMES] [FOLDER]");
  const int frames = argc > 2 ? std::stoi(argv[2]) : 2;
  const std::string folder = argc > 3 ? argv[3] : ".";
  openvdb::initialize();

  // Settings are those of a scene file, with the same defaults (scenes/README.md).
  fluidtex::scenes::Scene scene;
  scene.texture.exemplar.file = argv[1];
  scene.texture.exemplar.toroidal = kToroidal;
  scene.texture.points = 6000;  // or texture.spacing, in metres
  scene.sim.frameRate = 1.0 / kSeconds;
  fluidtex::pipeline::Texturing texturing = fluidtex::pipeline::makeTexturing(scene);

  fluidtex::pipeline::GivenFlow flow;
  fluidtex::texture::TexturedSurface surface;  // the last frame's, from which its texture is transported
  for (int frame = 1; frame <= frames; ++frame) {
    const Grids grids = gridsAt((frame - 1) * kSeconds);
    const fluidtex::sim::Frame motion =
        flow.next(fluidtex::pipeline::liquidOf(*grids.phi, grids.velocity), kSeconds);
    fluidtex::pipeline::TexturedFrame result = fluidtex::pipeline::textureFrame(texturing, surface, motion);
    surface = std::move(result.surface);
    char name[32];
    std::snprintf(name, sizeof name, "/drop_%04d.ply", frame);
    writePly(surface, folder + name);
    std::cout << "frame " << frame << ": " << surface.positions.size() << " points, "
              << int(std::lround(100.0 * result.synthesis.renewed)) << "% renewed\n";
  }
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
