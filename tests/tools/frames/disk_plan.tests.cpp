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
    return tools::plannedDisk(scene, frames, points, 1000.0, true, formats);
  };
  const tools::DiskPlan one = plan(1, 1e5, {Format::ply}), ten = plan(10, 1e5, {Format::ply}),
                        many = plan(10, 1e5, {Format::ply, Format::usda});
  CHECK(ten.surfaces == Approx(10.0 * one.surfaces));
  CHECK(ten.pictures == Approx(10.0 * one.pictures));
  CHECK(ten.state == one.state);
  CHECK(many.surfaces > ten.surfaces);
  CHECK(plan(1, 2e5, {Format::ply}).surfaces == Approx(2.0 * one.surfaces));
  CHECK(tools::plannedDisk(scene, 10, 1e5, 0.0, false, {Format::ply}).pictures == 0.0);
}

TEST_CASE("disk plan: a warning says when what is free will not do; an earlier run's files count as free",
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
