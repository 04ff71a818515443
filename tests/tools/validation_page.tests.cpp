#include "tools/validation_page.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>

using namespace fluidtex;
using tools::updatedPage;
using validation::Row;

namespace {

const std::string kPage =
    "# Validation\n\nOf the solver:\n\n"
    "| test | cells | measure | value | must |\n|---|---|---|---|---|\n| old | 8 | gone | 1 | 0.5 |\n\n"
    "| topic | tests | bars | hold | of these reach the goal | fail |\n|---|---|---|---|---|---|\n"
    "| [Waves](#waves) | `wave` | 0 | 0 | 0 | 7 |\n\n"
    "### Waves\n\n"
    "| test | cells | measure | value | must | goal | published | |\n|---|---|---|---|---|---|---|---|\n"
    "| wave | 16 | max \\|u\\|, m/s | 3 | 4 | 1 |  | holds |\n"
    "| wave | 32 | max \\|u\\|, m/s | 2 | 4 | 1 |  | holds |\n\n"
    "Prose.\n";

Row waveRow(int resolution, double value) {
  Row row;
  row.test = "wave";
  row.resolution = resolution;
  row.measure = "max |u|, m/s";
  row.value = value;
  row.must = 4.0;
  row.goal = 1.0;
  return row;
}

}  // namespace

TEST_CASE("validation page: figures take the place of those of the same test, cells and measure", "[tools]") {
  Row worse = waveRow(16, 5.123), better = waveRow(32, 0.9);
  better.published = {{1.25, "somebody, 2002"}, {0.0, "the exact one"}};
  const std::string page = updatedPage(kPage, {worse, better});
  CHECK(page ==
        "# Validation\n\nOf the solver:\n\n"
        "| test | cells | measure | value | must |\n|---|---|---|---|---|\n"
        "| wave | 16 | max \\|u\\|, m/s | 5.12 | 4 |\n\n"
        "| topic | tests | bars | hold | of these reach the goal | fail |\n|---|---|---|---|---|---|\n"
        "| [Waves](#waves) | `wave` | 2 | 1 | 1 | 1 |\n\n"
        "### Waves\n\n"
        "| test | cells | measure | value | must | goal | published | |\n|---|---|---|---|---|---|---|---|\n"
        "| wave | 16 | max \\|u\\|, m/s | 5.12 | 4 | 1 |  | **fails** |\n"
        "| wave | 32 | max \\|u\\|, m/s | 0.9 | 4 | 1 | 1.25 somebody, 2002; 0 the exact one | goal |\n\n"
        "Prose.\n");
}

TEST_CASE("validation page: a new row comes after the others of its test", "[tools]") {
  Row order = waveRow(64, 1.5);
  order.measure = "order";
  order.must = 1.9;
  order.goal = {};
  order.atLeast = true;
  const std::string page = updatedPage(kPage, {order});
  CHECK(page.find("| wave | 32 | max \\|u\\|, m/s | 2 | 4 | 1 |  | holds |\n"
                  "| wave | 64 | order | 1.5 | >= 1.9 |  |  | **fails** |\n\nProse.") != page.npos);
}

TEST_CASE("validation page: a row without a bar says where it reaches its goal", "[tools]") {
  Row reached = waveRow(16, 0.5), far = waveRow(32, 3.0);
  reached.must = far.must = {};
  const std::string page = updatedPage(kPage, {reached, far});
  CHECK(page.find("| wave | 16 | max \\|u\\|, m/s | 0.5 |  | 1 |  | goal |\n"
                  "| wave | 32 | max \\|u\\|, m/s | 3 |  | 1 |  |  |\n") != page.npos);
}

TEST_CASE("validation page: the same figures leave it as it was", "[tools]") {
  const std::string page = updatedPage(kPage, {waveRow(16, 3.0)});
  CHECK(updatedPage(page, {waveRow(16, 3.0)}) == page);
}

TEST_CASE("validation page: a test without a table is named", "[tools]") {
  Row row = waveRow(16, 1.0);
  row.test = "tide";
  CHECK_THROWS_WITH(updatedPage(kPage, {row}), Catch::Contains("tide"));
}

TEST_CASE("validation page: the project's own have a row of every test, and count themselves right",
          "[tools]") {
  const std::string page = readBytes(FLUIDTEX_SOURCE "/docs/results/validation.md");
  const std::string figures = readBytes(FLUIDTEX_SOURCE "/docs/results/figures.md");
  CHECK(updatedPage(page, {}) == page);
  CHECK(updatedPage(figures, {}) == figures);
  for (const validation::Case& test : validation::cases()) {
    INFO(test.name);
    const std::string row = "\n| " + test.name + " | ";
    CHECK((page.find(row) != page.npos || figures.find(row) != figures.npos));
  }
}
