// Sequences of meshes: their files, what lies between them, and the velocity of their surface.
#include "sim/meshes/read_mesh.h"
#include "sim/shapes/moving_mesh.h"
#include "sim/shapes/pose.h"
#include "sim/shapes/shape_triangles.h"
#include "sim/shapes/surface_velocity.h"
#include "tests/sim/meshes/mesh_files.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::sim;
using Catch::Matchers::Contains;
using openvdb::Vec3f;

TEST_CASE("mesh sequence: the number stands in the last part of the name") {
  MeshSequence sequence;
  sequence.first = 9;
  sequence.files = "50%d/rock_%03d.obj";
  CHECK(sequence.fileOf(0) == "50%d/rock_009.obj");
  CHECK(sequence.fileOf(991) == "50%d/rock_1000.obj");
  sequence.files = "%d.ply";
  CHECK(sequence.fileOf(1) == "10.ply");
}

TEST_CASE("mesh sequence: it goes evenly from file to file and rests outside of them") {
  MeshSequence sequence;
  sequence.first = 3;
  sequence.last = 33;
  sequence.frameRate = 30.0;
  sequence.start = 0.7;
  const Solid solid = solidOf(sequence);
  CHECK_FALSE(poseAt(solid, 0.699).moving());
  CHECK(poseAt(solid, 0.699).file == 0);
  CHECK_FALSE(poseAt(solid, 1.71).moving());
  CHECK(poseAt(solid, 1.71).file == 30);
  CHECK(poseAt(solid, 1.71).part == 0.0);
  // At a file's time it goes on as after it, whatever rounding does.
  for (int n = 0; n < 30; ++n) {
    const Pose pose = poseAt(solid, sequence.timeOf(n));
    CHECK(pose.file == n);
    CHECK(pose.part == 0.0);
    CHECK(pose.fileRate == 30.0);
  }
  CHECK_FALSE(poseAt(solid, sequence.timeOf(30)).moving());
  const Pose between = poseAt(solid, 0.7 + 4.25 / 30.0);
  CHECK(between.file == 4);
  CHECK(between.part == Approx(0.25));
}

TEST_CASE("mesh sequence: vertices go in straight lines") {
  const Files files({boxObj(Vec3d(0.0), Vec3d(1.0)), boxObj(Vec3d(0.0), Vec3d(2.0, 1.0, 3.0))});
  const MovingMesh mesh(files.sequence);
  CHECK(volumeOf(mesh.at(0, 0.0)) == Approx(1.0));
  CHECK(volumeOf(mesh.at(0, 0.5)) == Approx(1.5 * 2.0));
  CHECK(volumeOf(mesh.at(1, 0.0)) == Approx(6.0));
  CHECK(mesh.change(0)[0] == Vec3f(0.0f));
  CHECK(mesh.change(0)[6] == Vec3f(1.0f, 0.0f, 2.0f));
  MeshSequence placed = files.sequence;
  placed.scale = 2.0;
  placed.translate = Vec3d(1.0, 2.0, 3.0);
  CHECK(MovingMesh(placed).at(1, 0.0).positions[6] == Vec3f(5.0f, 4.0f, 9.0f));
  // Two files alone are the same.
  CHECK(MovingMesh(files.sequence, 1, 1).at(1, 0.0).positions == mesh.at(1, 0.0).positions);
}

TEST_CASE("mesh sequence: vertices that are always together are joined, others are not") {
  // A box whose top has corners of its own, as exporters make them where normals differ.
  const auto twice = [](double top) {
    return boxObj(Vec3d(0.0), Vec3d(1.0, 1.0, top), "") + vertex(0, 0, top) + vertex(1, 0, top) +
           vertex(1, 1, top) + vertex(0, 1, top) +
           "f 1 4 3 2\nf 9 10 11 12\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  };
  // Flat at first: then its top and bottom lie together, but only then.
  const Files files({twice(0.0), twice(1.0)});
  const MovingMesh mesh(files.sequence);
  CHECK(mesh.at(0, 0.0).triangles.size() == 12);
  CHECK(volumeOf(mesh.at(0, 0.5)) == Approx(0.5));
  // A notch in an L: the fan has to start at the inner corner.
  const auto ell = [](double top) {
    std::string text;
    for (const double z : {0.0, top})
      text += vertex(0, 0, z) + vertex(2, 0, z) + vertex(2, 1, z) + vertex(1, 1, z) + vertex(1, 2, z) +
              vertex(0, 2, z);
    text += "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n";
    for (int n = 0; n < 6; ++n) {
      const int next = (n + 1) % 6;
      text += "f " + std::to_string(n + 1) + " " + std::to_string(next + 1) + " " + std::to_string(next + 7) +
              " " + std::to_string(n + 7) + "\n";
    }
    return text;
  };
  const Files ells({ell(1.0), ell(3.0)});
  const TriangleMesh notched = MovingMesh(ells.sequence).at(0, 0.5);
  double area = 0.0;
  for (const auto& t : notched.triangles) {
    const Vec3d a(notched.positions[t[0]]), b(notched.positions[t[1]]), c(notched.positions[t[2]]);
    area += 0.5 * (b - a).cross(c - a).length();
  }
  CHECK(volumeOf(notched) == Approx(6.0));
  CHECK(area == Approx(2.0 * 3.0 + 8.0 * 2.0));
}

TEST_CASE("mesh sequence: faults name the files and what is wrong") {
  const auto faultOf = [](const std::vector<std::string>& texts) -> std::string {
    const Files files(texts);
    try {
      MovingMesh mesh(files.sequence);
    } catch (const MeshError& error) {
      return error.what();
    }
    return "no fault";
  };
  const std::string box = boxObj(Vec3d(0.0), Vec3d(1.0));
  const std::string same =
      "; all files of a sequence must have the same vertices and faces in the same order";
  CHECK(faultOf({box, box}) == "no fault");
  CHECK_THAT(faultOf({box, box, "v 0 0 0\n" + box}),
             Contains("box_03.obj: has 9 vertices and 6 faces, not 8 vertices and 6 faces as /") &&
                 Contains("box_01.obj" + same));
  const std::string turned = "f 1 4 3 2\nf 5 6 7 8\nf 1 5 6 2\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
  CHECK_THAT(
      faultOf({box, boxObj(Vec3d(0.0), Vec3d(1.0), turned)}),
      Contains("box_02.obj: its face 3 joins other vertices than in /") && Contains("box_01.obj" + same));
  CHECK_THAT(faultOf({box, "v nan 0 0\n" + box}), Contains("box_02.obj: "));
  CHECK_THAT(faultOf({box, ""}), Contains("box_02.obj: the file is empty"));
  const std::string open = boxObj(Vec3d(0.0), Vec3d(1.0), kBoxFaces.substr(10));
  CHECK_THAT(faultOf({open, open}), Contains("box_01.obj: is not closed: 4 edges"));
  MeshSequence missing = Files({box, box}).sequence;
  CHECK_THROWS_AS(MovingMesh(missing), MeshError);
}

TEST_CASE("surface velocity: that of the closest point") {
  const Files files({boxObj(Vec3d(0.0), Vec3d(1.0)), boxObj(Vec3d(0.0), Vec3d(2.0, 1.0, 1.0))});
  const MovingMesh mesh(files.sequence);
  const SurfaceVelocity velocity(mesh.at(0, 0.0), mesh.change(0));
  for (const double reach : {0.05, 0.5, 10.0}) {
    CHECK((velocity.at(Vec3d(1.2, 0.3, 0.7), reach) - Vec3d(1, 0, 0)).length() < 1e-6);
    CHECK((velocity.at(Vec3d(0.25, 0.3, 1.1), reach) - Vec3d(0.25, 0, 0)).length() < 1e-6);
    CHECK((velocity.at(Vec3d(0.7, 0.5, 0.9), reach) - Vec3d(0.7, 0, 0)).length() < 1e-6);
    CHECK(velocity.at(Vec3d(-3.0, 0.5, 0.5), reach).length() < 1e-6);
  }
  // A sphere that swells: whatever the triangle, the velocity points outward and is as large as the radius
  // grows.
  const TriangleMesh ball =
      triangulate(Shape{Sphere{Vec3d(0.5), 0.25}}, openvdb::BBoxd(Vec3d(0.0), Vec3d(1.0)), 0.02);
  std::vector<Vec3f> outward;
  for (const Vec3f& x : ball.positions) outward.push_back((x - Vec3f(0.5f)) * 4.0f);
  const SurfaceVelocity expands(ball, outward);
  for (int n = 0; n < 200; ++n) {
    const Vec3d way = Vec3d(std::sin(1.0 * n), std::cos(2.3 * n), std::sin(3.1 * n)).unit();
    for (const double r : {0.2, 0.25, 0.3}) {
      const Vec3d v = expands.at(Vec3d(0.5) + r * way, std::abs(r - 0.25) + 0.02);
      CHECK((v - way).length() < 0.01);
    }
  }
}
