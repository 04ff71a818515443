#include "sim/shape.h"

#include <catch2/catch.hpp>

using namespace fluidtex::sim;

TEST_CASE("mesh sequence: the number stands in the last part of the name") {
  MeshSequence sequence;
  sequence.first = 9;
  sequence.files = "50%d/rock_%03d.obj";
  CHECK(sequence.fileOf(0) == "50%d/rock_009.obj");
  CHECK(sequence.fileOf(991) == "50%d/rock_1000.obj");
  sequence.files = "%d.ply";
  CHECK(sequence.fileOf(1) == "10.ply");
}

TEST_CASE("mesh sequence: files are a frame apart from its start on, the last one counts", "[sim]") {
  MeshSequence sequence;
  sequence.first = 3;
  sequence.last = 6;
  sequence.frameRate = 8.0;
  sequence.start = 0.5;
  CHECK(sequence.count() == 4);
  CHECK(sequence.timeOf(0) == 0.5);
  CHECK(sequence.timeOf(3) == 0.875);
}
