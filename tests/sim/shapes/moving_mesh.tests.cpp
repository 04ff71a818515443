#include "sim/shapes/moving_mesh.h"

#include "sim/meshes/read_mesh.h"
#include "tests/sim/meshes/mesh_files.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;
using Catch::Matchers::Contains;
using openvdb::Vec3f;

TEST_CASE("moving mesh: vertices go in straight lines") {
  const Files files({boxObj(Vec3d(0.0), Vec3d(1.0)), boxObj(Vec3d(0.0), Vec3d(2.0, 1.0, 3.0))});
  const MovingMesh mesh(files.sequence);
  CHECK(volumeOf(mesh.at(0, 0.0)) == Approx(1.0));
  CHECK(volumeOf(mesh.at(0, 0.5)) == Approx(1.5 * 2.0));
  CHECK(volumeOf(mesh.at(1, 0.0)) == Approx(6.0));
  CHECK(mesh.change(0)[0] == Vec3f(0.0f));
  CHECK(mesh.change(0)[6] == Vec3f(1.0f, 0.0f, 2.0f));
  MeshSequence placed = files.sequence;
  placed.place.scale = 2.0;
  placed.place.translate = Vec3d(1.0, 2.0, 3.0);
  CHECK(MovingMesh(placed).at(1, 0.0).positions[6] == Vec3f(5.0f, 4.0f, 9.0f));
  // Two files alone are the same.
  CHECK(MovingMesh(files.sequence, 1, 1).at(1, 0.0).positions == mesh.at(1, 0.0).positions);
}

TEST_CASE("moving mesh: vertices that are always together are joined, others are not") {
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

TEST_CASE("moving mesh: faults name the files and what is wrong") {
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

TEST_CASE("moving mesh: cavities and shared faces are as in a single mesh", "[sim]") {
  const auto nested = [](double size) {
    return boxCorners(Vec3d(0.0), Vec3d(size)) + boxCorners(Vec3d(1.0), Vec3d(size - 1.0)) + facesFrom(1) +
           facesFrom(9);
  };
  const Files files({nested(4.0), nested(5.0)});
  const MovingMesh mesh(files.sequence);
  CHECK(volumeOf(mesh.at(0, 0.0)) == Approx(64.0 - 8.0));
  CHECK(volumeOf(mesh.at(1, 0.0)) == Approx(125.0 - 27.0));
  // Flat in its first file.
  const Files flat({boxObj(Vec3d(0.0), Vec3d(1.0, 1.0, 0.0)), boxObj(Vec3d(0.0), Vec3d(1.0))});
  CHECK(volumeOf(MovingMesh(flat.sequence).at(1, 0.0)) == Approx(1.0));
}
