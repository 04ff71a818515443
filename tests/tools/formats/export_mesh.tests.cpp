#include "tools/formats/export_mesh.h"

#include "tests/tools/formats/sample_mesh.h"
#include "tests/tools/formats/sample_surface.h"
#include "texture/joints/joints.h"

#include <catch2/catch.hpp>

#include <cmath>
#include <set>

using namespace fluidtex;
using tools::ExportMesh;
using tools::JointsAs;

namespace {

// A sheet of 1 m in the plane z = 0 of 21 x 21 vertices. Its texture is laid on without distortion, ten
// texels a metre; that of the right half comes from elsewhere in the exemplar.
texture::TexturedSurface twoPieces() {
  constexpr int kSide = 21;
  texture::TexturedSurface sheet;
  sheet.exemplarWidth = 64;
  sheet.exemplarHeight = 32;
  sheet.spacing = 0.05;
  for (int j = 0; j < kSide; ++j)
    for (int i = 0; i < kSide; ++i) {
      const float x = 0.05f * float(i), y = 0.05f * float(j);
      sheet.positions.emplace_back(x, y, 0.0f);
      sheet.coordinate.emplace_back((i > kSide / 2 ? 40.0f : 5.0f) + 10.0f * x, 20.0f - 10.0f * y);
    }
  for (std::uint32_t j = 0; j + 1 < kSide; ++j)
    for (std::uint32_t i = 0; i + 1 < kSide; ++i) {
      const std::uint32_t v = kSide * j + i;
      sheet.triangles.emplace_back(v, v + 1, v + kSide + 1);
      sheet.triangles.emplace_back(v, v + kSide + 1, v + kSide);
    }
  const std::size_t count = sheet.positions.size();
  sheet.normals.assign(count, {0, 0, 1});
  sheet.orientation.assign(count, {1, 0, 0});
  sheet.color.assign(count, {1, 1, 1, 1});
  sheet.gradient.assign(count, {{10, 0, 0}, {0, -10, 0}});
  sheet.fading = texture::noFading(count);
  sheet.age.assign(count, 0.0f);
  sheet.trust.assign(count, 1.0f);
  sheet.previousPosition = sheet.positions;
  sheet.velocity.assign(count, {0, 0, 0});
  sheet.contact.assign(count, 0);
  return sheet;
}

double areaOf(const ExportMesh& mesh) {
  double area = 0.0;
  for (const texture::Vec3I& t : mesh.triangles)
    area += 0.5 * (mesh.positions[t[1]] - mesh.positions[t[0]])
                      .cross(mesh.positions[t[2]] - mesh.positions[t[0]])
                      .length();
  return area;
}

}  // namespace

TEST_CASE("export mesh: how far the texture is stretched is a column, where it is looked up", "[tools]") {
  const texture::TexturedSurface sheet = twoPieces();  // half a texel a point
  const ExportMesh mesh = tools::exportMesh(sheet, true, false, JointsAs::blend, 1, 0.0);
  const tools::Column* stretch = tools::findColumn(mesh.vertex, "stretch");
  REQUIRE(stretch != nullptr);
  CHECK(stretch->values.size() == mesh.positions.size());
  for (const float value : stretch->values) CHECK(value == Approx(2.0f));
  CHECK(tools::findColumn(tools::exportMesh(sheet, false, false, JointsAs::blend, 1, 0.0).vertex,
                          "stretch") == nullptr);
}

TEST_CASE("export mesh: with joints that are cut, s and t are linear in every triangle", "[tools]") {
  const texture::TexturedSurface sheet = twoPieces();
  const ExportMesh mesh = tools::exportMesh(sheet, true, false, JointsAs::cut, 3, 0.5);
  CHECK(mesh.frame == 3);
  CHECK(mesh.time == 0.5);
  CHECK(mesh.corner.empty());
  CHECK(areaOf(mesh) == Approx(1.0));
  CHECK(mesh.triangles.size() > sheet.triangles.size());
  const tools::Column* st = tools::findColumn(mesh.vertex, "st");
  REQUIRE(st != nullptr);
  REQUIRE(st->values.size() == 2 * mesh.positions.size());
  for (const texture::Vec3I& t : mesh.triangles)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      const texture::Vec3f way = mesh.positions[b] - mesh.positions[a];
      CHECK(st->values[2 * b] - st->values[2 * a] == Approx(10.0f * way.x() / 64.0f).margin(1e-5));
      CHECK(st->values[2 * b + 1] - st->values[2 * a + 1] == Approx(-10.0f * way.y() / 32.0f).margin(1e-5));
    }
}

TEST_CASE(
    "export mesh: joints that blend have the place of each corner's piece at every corner, and its weight",
    "[tools]") {
  const texture::TexturedSurface sheet = twoPieces();
  const ExportMesh mesh = tools::exportMesh(sheet, true, false, JointsAs::blend, 1, 0.0);
  CHECK(mesh.positions == sheet.positions);
  CHECK(mesh.triangles == sheet.triangles);
  const tools::Column* joint = tools::findColumn(mesh.corner, "joint");
  REQUIRE(joint != nullptr);
  const char* const names[] = {"st", "st1", "st2"};
  int joints = 0;
  for (std::size_t t = 0; t < sheet.triangles.size(); ++t) {
    const texture::Vec3I& corner = sheet.triangles[t];
    const bool isJoint = joint->values[3 * (3 * t + 1) + 1] == 1.0f;
    joints += isJoint;
    for (std::size_t c = 0; c < 3; ++c) {
      float weights = 0.0f;
      for (std::size_t label = 0; label < 3; ++label) {
        weights += joint->values[3 * (3 * t + c) + label];
        // The piece of the label's vertex, laid on from there without distortion.
        const std::uint32_t own = corner[int(isJoint ? label : c)];
        const texture::Vec3f way = sheet.positions[corner[int(c)]] - sheet.positions[own];
        const tools::Column* set = tools::findColumn(mesh.corner, names[label]);
        REQUIRE(set != nullptr);
        CHECK(set->values[2 * (3 * t + c)] ==
              Approx((sheet.coordinate[own].x() + 10.0f * way.x() + 0.5f) / 64.0f).margin(1e-5));
        CHECK(set->values[2 * (3 * t + c) + 1] ==
              Approx((sheet.coordinate[own].y() - 10.0f * way.y() + 0.5f) / 32.0f).margin(1e-5));
      }
      CHECK(weights == 1.0f);
    }
  }
  CHECK(joints == 40);  // the two triangles of each square across the middle
}

TEST_CASE("export mesh: every value of a surface is a column, parts of vectors are one", "[tools]") {
  texture::TexturedSurface surface = sampleSurface();
  surface.maps = {{"height", {1, 2, 3, 4}},     {"wind_x", {1, 2, 3, 4}},    {"wind_y", {5, 6, 7, 8}},
                  {"wind_z", {9, 10, 11, 12}},  {"paint_red", {1, 2, 3, 4}}, {"paint_green", {5, 6, 7, 8}},
                  {"paint_blue", {9, 0, 1, 2}}, {"alone_x", {4, 3, 2, 1}}};
  const ExportMesh mesh = tools::exportMesh(surface, false, false, JointsAs::cut, 1, 0.0);
  std::vector<std::string> names;
  for (const tools::Column& column : mesh.vertex) {
    names.push_back(column.name);
    CHECK(column.values.size() == 4 * std::size_t(column.components));
  }
  CHECK(names == std::vector<std::string>{"velocity", "orientation", "previous_position", "trust", "age",
                                          "contact", "alone_x", "height", "paint", "wind"});
  CHECK(tools::findColumn(mesh.vertex, "wind")->values ==
        std::vector<float>{1, 5, 9, 2, 6, 10, 3, 7, 11, 4, 8, 12});
  CHECK(tools::findColumn(mesh.vertex, "paint")->values ==
        std::vector<float>{1, 5, 9, 2, 6, 0, 3, 7, 1, 4, 8, 2});
}

TEST_CASE("export mesh: a map with the name of something else gets another", "[tools]") {
  texture::TexturedSurface surface = sampleSurface();
  surface.maps = {{"color_red", {1, 2, 3, 4}}, {"color_green", {5, 6, 7, 8}}, {"color_blue", {9, 0, 1, 2}},
                  {"normal", {1, 2, 3, 4}},    {"st", {1, 2, 3, 4}},          {"st_", {5, 6, 7, 8}},
                  {"velocity", {1, 2, 3, 4}}};
  const ExportMesh mesh = tools::exportMesh(surface, true, false, JointsAs::cut, 1, 0.0);
  std::set<std::string> names;
  for (const tools::Column& column : mesh.vertex) CHECK(names.insert(column.name).second);
  for (const char* name : {"color", "normal"}) CHECK(names.count(name) == 0);
  for (const char* name : {"color_", "normal_", "st_", "st__", "velocity_"}) CHECK(names.count(name) == 1);
  CHECK(tools::findColumn(mesh.vertex, "st")->components == 2);
  CHECK(tools::findColumn(mesh.vertex, "velocity")->components == 3);
}

TEST_CASE("export mesh: a frame without surface is an empty mesh", "[tools]") {
  for (const JointsAs joints : {JointsAs::cut, JointsAs::blend}) {
    const ExportMesh mesh = tools::exportMesh({}, true, true, joints, 4, 0.125);
    CHECK(mesh.positions.empty());
    CHECK(mesh.triangles.empty());
    CHECK(mesh.frame == 4);
  }
}

TEST_CASE("export mesh: splitting at corners copies those vertices alone whose corners differ", "[tools]") {
  const ExportMesh whole = samplePieces(), split = tools::splitAtCorners(whole);
  REQUIRE(split.positions.size() == 5);  // vertex 0 has one row in both triangles, vertex 2 two
  CHECK(split.corner.empty());
  CHECK(split.triangles[0] == texture::Vec3I(0, 1, 2));
  CHECK(split.triangles[1] == texture::Vec3I(0, 4, 3));
  CHECK(split.positions[4] == whole.positions[2]);
  CHECK(split.color[4] == whole.color[2]);
  CHECK(tools::findColumn(split.vertex, "age")->values[4] == 2.5f);
  CHECK(tools::findColumn(split.vertex, "st")->values ==
        std::vector<float>{0, 0, 1, 0, 1, 1, 0, 1, 0.5f, 0.5f});
}
