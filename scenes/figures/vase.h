// A painted vase by rule: a closed mesh with texture coordinates, and its picture.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace fluidtex::figures {

struct Corner {
  std::size_t vertex = 0, place = 0;  // into Vase::vertices and Vase::places
};

struct Vase {
  std::vector<std::array<double, 3>> vertices;  // metres; it stands on z = 0, about the axis x = y = 0
  // In the picture: u to the right, v up from its lowest row, 0..1.
  std::vector<std::array<double, 2>> places;
  std::vector<std::vector<Corner>> faces;  // counter-clockwise seen from outside
};

// 0.5 m high and 0.38 m wide at its belly, filled and closed: flat at its foot and at its mouth. The wall is
// laid out as one rectangle, foot and mouth as discs below it, all to one scale; around the wall the picture
// is as wide as the vase where its circumference is the picture's width, and is squeezed or drawn out
// elsewhere.
Vase makeVase();

// The text of its OBJ.
std::string objOf(const Vase& vase);

// Red clay with bands of black: tongues, zigzags, keys, rosettes and rays. size x size x 3, sRGB, rows from
// the top.
std::vector<std::uint8_t> makeVasePicture(int size = 1024);

}  // namespace fluidtex::figures
