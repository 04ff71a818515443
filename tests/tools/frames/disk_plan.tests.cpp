#include "tools/frames/disk_plan.h"

#include "tests/scratch.h"

#include <catch2/catch.hpp>

#include <fstream>

using namespace fluidtex;
using tools::Format;

TEST_CASE("disk plan: surfaces grow with frames, points and formats, the state does not grow with frames",
          "[tools]") {
  const scenes::Scene scene;
  const auto plan = [&](int frames, double points, const std::vector<Format>& formats) {
    return tools::plannedDisk(scene, frames, points, 1000.0, 1e6, true, formats);
  };
  const tools::DiskPlan one = plan(1, 1e5, {Format::ply}), ten = plan(10, 1e5, {Format::ply}),
                        many = plan(10, 1e5, {Format::ply, Format::usda});
  CHECK(ten.surfaces == Approx(10.0 * one.surfaces));
  CHECK(ten.pictures == Approx(10.0 * one.pictures));
  CHECK(ten.state == one.state);
  CHECK(many.surfaces > ten.surfaces);
  CHECK(plan(1, 2e5, {Format::ply}).surfaces == Approx(2.0 * one.surfaces));
  CHECK(tools::plannedDisk(scene, 10, 1e5, 0.0, 1e6, false, {Format::ply}).pictures == 0.0);
}

TEST_CASE("disk plan: the page grows to its bound, and copies of pictures come on top", "[tools]") {
  const scenes::Scene scene;
  const auto page = [&](int frames, double points, double copied) {
    return tools::plannedDisk(scene, frames, points, 0.0, copied, true, {Format::ply}).page;
  };
  CHECK(page(2, 1e4, 0.0) > page(1, 1e4, 0.0));
  CHECK(page(2, 2e4, 0.0) > page(2, 1e4, 0.0));
  CHECK(page(10000, 1e7, 0.0) < 30e6);
  CHECK(page(1, 1e4, 4e6) > page(1, 1e4, 0.0) + 4e6);
}

TEST_CASE("disk plan: sizes are written as people write them", "[tools]") {
  tools::DiskPlan plan;
  plan.surfaces = 5.96e8;
  plan.state = 4e6;
  plan.page = 1e6;
  CHECK(tools::textOf(plan) == "about 600 MB: surfaces 600 MB, state/ 4 MB, report and exemplar 1 MB");
}

TEST_CASE("disk plan: a warning says when what is free will not do, and an earlier run's files count as free",
          "[tools]") {
  const Scratch scratch;
  const std::filesystem::path out = scratch.path / "not" / "there yet";
  const std::optional<double> available = tools::freeBytes(out);
  REQUIRE(available);
  REQUIRE(*available > 1e6);
  tools::DiskPlan plan;
  CHECK(tools::diskNote(plan, out).empty());
  plan.surfaces = *available + 5e8;
  CHECK_THAT(tools::diskNote(plan, out), Catch::Contains("there yet: the run is going to take about") &&
                                             Catch::Contains("state/") && Catch::Contains("--out"));
  // A file with a hole of a terabyte, which takes nothing.
  std::filesystem::create_directories(out / "surface");
  std::ofstream(out / "surface" / "0001.ply") << "x";
  std::filesystem::resize_file(out / "surface" / "0001.ply", std::uintmax_t{1} << 40);
  CHECK(tools::diskNote(plan, out).empty());
}
