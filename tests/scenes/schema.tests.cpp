#include "scenes/schema.h"

#include "tests/scenes/full_scene.h"
#include "tests/scenes/recorder.h"

#include <catch2/catch.hpp>

#include <algorithm>

namespace fluidtex::scenes {

namespace {

const sim::Box kRoom{Vec3d(0.0), Vec3d(2.0, 1.0, 1.0)};

// The room, but endless on one side, counted as sim::Options::sides.
sim::Box endlessAt(int side) {
  sim::Options options;
  options.size = kRoom.max;
  options.sides[std::size_t(side)] = sim::Side::unbounded;
  return domainOf(options);
}

// It has the shape with this index.
class HavingShape : public Recorder {
 public:
  explicit HavingShape(int index) : m_index(index) {}
  int alternative(int, const std::vector<std::string>& keys, Need) override {
    CHECK(keys == kShapeKeys);
    return m_index;
  }

 private:
  int m_index;
};

bool reaches(sim::Shape shape) {
  return reachesDomain(shape, kRoom);
}

}  // namespace

TEST_CASE("schema: no key is named twice in a table", "[scenes]") {
  const SceneFolder folder;
  for (const std::string& text : {kGoodScene, kFullScene}) {
    Scene scene = loadScene(folder.write("s.toml", text));
    Recorder recorder;
    describe(recorder, scene);
    std::vector<std::string> keys;
    for (const std::string& key : recorder.keys) keys.push_back(key.substr(0, key.find(' ')));
    std::sort(keys.begin(), keys.end());
    CHECK(std::adjacent_find(keys.begin(), keys.end()) == keys.end());
    CHECK(std::count(recorder.calls.begin(), recorder.calls.end(), "leave") ==
          std::count_if(recorder.calls.begin(), recorder.calls.end(),
                        [](const std::string& call) { return call.starts_with("enter "); }));
  }
}

TEST_CASE("schema: a visit changes nothing that the visitor does not change", "[scenes]") {
  const SceneFolder folder;
  Scene scene = loadScene(folder.write("s.toml", kFullScene));
  Recorder first, second;
  describe(first, scene);
  describe(second, scene);
  CHECK(first.calls == second.calls);
  CHECK(scene.sim.solids.size() == 3);
  CHECK(std::holds_alternative<sim::MeshSequence>(scene.sim.solids[2].shape.kind));
  CHECK(scene.texture.exemplar.maps.size() == 2);
}

TEST_CASE("schema: no exemplar is asked for where only the liquid is looked at", "[scenes]") {
  const auto asksFor = [](Need texture, const std::string& key) {
    Scene scene;
    Recorder recorder;
    describe(recorder, scene, texture);
    return std::count(recorder.keys.begin(), recorder.keys.end(), key) == 1;
  };
  CHECK(asksFor(Need::required, "texture.exemplar"));
  CHECK(asksFor(Need::optional, "texture.exemplar (absent)"));
  CHECK(asksFor(Need::optional, "texture.toroidal"));
}

TEST_CASE("schema: a shape's key makes that kind of shape, with its defaults unless it was that",
          "[scenes]") {
  REQUIRE(kShapeKeys.size() == std::variant_size_v<decltype(sim::Shape::kind)>);
  for (std::size_t kind = 0; kind < kShapeKeys.size(); ++kind) {
    INFO(kShapeKeys[kind]);
    sim::Shape shape;
    if (kind == 0) shape.kind = sim::Sphere{};
    HavingShape visitor{int(kind)};
    describeShape(visitor, shape);
    CHECK(shape.kind.index() == kind);
    CHECK(visitor.calls.front() == "enter " + kShapeKeys[kind]);
  }
  sim::Shape same{sim::Sphere{Vec3d(3.0), 4.0}}, other{sim::Box{Vec3d(5.0), Vec3d(6.0)}};
  HavingShape sphere(1), none(-1);
  describeShape(sphere, same);
  CHECK(std::get<sim::Sphere>(same.kind).radius == 4.0);
  describeShape(sphere, other);
  CHECK(std::get<sim::Sphere>(other.kind).radius == sim::Sphere{}.radius);
  // A reader that finds none leaves it.
  describeShape(none, other);
  CHECK(none.calls.empty());
  CHECK(std::holds_alternative<sim::Sphere>(other.kind));
}

TEST_CASE("schema: the words of faces stand in the order of the faces", "[scenes]") {
  using sim::DomainFace;
  const auto wordOf = [](DomainFace face) { return kDomainFaces.at(std::size_t(face)); };
  CHECK(wordOf(DomainFace::all) == "all");
  CHECK(wordOf(DomainFace::xLow) == "x_low");
  CHECK(wordOf(DomainFace::xHigh) == "x_high");
  CHECK(wordOf(DomainFace::yLow) == "y_low");
  CHECK(wordOf(DomainFace::yHigh) == "y_high");
  CHECK(wordOf(DomainFace::zLow) == "z_low");
  CHECK(wordOf(DomainFace::zHigh) == "z_high");
}

TEST_CASE("schema: the domain is infinite on its unbounded sides alone", "[scenes]") {
  for (int side = 0; side < 6; ++side) {
    const sim::Box domain = endlessAt(side);
    for (int other = 0; other < 6; ++other) {
      const int axis = other / 2;
      const double face = other % 2 == 0 ? domain.min[axis] : domain.max[axis],
                   bounded = other % 2 == 0 ? kRoom.min[axis] : kRoom.max[axis];
      CHECK(face == (other != side ? bounded : other % 2 == 0 ? -sim::kForever : sim::kForever));
    }
  }
}

TEST_CASE("schema: a shape that only touches the domain does not reach it", "[scenes]") {
  CHECK_FALSE(reaches({sim::Box{Vec3d(2.0, 0.0, 0.0), Vec3d(3.0, 1.0, 1.0)}}));
  CHECK(reaches({sim::Box{Vec3d(1.99, 0.0, 0.0), Vec3d(3.0, 1.0, 1.0)}}));
  // 0.3, 0.4 away from an edge.
  CHECK_FALSE(reaches({sim::Sphere{Vec3d(1.0, 1.3, 1.4), 0.499}}));
  CHECK(reaches({sim::Sphere{Vec3d(1.0, 1.3, 1.4), 0.501}}));
  CHECK_FALSE(reaches({sim::HalfSpace{Vec3d(0.0), Vec3d(1.0, 1.0, 1.0)}}));
  CHECK(reaches({sim::HalfSpace{Vec3d(0.01), Vec3d(1.0, 1.0, 1.0)}}));
  CHECK_FALSE(reaches({sim::HalfSpace{Vec3d(2.0, 1.0, 1.0), Vec3d(-1.0, 0.0, 0.0)}}));
  // Along x it reaches sideways, not beyond its ends.
  CHECK(reaches({sim::Cylinder{Vec3d(0.0, 1.4, 0.5), Vec3d(1.0, 1.4, 0.5), 0.41}}));
  CHECK_FALSE(reaches({sim::Cylinder{Vec3d(0.0, 1.4, 0.5), Vec3d(1.0, 1.4, 0.5), 0.39}}));
  CHECK_FALSE(reaches({sim::Cylinder{Vec3d(3.0, 0.5, 0.5), Vec3d(2.1, 0.5, 0.5), 5.0}}));
  sim::HeightField ground;
  ground.low = -2.0;
  ground.high = -1.0;
  CHECK_FALSE(reaches({ground}));
  ground.translate = Vec3d(0.0, 0.0, 1.5);
  CHECK(reaches({ground}));
}

TEST_CASE("schema: meshes count as inside, parts as what they make", "[scenes]") {
  const sim::Shape outside{sim::Sphere{Vec3d(9.0), 1.0}}, inside{sim::Sphere{Vec3d(1.0, 0.5, 0.5), 0.2}};
  CHECK(reaches({sim::MeshShape{}}));
  CHECK(reaches({sim::MeshSequence{}}));
  CHECK(reaches({sim::Union{{outside, inside}}}));
  CHECK_FALSE(reaches({sim::Union{{outside, outside}}}));
  CHECK_FALSE(reaches({sim::Union{}}));
  CHECK(reaches({sim::Difference{{inside, outside}}}));
  CHECK_FALSE(reaches({sim::Difference{{outside, inside}}}));
  CHECK_FALSE(reaches({sim::Difference{}}));
}

TEST_CASE("schema: a half-space ends in an endless domain if its plane shuts the endless side", "[scenes]") {
  const sim::Shape up{sim::HalfSpace{Vec3d(0.0, 0.0, 0.5), Vec3d(0.0, 0.0, 1.0)}},
      askew{sim::HalfSpace{Vec3d(0.0, 0.0, 0.5), Vec3d(0.3, 0.0, 1.0)}};
  CHECK(endsInDomain(up, kRoom));
  for (int side = 0; side < 6; ++side) {
    INFO(side);
    CHECK(endsInDomain(up, endlessAt(side)) == (side == 5));
    CHECK(endsInDomain(askew, endlessAt(side)) == (side == 1 || side == 5));
  }
}

TEST_CASE("schema: what has a size of its own ends anywhere, ground upwards alone", "[scenes]") {
  const sim::Shape space{sim::HalfSpace{}}, ball{sim::Sphere{}};
  for (int side = 0; side < 6; ++side) {
    INFO(side);
    const sim::Box domain = endlessAt(side);
    for (const sim::Shape& shape : {sim::Shape{sim::Box{}}, ball, sim::Shape{sim::Cylinder{}},
                                    sim::Shape{sim::MeshShape{}}, sim::Shape{sim::MeshSequence{}}})
      CHECK(endsInDomain(shape, domain));
    CHECK(endsInDomain({sim::HeightField{}}, domain) == (side == 5));
    // Of a union all parts have to end, of a difference the first alone.
    CHECK(endsInDomain({sim::Union{{ball, space}}}, domain) == endsInDomain(space, domain));
    CHECK(endsInDomain({sim::Difference{{ball, space}}}, domain));
    CHECK(endsInDomain({sim::Difference{{space, ball}}}, domain) == endsInDomain(space, domain));
  }
}

}  // namespace fluidtex::scenes
