#include "caches/recorded/recorded_frame.h"

#include "caches/layouts/numbered_files.h"
#include "sim/grid/mac_grid.h"
#include "sim/step/solver.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::caches;

namespace {

// A hot block that falls: the second frame has substeps, solids and a field.
sim::Options block() {
  sim::Options options;
  options.size = sim::Vec3d(0.7, 0.5, 0.6);
  options.resolution = 14;
  options.heat.simulated = true;
  options.liquid.push_back({.shape = {sim::Box{{0.1, 0.1, 0.1}, {0.4, 0.4, 0.4}}}, .temperature = 350.0});
  return options;
}

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

TEST_CASE("recorded frame: what thin walls hide returns", "[caches]") {
  const Scratch scratch;
  sim::Options options = block();
  // A plate of 0.8 cells that moves after a while: substeps share what is hidden, or do not.
  options.liquid[0].velocity = sim::Vec3d(0.0, 0.0, -4.0);
  options.solids.resize(1);
  options.solids[0].shape = {sim::Box{{0.41, -1.0, -1.0}, {0.45, 2.0, 0.35}}};
  options.solids[0].keyframes = {{.time = 2.5 / options.frameRate},
                                 {.time = 1.0, .move = sim::Vec3d(0.2, 0.0, 0.0)}};
  sim::Solver solver(options);
  solver.next();
  int shared = 0, changed = 0;
  for (int n = 0; n < 3; ++n) {
    const sim::Frame frame = solver.next();
    writeRecordedFrame(frame, options.voxelSize(), scratch.path / "f.vdb");
    const sim::Frame read = readRecordedFrame(scratch.path / "f.vdb");
    REQUIRE(read.substeps.size() == frame.substeps.size());
    for (std::size_t s = 0; s < frame.substeps.size(); ++s) {
      REQUIRE(frame.substeps[s].visibility != nullptr);
      REQUIRE(read.substeps[s].visibility != nullptr);
      const bool same = s > 0 && frame.substeps[s].visibility == frame.substeps[s - 1].visibility;
      CHECK(same == (s > 0 && read.substeps[s].visibility == read.substeps[s - 1].visibility));
      (same ? shared : changed) += 1;
      const sim::Visibility &there = *frame.substeps[s].visibility, &back = *read.substeps[s].visibility;
      CHECK(back.origins().size() == there.origins().size());
      for (const sim::Coord& origin : there.origins()) {
        const sim::Visibility::Leaf* cells = back.leaf(origin);
        REQUIRE(cells != nullptr);
        for (std::size_t cell = 0; cell < cells->size(); ++cell)
          REQUIRE((*cells)[cell].bits == (*there.leaf(origin))[cell].bits);
      }
    }
  }
  CHECK(shared > 0);
  CHECK(changed > 3);
}

TEST_CASE("recorded frame: a damaged file is refused", "[caches]") {
  const Scratch scratch;
  sim::Solver solver(block());
  writeRecordedFrame(solver.next(), block().voxelSize(), scratch.path / "f.vdb");
  std::filesystem::resize_file(scratch.path / "f.vdb", 1000);
  CHECK_THROWS_AS(readRecordedFrame(scratch.path / "f.vdb"), LayoutError);
  CHECK_THROWS_AS(readRecordedFrame(scratch.path / "none.vdb"), LayoutError);
}
