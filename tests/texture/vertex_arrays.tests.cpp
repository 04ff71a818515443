#include "texture/vertex_arrays.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;

TEST_CASE("vertex arrays: every array of a surface is visited, maps by name too", "[texture]") {
  TexturedSurface surface;
  forEachVertexArray(surface, [](auto& values, Array) { values.resize(4); });
  CHECK(surface.positions.size() == 4);
  CHECK(surface.foam.size() == 4);
  CHECK(surface.fading.speed.size() == 4);
  CHECK(surface.previousPosition.size() == 4);
  CHECK(surface.contact.size() == 4);
  surface.maps["height"].resize(3);
  surface.vectors["bump"].resize(4);
  int arrays = 0, wrong = 0;
  forEachVertexArray(surface, [&](const auto& values, Array array) {
    ++arrays;
    wrong += !fits(values, array, 4);
  });
  CHECK(arrays == 6 + 13 + 2 + 2);
  CHECK(wrong == 1);
}

TEST_CASE("vertex arrays: an optional one may be empty, a needed one not", "[texture]") {
  const std::vector<float> none, one(1);
  CHECK(fits(none, Array::optional, 5));
  CHECK_FALSE(fits(none, Array::needed, 5));
  CHECK_FALSE(fits(one, Array::optional, 5));
  CHECK(fits(one, Array::needed, 1));
}
