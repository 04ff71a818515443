#include "tools/frames/visible_solids.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex;
using sim::Vec3d;
using tools::VisibleSolids;

namespace {

sim::Options withSolid(const sim::Shape& shape) {
  sim::Options options;
  options.resolution = 20;
  sim::Solid solid;
  solid.name = "block";
  solid.shape = shape;
  options.solids.push_back(solid);
  return options;
}

openvdb::BBoxd boundsOf(const render::Solid& solid) {
  openvdb::BBoxd bounds;
  for (const texture::Vec3f& x : solid.positions) bounds.expand(Vec3d(x));
  return bounds;
}

bool isAbout(const openvdb::BBoxd& bounds, const Vec3d& low, const Vec3d& high) {
  CAPTURE(bounds.min(), bounds.max());
  return (bounds.min() - low).length() < 1e-3 && (bounds.max() - high).length() < 1e-3;
}

const sim::Shape kBlock{sim::Box{Vec3d(0.2, 0.3, 0.4), Vec3d(0.5, 0.6, 0.7)}};

}  // namespace

TEST_CASE("visible solids: each is there from its time on until it ends, unless it is not to be seen",
          "[tools]") {
  sim::Options options = withSolid(kBlock);
  options.solids.push_back(options.solids[0]);
  options.solids.push_back(options.solids[0]);
  options.solids[0].from = 1.0;
  options.solids[0].until = 2.0;
  options.solids[0].color = Vec3d(0.1, 0.2, 0.3);
  options.solids[1].color = Vec3d(0.4, 0.5, 0.6);
  options.solids[2].visible = false;
  VisibleSolids solids(options);
  for (const auto& [time, count] :
       {std::pair{0.0, 1}, std::pair{0.999, 1}, std::pair{1.0, 2}, std::pair{1.999, 2}, std::pair{2.0, 1}}) {
    CAPTURE(time);
    const std::vector<render::Solid>& seen = solids.at(time);
    REQUIRE(int(seen.size()) == count);
    CHECK(seen.front().color == options.solids[count == 2 ? 0 : 1].color);
    CHECK(seen.back().color == options.solids[1].color);
    for (const render::Solid& solid : seen)
      CHECK(isAbout(boundsOf(solid), Vec3d(0.2, 0.3, 0.4), Vec3d(0.5, 0.6, 0.7)));
  }
}

TEST_CASE("visible solids: what stays as it is, is not made again", "[tools]") {
  sim::Options options = withSolid(kBlock);
  options.solids[0].until = 3.0;
  options.solids[0].keyframes = {{1.0, Vec3d(0.0), 0.0}, {2.0, Vec3d(0.1, 0.0, 0.0), 0.0}};
  VisibleSolids solids(options);
  const texture::Vec3f* rests = solids.at(0.0).front().positions.data();
  CHECK(solids.at(0.5).front().positions.data() == rests);
  CHECK(isAbout(boundsOf(solids.at(1.5).front()), Vec3d(0.25, 0.3, 0.4), Vec3d(0.55, 0.6, 0.7)));
  const texture::Vec3f* moved = solids.at(2.0).front().positions.data();
  CHECK(isAbout(boundsOf(solids.at(2.5).front()), Vec3d(0.3, 0.3, 0.4), Vec3d(0.6, 0.6, 0.7)));
  CHECK(solids.at(2.9).front().positions.data() == moved);
  // Back in time too.
  CHECK(isAbout(boundsOf(solids.at(0.0).front()), Vec3d(0.2, 0.3, 0.4), Vec3d(0.5, 0.6, 0.7)));
}

TEST_CASE("visible solids: they end with the domain, but where that has no end", "[tools]") {
  sim::Options options = withSolid({sim::Box{Vec3d(-0.5, 0.3, 0.4), Vec3d(1.5, 0.6, 0.7)}});
  {
    VisibleSolids solids(options);
    CHECK(isAbout(boundsOf(solids.at(0.0).front()), Vec3d(0.0, 0.3, 0.4), Vec3d(1.0, 0.6, 0.7)));
  }
  options.sides[1] = sim::Side::unbounded;
  VisibleSolids solids(options);
  CHECK(isAbout(boundsOf(solids.at(0.0).front()), Vec3d(0.0, 0.3, 0.4), Vec3d(1.5, 0.6, 0.7)));
}

TEST_CASE("visible solids: what has no end itself is drawn in the domain alone", "[tools]") {
  sim::Options options = withSolid({sim::HalfSpace{Vec3d(0.0, 0.0, 0.25), Vec3d(0.0, 0.0, 1.0)}});
  options.sides[0] = options.sides[1] = sim::Side::unbounded;
  VisibleSolids solids(options);
  CHECK(isAbout(boundsOf(solids.at(0.0).front()), Vec3d(0.0), Vec3d(1.0, 1.0, 0.25)));
}
