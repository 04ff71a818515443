#include "tests/caches/formats/checks.h"
#include "tests/caches/formats/pyramid_files.h"

#include <limits>

using namespace fluidtex::caches;
using Catch::Matchers::Contains;

TEST_CASE("readGeometry: files are told by their endings", "[caches]") {
  for (const char* name : {"a.ply", "a.obj", "a.stl", "a.vtp", "a.vtk", "a.bobj", "fluid_mesh_0001.bobj.gz",
                           "a.bgeo", "a.b.PLY", "a.bhclassic"})
    CHECK(isGeometryFile(name));
  for (const char* name : {"a.bgeo.sc", "a.abc", "a.vdb", "a.gz", "ply", ".ply", "a.ply.tmp", "a.vtu", ""})
    CHECK_FALSE(isGeometryFile(name));
}

TEST_CASE("readGeometry: of formats that are not read it says how to write one that is", "[caches]") {
  for (const char* name : {"a.bgeo.sc", "a.geo", "a.sim"}) {
    CHECK_THAT(adviceFor(name), Contains("Houdini") && Contains(".vdb"));
    CHECK_THAT(refusalOf(name, "scf1"), Contains(adviceFor(name)));
  }
  CHECK_THAT(adviceFor("a.AUR"), Contains("Phoenix") && Contains(".vdb"));
  CHECK_THAT(adviceFor("a.bif"), Contains("Bifrost") && Contains(".vdb"));
  CHECK_THAT(adviceFor("a.abc"), Contains("Alembic") && Contains(".ply"));
  for (const char* name : {"a.usd", "a.usda", "a.usdc", "a.usdz"})
    CHECK_THAT(adviceFor(name), Contains("USD") && Contains(".ply"));
  CHECK_THAT(adviceFor("a.vtu"), Contains(".vtp"));
  CHECK(adviceFor("a.ply").empty());
  CHECK_THAT(refusalOf("a.xyz", "1 2 3"), Contains("expected .ply, .obj"));
}

TEST_CASE("readGeometry: a missing file, a folder, an empty file", "[caches]") {
  const Scratch scratch;
  CHECK_THROWS_WITH(readGeometry(scratch.path / "a.ply"), Contains("a.ply: no such file"));
  std::filesystem::create_directory(scratch.path / "b.ply");
  CHECK_THROWS_WITH(readGeometry(scratch.path / "b.ply"), Contains("b.ply: not a file"));
  CHECK_THAT(refusalOf("a.obj", ""), Contains("the file is empty"));
}

TEST_CASE("readGeometry: a point that is not finite is named", "[caches]") {
  for (const float bad : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
    std::string bytes = bobj(false), number;
    put(number, bad);
    bytes.replace(4 + 4 * 7, 4, number);
    CHECK_THAT(refusalOf("a.bobj", bytes), Contains("point 3 of 5 is not at finite numbers"));
  }
  // Too far for single precision.
  CHECK_THAT(refusalOf("a.obj", "v 0 0 0\nv 0 1e39 0\nv 1 1 1\nf 1 2 3\n"), Contains("point 2 of 3"));
}
