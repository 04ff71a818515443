#include "pipeline/liquid_plan.h"

#include "sim/grid/mac_grid.h"
#include "sim/shapes/shape_distance.h"

#include <catch2/catch.hpp>

using namespace fluidtex;

namespace {

sim::Options twoBodies(int resolution) {
  sim::Options options;
  options.size = {1.0, 0.73, 0.52};  // no whole number of cells
  options.resolution = resolution;
  options.liquid.push_back({{sim::Box{{-0.1, 0.0, 0.0}, {0.45, 0.9, 0.2}}}});
  options.liquid.push_back({{sim::Sphere{{0.6, 0.4, 0.3}, 0.17}}, {}, 0.5});
  options.solids.resize(2);
  options.solids[0].shape = {sim::Sphere{{0.3, 0.3, 0.1}, 0.11}};
  options.solids[1].shape = {sim::Sphere{{0.3, 0.6, 0.1}, 0.11}};
  options.solids[1].from = 0.5;
  return options;
}

}  // namespace

TEST_CASE("liquid plan: the cells are those that visiting every one finds", "[pipeline]") {
  for (const int resolution : {24, 100}) {
    const sim::Options options = twoBodies(resolution);
    const double h = options.voxelSize();
    const openvdb::Coord count = sim::cellCount(options.size, h);
    const sim::ShapeDistance box(options.liquid[0].shape, h), ball(options.liquid[1].shape, h),
        post(options.solids[0].shape, h);
    std::int64_t cells = 0, atStart = 0;
    for (int k = 0; k < count.z(); ++k)
      for (int j = 0; j < count.y(); ++j)
        for (int i = 0; i < count.x(); ++i) {
          const sim::Vec3d x = h * sim::Vec3d(i + 0.5, j + 0.5, k + 0.5);
          const bool inside =
              x[0] < options.size[0] && x[1] < options.size[1] && x[2] < options.size[2] && post(x) >= 0.0;
          atStart += inside && box(x) < 0.0;
          cells += inside && (box(x) < 0.0 || ball(x) < 0.0);
        }
    const pipeline::LiquidPlan plan = pipeline::planLiquid(options);
    CHECK(plan.cells == cells);
    CHECK(plan.atStart == atStart);
    CHECK(plan.cells > plan.atStart);
  }
}

TEST_CASE("liquid plan: the surface's cells tell its area, the parts at the walls among them", "[pipeline]") {
  sim::Options options;
  options.resolution = 200;
  options.liquid.push_back({{sim::Sphere{{0.5, 0.5, 0.5}, 0.3}}});
  const double h = options.voxelSize();
  CHECK(h * h * static_cast<double>(pipeline::planLiquid(options).surfaceCells) ==
        Approx(4.0 * 3.14159265 * 0.09).epsilon(0.03));
  options.liquid[0].shape.kind = sim::Box{{0.0, 0.0, 0.0}, {1.0, 1.0, 0.5}};
  CHECK(h * h * static_cast<double>(pipeline::planLiquid(options).surfaceCells) == Approx(4.0).epsilon(0.03));
}

TEST_CASE("liquid plan: the finest grid is counted without visiting every cell", "[pipeline]") {
  sim::Options options;
  options.resolution = 2048;
  options.liquid.push_back({{sim::Box{{0.0, 0.0, 0.0}, {0.5, 1.0, 0.001}}}});
  options.liquid.push_back({{sim::HalfSpace{{0.0, 0.0, 0.25}, {0.0, 0.0, 1.0}}}});
  options.size = {1.0, 0.05, 0.5};
  CHECK(pipeline::planLiquid(options).cells == 2048LL * 102 * 512);
}

TEST_CASE("liquid plan: far apart in a domain without bounds", "[pipeline]") {
  sim::Options options;
  options.resolution = 32;
  options.liquid.push_back({{sim::Box{{-0.5, 0.0, 0.0}, {0.5, 0.5, 0.5}}}});
  options.liquid.push_back({{sim::Sphere{{-20000.0, 20000.0, 30000.0}, 0.25}}});
  const std::int64_t bounded = pipeline::planLiquid(options).cells;
  CHECK(bounded == 16 * 16 * 16);
  options.sides.fill(sim::Side::unbounded);
  const std::int64_t cells = pipeline::planLiquid(options).cells;
  CHECK(std::abs(static_cast<double>(cells) - (2 * 16 * 16 * 16 + 2145)) < 40.0);
}
