#include "caches/recorded/recorded_frame.h"

#include "caches/layouts/numbered_files.h"
#include "sim/grid/mac_grid.h"
#include "sim/step/solver.h"
#include "tests/caches/recorded/hot_block.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::caches;

namespace {

// Every value, active or not, and the places of all.
template <class Grid>
bool same(const Grid& a, const Grid& b) {
  if (a.transform() != b.transform() || a.background() != b.background() ||
      a.activeVoxelCount() != b.activeVoxelCount())
    return false;
  const auto box = a.evalActiveVoxelBoundingBox();
  const auto first = a.getConstAccessor(), second = b.getConstAccessor();
  for (auto cell = box.begin(); cell; ++cell)
    if (first.getValue(*cell) != second.getValue(*cell) || first.isValueOn(*cell) != second.isValueOn(*cell))
      return false;
  return true;
}

}  // namespace

TEST_CASE("recorded frame: returns bit for bit", "[caches]") {
  const Scratch scratch;
  sim::Solver solver(block());
  solver.next();
  const sim::Frame frame = solver.next();
  REQUIRE(!frame.substeps.empty());
  REQUIRE(frame.fields.contains("temperature"));
  writeRecordedFrame(frame, block().voxelSize(), scratch.path / "f.vdb");
  const sim::Frame read = readRecordedFrame(scratch.path / "f.vdb");
  CHECK(read.index == 2);
  CHECK(read.time == frame.time);
  CHECK(read.stats.volume == frame.stats.volume);
  CHECK(read.stats.cells == frame.stats.cells);
  CHECK(same(*read.surfacePhi, *frame.surfacePhi));
  CHECK(same(*read.solidPhi, *frame.solidPhi));
  REQUIRE(read.substeps.size() == frame.substeps.size());
  for (std::size_t n = 0; n < frame.substeps.size(); ++n) {
    CHECK(read.substeps[n].dt == frame.substeps[n].dt);
    CHECK(same(*read.substeps[n].u, *frame.substeps[n].u));
    CHECK(same(*read.substeps[n].v, *frame.substeps[n].v));
    CHECK(same(*read.substeps[n].w, *frame.substeps[n].w));
  }
  CHECK(same(*read.fields.at("temperature"), *frame.fields.at("temperature")));
}

TEST_CASE("recorded frame: a damaged file is refused", "[caches]") {
  const Scratch scratch;
  sim::Solver solver(block());
  writeRecordedFrame(solver.next(), block().voxelSize(), scratch.path / "f.vdb");
  std::filesystem::resize_file(scratch.path / "f.vdb", 1000);
  CHECK_THROWS_AS(readRecordedFrame(scratch.path / "f.vdb"), LayoutError);
  CHECK_THROWS_AS(readRecordedFrame(scratch.path / "none.vdb"), LayoutError);
}
