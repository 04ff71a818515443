#include "caches/recorded/recorded_sight.h"

#include "caches/recorded/recorded_frame.h"
#include "numerics/random.h"
#include "sim/grid/write_grids.h"
#include "sim/step/solver.h"
#include "tests/caches/recorded/hot_block.h"
#include "tests/scratch.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using namespace fluidtex::caches;

namespace {

// Of blocks at these places, each bit at random.
std::shared_ptr<const sim::Visibility> sightOf(const std::vector<sim::Coord>& origins, std::uint64_t seed) {
  const auto visibility = std::make_shared<sim::Visibility>();
  for (const sim::Coord& origin : origins) {
    auto leaf = std::make_unique<sim::Visibility::Leaf>();
    for (std::size_t cell = 0; cell < leaf->size(); ++cell)
      (*leaf)[cell].bits = {randomBits(seed, 2 * cell), randomBits(seed, 2 * cell + 1)};
    visibility->add(origin, std::move(leaf));
  }
  return visibility;
}

// The file's metadata and grids of a frame with these substeps.
struct Sights {
  openvdb::GridCPtrVec grids;
  openvdb::MetaMap metadata;

  explicit Sights(const std::vector<std::shared_ptr<const sim::Visibility>>& substeps) {
    openvdb::initialize();
    sim::Frame frame;
    for (const auto& visibility : substeps) {
      frame.substeps.emplace_back();
      frame.substeps.back().visibility = visibility;
    }
    addSight(frame, grids, metadata);
  }

  std::vector<sim::Substep> readBack(std::size_t substeps) const {
    const Scratch scratch;
    sim::writeGrids(grids, metadata, scratch.path / "f.vdb");
    openvdb::io::File file((scratch.path / "f.vdb").string());
    file.open(false);
    std::vector<sim::Substep> read(substeps);
    readSight(file, read);
    return read;
  }
};

bool sameSight(const sim::Visibility& a, const sim::Visibility& b) {
  if (a.origins().size() != b.origins().size()) return false;
  for (const sim::Coord& origin : a.origins()) {
    const sim::Visibility::Leaf *first = a.leaf(origin), *second = b.leaf(origin);
    if (second == nullptr) return false;
    for (std::size_t cell = 0; cell < first->size(); ++cell)
      if ((*first)[cell].bits != (*second)[cell].bits) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("recorded sight: each substep has its own, those of one have it once in the file", "[caches]") {
  const auto first = sightOf({sim::Coord(-8, 0, 16), sim::Coord(0), sim::Coord(4096, -4096, 8)}, 1),
             second = sightOf({sim::Coord(0)}, 2), nowhere = sightOf({}, 3);
  const Sights sights({first, first, nullptr, second, first, nowhere});
  CHECK(sights.grids.size() == 3 * 2);
  const std::vector<sim::Substep> read = sights.readBack(6);
  REQUIRE(read[0].visibility);
  CHECK(sameSight(*first, *read[0].visibility));
  CHECK(read[1].visibility == read[0].visibility);
  CHECK(read[4].visibility == read[0].visibility);
  CHECK(read[2].visibility == nullptr);
  REQUIRE(read[3].visibility);
  CHECK(sameSight(*second, *read[3].visibility));
  REQUIRE(read[5].visibility);
  CHECK(read[5].visibility->empty());
}

TEST_CASE("recorded sight: nothing where all is visible", "[caches]") {
  Sights sights({nullptr, nullptr});
  CHECK(sights.grids.empty());
  CHECK(sights.metadata.metaCount() == 0);
  const auto other = openvdb::FloatGrid::create();
  other->setName("surface");
  sights.grids.push_back(other);
  for (const sim::Substep& substep : sights.readBack(2)) CHECK(substep.visibility == nullptr);
}

TEST_CASE("recorded sight: what a file lacks is told", "[caches]") {
  const auto sight = sightOf({sim::Coord(0), sim::Coord(8, 0, 0)}, 4);
  const Sights good({sight});
  REQUIRE(good.readBack(1)[0].visibility);
  Sights lacks = good;
  lacks.grids.pop_back();
  CHECK_THROWS_AS(lacks.readBack(1), openvdb::Exception);
  Sights other = good;
  const auto floats = openvdb::FloatGrid::create();
  floats->setName("sight.0.0");
  other.grids[0] = floats;
  CHECK_THROWS_AS(other.readBack(1), openvdb::Exception);
  Sights torn = good;
  torn.grids[1] = Sights({sightOf({sim::Coord(0)}, 4)}).grids[1];
  CHECK_THROWS_AS(torn.readBack(1), openvdb::Exception);
}

TEST_CASE("recorded sight: what thin walls hide returns", "[caches]") {
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
