#include "texture/labels/seams.h"

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/orientation/oriented_mesh.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using fluidtex::Float8;
using fluidtex::randomUnit;

namespace {

const Float8 kAllChannels{1, 1, 1, 1, 1, 1, 1, 1};

// The picture texel = corner + (x, -y) on the upper side of a flat box.
Label pictureAt(const OrientedMesh& surface, const Vec2f& corner, std::uint32_t v) {
  const Vec3f& x = surface.mesh.positions[v];
  return unstretched(corner + Vec2f(x.x(), -x.y()), {});
}

double wholeCost(const SeamModel& model, const Labels& labels) {
  double sum = 0.0;
  for (std::uint32_t v = 0; v < labels.size(); ++v) sum += double(seamCostAround(model, labels, v));
  return sum;
}

}  // namespace

TEST_CASE("seams: no cost within a picture, the same from both ends of an edge") {
  const OrientedMesh surface = flatBox(20);
  const TexelImage image = makeTexelImage(noiseImage(80, 80, 3, 1), false, 4);
  const SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  CHECK(model.unit == Approx(std::sqrt(3.0 / 6.0)).epsilon(0.02));  // three uniform channels: 2 x 3 / 12
  Labels labels;
  for (std::uint32_t v = 0; v < surface.mesh.positions.size(); ++v)
    labels.push_back(
        pictureAt(surface, surface.mesh.positions[v].x() < 9.5f ? Vec2f(5, 40) : Vec2f(30, 60), v));
  std::size_t seams = 0;
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    const Vec3f& x = surface.mesh.positions[v];
    if (x.z() < 1.9f || x.x() < 1 || x.x() > 19 || x.y() < 1 || x.y() > 19) continue;
    for (std::uint32_t h = surface.graph.first[v]; h < surface.graph.first[v + 1]; ++h) {
      const std::uint32_t u = surface.graph.neighbor[h];
      const float cost = seamCost(model, labels[v], labels[u], h);
      const bool across = (x.x() < 9.5f) != (surface.mesh.positions[u].x() < 9.5f);
      CHECK((cost > 0.0f) == across);
      seams += across;
      for (std::uint32_t back = surface.graph.first[u]; back < surface.graph.first[u + 1]; ++back)
        if (surface.graph.neighbor[back] == v)
          CHECK(seamCost(model, labels[u], labels[v], back) == Approx(cost).margin(1e-4));
    }
  }
  CHECK(seams > 30);
}

TEST_CASE("seams: no cost where texture slides past texture") {
  const OrientedMesh surface = flatBox(20);
  const TexelImage image = makeTexelImage(noiseImage(80, 80, 3, 1), false, 4);
  SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  Labels labels;
  std::vector<std::uint8_t> stays;
  for (std::uint32_t v = 0; v < surface.mesh.positions.size(); ++v) {
    stays.push_back(surface.mesh.positions[v].x() < 9.5f);
    labels.push_back(pictureAt(surface, stays[v] ? Vec2f(5, 40) : Vec2f(30, 60), v));
  }
  const auto alongBorder = [&] {
    double sum = 0.0;
    for (std::uint32_t v = 0; v < labels.size(); ++v) {
      const Vec3f& x = surface.mesh.positions[v];
      if (x.z() > 1.9f && std::abs(x.x() - 9.5f) < 1.0f && x.y() > 1 && x.y() < 19)
        sum += double(seamCostAround(model, labels, v));
    }
    return sum;
  };
  CHECK(alongBorder() > 1.0);
  model.stays = &stays;
  CHECK(alongBorder() == 0.0);
}

TEST_CASE("seams: specks are taken over by what surrounds them") {
  const OrientedMesh surface = flatBox(20);
  const TexelImage image = makeTexelImage(blobImage(80, 80, 3, 9.0, 1), false, 4);
  const SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  Labels labels;
  std::vector<std::uint8_t> free;
  for (std::uint32_t v = 0; v < surface.mesh.positions.size(); ++v) {
    const Vec3f& x = surface.mesh.positions[v];
    labels.push_back(pictureAt(surface, {5, 40}, v));
    free.push_back(x.z() > 1.9f && x.x() > 2 && x.x() < 18 && x.y() > 2 && x.y() < 18);
  }
  Labels specked = labels;
  for (std::uint32_t v = 0; v < labels.size(); ++v)
    if (free[v] && randomUnit(3, v) < 0.15)
      specked[v].texel = Vec2f(float(randomUnit(4, v)), float(randomUnit(5, v))) * 79.0f;
  straightenSeams(model, {}, free, nullptr, 10, specked);
  for (std::uint32_t v = 0; v < labels.size(); ++v)
    CHECK((specked[v].texel - labels[v].texel).length() < kCoherent);
}

TEST_CASE("seams: the summed cost falls, held vertices stay, on any number of threads") {
  const OrientedMesh surface = orientedMesh(sphereMesh(16));
  const TexelImage image = makeTexelImage(blobImage(60, 60, 3, 8.0, 2), false, 4);
  const SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  Labels labels = blockLabels(surface.view(), image, 6.0f, 1);
  std::vector<std::uint8_t> free;
  for (const Vec3f& x : surface.mesh.positions) free.push_back(x.z() > 0);
  const double before = wholeCost(model, labels);
  Labels result[2] = {labels, labels};
  for (int i = 0; i < 2; ++i) {
    onThreads(i == 0 ? 1 : 4, [&] { straightenSeams(model, {}, free, nullptr, 6, result[i]); });
  }
  CHECK(wholeCost(model, result[0]) < 0.95 * before);
  for (std::size_t v = 0; v < labels.size(); ++v) {
    CHECK(result[0][v].texel == result[1][v].texel);
    if (!free[v]) CHECK(result[0][v].texel == labels[v].texel);
  }
}

TEST_CASE("seams: a strong data term keeps every vertex at its picture") {
  const OrientedMesh surface = orientedMesh(sphereMesh(10));
  const TexelImage image = makeTexelImage(noiseImage(60, 60, 3, 2), false, 4);
  const SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  const Labels labels = blockLabels(surface.view(), image, 4.0f, 1);
  const Values picture = lookUp(image, labels);
  Labels held = labels;
  straightenSeams(model, {1.0f, 1e3f, &picture}, {}, nullptr, 4, held);
  for (std::size_t v = 0; v < labels.size(); ++v) CHECK(held[v].texel == labels[v].texel);
}
