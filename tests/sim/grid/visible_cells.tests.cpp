#include "sim/grid/visible_cells.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;

TEST_CASE("visible cells: all are seen until one is hidden, which hides no other", "[sim]") {
  for (int hidden = 0; hidden < VisibleCells::kCount; ++hidden) {
    VisibleCells cells;
    REQUIRE(cells.seesAll());
    cells.hide(hidden);
    REQUIRE_FALSE(cells.seesAll());
    REQUIRE_FALSE(cells.isInSolid());
    for (int at = 0; at < VisibleCells::kCount; ++at) REQUIRE(cells.sees(at) == (at != hidden));
  }
}

TEST_CASE("visible cells: a cell in a solid sees no less for it", "[sim]") {
  VisibleCells cells;
  cells.setInSolid();
  CHECK(cells.isInSolid());
  CHECK(cells.seesAll());
  for (int at = 0; at < VisibleCells::kCount; ++at) REQUIRE(cells.sees(at));
}

TEST_CASE("visible cells: the middle and its strides lead to every cell of 5 x 5 x 5", "[sim]") {
  using Cells = VisibleCells;
  constexpr int kCorner = Cells::kReach * (Cells::kStride[0] + Cells::kStride[1] + Cells::kStride[2]);
  CHECK(Cells::kCount == 125);
  CHECK(Cells::kMiddle - kCorner == 0);
  CHECK(Cells::kMiddle + kCorner == Cells::kCount - 1);
}
