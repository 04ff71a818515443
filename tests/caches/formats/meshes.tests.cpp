#include "tests/caches/formats/checks.h"
#include "tests/caches/formats/pyramid_files.h"

using namespace fluidtex::caches;
using Catch::Matchers::Contains;

namespace {

// With vertices' properties of any names, each numbered from `first` on by tens.
std::string ply(const std::vector<std::string>& properties, const std::string& format = "ascii",
                bool withFaces = true) {
  std::string bytes = "ply\nformat " + format +
                      " 1.0\nelement vertex 5\nproperty float x\nproperty float y\nproperty double z\n";
  for (const std::string& name : properties)
    bytes += "property " + std::string(name == "id" ? "int" : "float") + " " + name + "\n";
  bytes += "property list uchar int ring\n";
  if (withFaces) bytes += "element face 5\nproperty list uchar int vertex_indices\n";
  bytes += "end_header\n";
  const auto order = format == "binary_big_endian" ? std::endian::big : std::endian::little;
  const bool isText = format == "ascii";
  const auto put = [&]<class Number>(Number number) {
    isText ? bytes += std::to_string(number) + " " : (fluidtex::caches::put(bytes, number, order), bytes);
  };
  for (std::size_t n = 0; n < 5; ++n) {
    put(float(kPyramid[3 * n]));
    put(float(kPyramid[3 * n + 1]));
    put(double(kPyramid[3 * n + 2]));
    for (std::size_t p = 0; p < properties.size(); ++p)
      properties[p] == "id" ? put(std::int32_t(10 * p + n)) : put(float(10 * p + n));
    put(std::uint8_t(1));
    put(std::int32_t(7));
  }
  for (const auto& face : kPyramidFaces) {
    if (!withFaces) break;
    put(std::uint8_t(face.size()));
    for (const double corner : face) put(std::int32_t(corner));
  }
  return bytes;
}

std::vector<double> countedFrom(double first) {
  return {first, first + 1, first + 2, first + 3, first + 4};
}

std::vector<double> interleaved(double first) {
  std::vector<double> values;
  for (int n = 0; n < 5; ++n) values.insert(values.end(), {first + n, first + 10 + n, first + 20 + n});
  return values;
}

}  // namespace

TEST_CASE("ply: further properties of vertices are attributes, those along axes one", "[caches]") {
  for (const std::string format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    CAPTURE(format);
    const Geometry geometry = geometryIn(
        "a.ply", ply({"vx", "vy", "vz", "velocity_x", "velocity_y", "velocity_z", "id", "red"}, format));
    checkPyramid(geometry);
    CHECK(geometry.attributes.size() == 4);
    CHECK(geometry.attributes.at("v").components == 3);
    CHECK(valuesOf(geometry, "v") == interleaved(0));
    CHECK(valuesOf(geometry, "velocity") == interleaved(30));
    CHECK(valuesOf(geometry, "id") == countedFrom(60));
    CHECK(geometry.attributes.at("id").components == 1);
    CHECK(valuesOf(geometry, "red") == countedFrom(70));
  }
}

TEST_CASE("ply: what is not joined", "[caches]") {
  const Geometry two = geometryIn("a.ply", ply({"vx", "vy", "v", "wx", "wz", "wy"}));
  CHECK(valuesOf(two, "vx") == countedFrom(0));
  CHECK(valuesOf(two, "v") == countedFrom(20));
  std::vector<double> w;
  for (int n = 0; n < 5; ++n) w.insert(w.end(), {30.0 + n, 50.0 + n, 40.0 + n});
  CHECK(valuesOf(two, "w") == w);
  const Geometry taken = geometryIn("a.ply", ply({"vx", "vy", "vz", "v"}));
  CHECK(taken.attributes.size() == 2);
  CHECK(valuesOf(taken, "v") == interleaved(0));
  CHECK(valuesOf(taken, "v_") == countedFrom(30));
}

TEST_CASE("ply: particles and empty frames", "[caches]") {
  const Geometry particles = geometryIn("a.ply", ply({"vX", "vY", "vZ"}, "binary_little_endian", false));
  CHECK(coordinatesOf(particles) == kPyramid);
  CHECK(valuesOf(particles, "v") == interleaved(0));
  CHECK(particles.triangles.empty());
  CHECK(geometryIn("a.ply",
                   "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty "
                   "float z\nelement face 0\n"
                   "property list uchar int vertex_indices\nend_header\n")
            .points.empty());
}

TEST_CASE("obj and stl are read as shapes are", "[caches]") {
  std::string obj = "# a pyramid\n", stl = "solid a\n";
  for (std::size_t n = 0; n < 15; n += 3)
    obj += "v " + textOf({kPyramid[n], kPyramid[n + 1], kPyramid[n + 2]});
  for (const auto& face : kPyramidFaces) {
    obj += "f";
    for (const double corner : face) obj += ' ' + std::to_string(int(corner) + 1) + "//1";
    obj += "\n";
  }
  checkPyramid(geometryIn("a.obj", obj));
  checkPyramid(geometryIn("a.OBJ.GZ", gzipped(obj)));
  for (const auto& triangle : pyramidTriangles()) {
    stl += "facet normal 0 0 0\nouter loop\n";
    for (const double corner : triangle) {
      const std::size_t n = 3 * std::size_t(corner);
      stl += "vertex " + textOf({kPyramid[n], kPyramid[n + 1], kPyramid[n + 2]});
    }
    stl += "endloop\nendfacet\n";
  }
  const Geometry facets = geometryIn("a.stl", stl + "endsolid\n");
  CHECK(facets.points.size() == 18);
  CHECK(facets.triangles.size() == 6);
  CHECK(volumeOf(facets) == Approx(kPyramidVolume));
  CHECK_THAT(refusalOf("a.obj", "v 0 0 0\nf 1 2 3\n"), Contains("line 2: a face names vertex 3"));
  CHECK_THAT(refusalOf("a.ply", ply({}).replace(0, 3, "PLY")), Contains("is no PLY"));
}
