#include "scenes/figures/vase.h"

#include <OpenImageIO/imageio.h>

#include <catch2/catch.hpp>

#include <cmath>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <utility>

namespace fluidtex::figures {

TEST_CASE("vase: mesh and picture that ship are those that are made", "[scenes]") {
  const std::string folder = FLUIDTEX_SOURCE_DIR "/scenes/figures/";
  std::ifstream in(folder + "vase.obj", std::ios::binary);
  const std::string shipped{std::istreambuf_iterator<char>(in), {}};
  CHECK(shipped == objOf(makeVase()));
  const auto input = OIIO::ImageInput::open(folder + "vase.png");
  REQUIRE(input);
  const int size = input->spec().width;
  REQUIRE((input->spec().height == size && input->spec().nchannels == 3));
  std::vector<std::uint8_t> pixels(std::size_t(size) * std::size_t(size) * 3);
  REQUIRE(input->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, pixels.data()));
  CHECK(pixels == makeVasePicture(size));
}

TEST_CASE("vase: it is closed, turned outward, and its places lie on the picture", "[scenes]") {
  const Vase vase = makeVase();
  std::map<std::pair<std::size_t, std::size_t>, int> edges;
  double volume = 0.0;
  for (const std::vector<Corner>& face : vase.faces) {
    for (std::size_t c = 0; c < face.size(); ++c) {
      const std::size_t a = face[c].vertex, b = face[(c + 1) % face.size()].vertex;
      ++edges[{a, b}];
      --edges[{b, a}];
    }
    for (std::size_t c = 1; c + 1 < face.size(); ++c) {
      const auto &p = vase.vertices[face[0].vertex], &q = vase.vertices[face[c].vertex],
                 &r = vase.vertices[face[c + 1].vertex];
      volume += (p[0] * (q[1] * r[2] - q[2] * r[1]) + p[1] * (q[2] * r[0] - q[0] * r[2]) +
                 p[2] * (q[0] * r[1] - q[1] * r[0])) /
                6.0;
    }
  }
  for (const auto& [edge, count] : edges) CHECK(count == 0);
  CHECK(volume == Approx(0.033).epsilon(0.1));
  for (const auto& place : vase.places)
    for (const double share : place) CHECK((share >= 0.0 && share <= 1.0));
  double top = 0.0;
  for (const auto& vertex : vase.vertices) top = std::max(top, vertex[2]);
  CHECK(top == Approx(0.5));
}

TEST_CASE("vase: picture and mesh have one scale along the wall, and on foot and mouth", "[scenes]") {
  const Vase vase = makeVase();
  for (const std::vector<Corner>& face : vase.faces) {
    // From ring to ring, or from the middle of a disc.
    const Corner &a = face.size() == 4 ? face[3] : face[0], &b = face.size() == 4 ? face[0] : face[1];
    const auto &x = vase.vertices[a.vertex], &y = vase.vertices[b.vertex];
    const auto &p = vase.places[a.place], &q = vase.places[b.place];
    const double metres = std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
    CHECK(metres / std::hypot(p[0] - q[0], p[1] - q[1]) == Approx(0.88).epsilon(0.01));
  }
}

}  // namespace fluidtex::figures
