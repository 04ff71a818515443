#include "sim/step/state_io.h"
#include "sim/grid/mac_grid.h"
#include "sim/step/solver.h"

#include <openvdb/io/File.h>
#include <catch2/catch.hpp>

#include <cstring>
#include <fstream>

using namespace fluidtex::sim;

namespace {

std::filesystem::path scratch(const char* name) {
  return std::filesystem::temp_directory_path() / name;
}

State someState() {
  State state;
  state.frame = 17;
  state.time = 0.1 + 0.2;  // not a short decimal
  state.steps = 123456789012;
  state.poured = {true, false, true};
  state.markers = {{Coord(-8, 0, 16), {{0.1f, 7.9999995f, 3.0f, -0.5f}, {1.0f / 3.0f, 0.0f, 2.5f, 0.1f}}},
                   {Coord(0, 0, 8), {{4.0f, 5.0f, 6.0f, 0.25f}}}};
  state.phi = makePhi(0.03, 0.21);
  const Velocity velocity = makeVelocity(0.03);
  state.velocity.component[0] = velocity.component[0];
  state.velocity.component[1] = velocity.component[1];
  state.velocity.component[2] = velocity.component[2];
  const Velocity expansion = makeVelocity(0.03), acceleration = makeVelocity(0.03);
  for (int axis = 0; axis < 3; ++axis) {
    expansion.component[axis]->setName(std::array{"su", "sv", "sw"}[axis]);
    acceleration.component[axis]->setName(std::array{"au", "av", "aw"}[axis]);
  }
  state.expansion.component[0] = expansion.component[0];
  state.expansion.component[1] = expansion.component[1];
  state.expansion.component[2] = expansion.component[2];
  state.acceleration.component[0] = acceleration.component[0];
  state.acceleration.component[1] = acceleration.component[1];
  state.acceleration.component[2] = acceleration.component[2];
  state.deficit = FloatGrid::create(0.0f);
  state.deficit->setTransform(cellTransform(0.03));
  state.deficit->setName("deficit");
  // Values that a half float or a text would not keep; some inactive beside active ones.
  for (int n = 0; n < 200; ++n) {
    const Coord c(n % 7, n % 11 - 5, n / 3);
    state.phi->tree().setValueOn(c, 0.1f / static_cast<float>(n + 1));
    if (n % 3 == 0) state.phi->tree().setValueOff(c, -0.21f);
    state.deficit->tree().setValueOn(c, 1e-6f * static_cast<float>(n));
    state.expansion.component[1]->tree().setValueOn(c, -1e-3f / static_cast<float>(n + 1));
    state.velocity.component[2]->tree().setValueOn(c, std::nextafter(1.0f, 2.0f) * static_cast<float>(n));
  }
  return state;
}

}  // namespace

TEST_CASE("state: comes back bit for bit") {
  const auto file = scratch("fluidtex_state_roundtrip.vdb");
  const State out = someState();
  writeState(out, file);
  const State in = readState(file);
  std::filesystem::remove(file);
  CHECK(in.frame == out.frame);
  CHECK(in.time == out.time);
  CHECK(in.poured == out.poured);
  CHECK(in.steps == out.steps);
  REQUIRE(in.markers.size() == out.markers.size());
  for (std::size_t n = 0; n < in.markers.size(); ++n) {
    CHECK(in.markers[n].origin == out.markers[n].origin);
    REQUIRE(in.markers[n].markers.size() == out.markers[n].markers.size());
    CHECK(std::memcmp(in.markers[n].markers.data(), out.markers[n].markers.data(),
                      in.markers[n].markers.size() * sizeof(Marker)) == 0);
  }
  const auto grids = [](const State& state) {
    return std::vector<FloatGrid::Ptr>{state.phi,
                                       state.velocity.component[0],
                                       state.velocity.component[1],
                                       state.velocity.component[2],
                                       state.deficit,
                                       state.expansion.component[0],
                                       state.expansion.component[1],
                                       state.expansion.component[2],
                                       state.acceleration.component[0]};
  };
  const auto a = grids(out), b = grids(in);
  CHECK(in.temperature == nullptr);
  for (std::size_t n = 0; n < a.size(); ++n) {
    CHECK(a[n]->transform() == b[n]->transform());
    CHECK(a[n]->background() == b[n]->background());
    CHECK(a[n]->getGridClass() == b[n]->getGridClass());
    CHECK(a[n]->getName() == b[n]->getName());
    CHECK(a[n]->tree().hasSameTopology(b[n]->tree()));
    auto other = b[n]->tree().cbeginLeaf();
    for (auto leaf = a[n]->tree().cbeginLeaf(); leaf; ++leaf, ++other) {
      REQUIRE(other);
      CHECK(std::memcmp(leaf->buffer().data(), other->buffer().data(), sizeof(float) * 512) == 0);
    }
  }
}

TEST_CASE("state: what cannot be read is said") {
  CHECK_THROWS_AS(readState(scratch("fluidtex_no_such_state.vdb")), openvdb::IoError);
  const auto file = scratch("fluidtex_state_cut.vdb");
  writeState(someState(), file);
  const auto size = std::filesystem::file_size(file);
  for (const auto keep : {std::uintmax_t{0}, std::uintmax_t{100}, size / 2}) {
    std::filesystem::resize_file(file, keep);
    CHECK_THROWS_AS(readState(file), openvdb::IoError);
    writeState(someState(), file);
  }
  // A proper file of something else.
  openvdb::io::File other(file.string());
  other.write(openvdb::GridCPtrVec{someState().phi});
  other.close();
  CHECK_THROWS_AS(readState(file), openvdb::IoError);
  std::filesystem::remove(file);
}

TEST_CASE("state: what cannot be written is said") {
  CHECK_THROWS_AS(writeState(someState(), scratch("fluidtex_no_such_folder") / "state.vdb"),
                  openvdb::IoError);
}
