// What is looked at in a geometry.
#pragma once

#include "caches/formats/read_geometry.h"
#include "tests/caches/formats/written_bytes.h"

#include <catch2/catch.hpp>

namespace fluidtex::caches {

inline Geometry geometryIn(const std::string& name, const std::string& bytes) {
  const Written file(name, bytes);
  return readGeometry(file.path);
}

// The sentence that a file is refused with, without the file's name; empty where it is read.
inline std::string refusalOf(const std::string& name, const std::string& bytes) {
  const Written file(name, bytes);
  try {
    readGeometry(file.path);
  } catch (const FormatError& error) {
    const std::string sentence = error.what(), begin = file.path.string() + ": ";
    REQUIRE(sentence.starts_with(begin));
    REQUIRE(sentence.find('\n') == std::string::npos);
    return sentence.substr(begin.size());
  }
  return {};
}

inline double volumeOf(const Geometry& geometry) {
  double sixfold = 0.0;
  for (const openvdb::Vec3I& t : geometry.triangles) {
    const openvdb::Vec3d a(geometry.points[t[0]]), b(geometry.points[t[1]]), c(geometry.points[t[2]]);
    sixfold += a.dot(b.cross(c));
  }
  return sixfold / 6.0;
}

inline std::vector<double> coordinatesOf(const Geometry& geometry) {
  std::vector<double> numbers;
  for (const openvdb::Vec3f& p : geometry.points) numbers.insert(numbers.end(), {p.x(), p.y(), p.z()});
  return numbers;
}

inline std::vector<double> valuesOf(const Geometry& geometry, const std::string& name) {
  const auto at = geometry.attributes.find(name);
  if (at == geometry.attributes.end()) return {};
  return {at->second.values.begin(), at->second.values.end()};
}

// Its points in their order, and faces that close around its volume.
inline void checkPyramid(const Geometry& geometry) {
  CHECK(coordinatesOf(geometry) == kPyramid);
  CHECK(geometry.triangles.size() == 6);
  CHECK(volumeOf(geometry) == Approx(kPyramidVolume));
}

inline void checkSpeeds(const Geometry& geometry, const std::string& name) {
  REQUIRE(geometry.attributes.contains(name));
  CHECK(geometry.attributes.at(name).components == 3);
  CHECK(valuesOf(geometry, name) == kPyramidSpeeds);
}

}  // namespace fluidtex::caches
