#include "texture/labels/label_expansion.h"

#include "tests/texture/exemplar/test_images.h"
#include "tests/texture/orientation/oriented_mesh.h"
#include "tests/threads.h"

#include <catch2/catch.hpp>

#include <cmath>

using namespace fluidtex::texture;
using namespace fluidtex::testing;
using fluidtex::Float8;
using fluidtex::randomUnit;

namespace {

const Float8 kAllChannels{1, 1, 1, 1, 1, 1, 1, 1};

// Each edge once, and what the labels cost by themselves.
double wholeCost(const SeamModel& model, const LabelTerms& terms, const Labels& labels) {
  const VertexGraph& graph = model.view.graph;
  double sum = 0.0;
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    sum += double(labelCost(model, terms, labels[v], model.image.sample(labels[v].texel), v));
    for (std::uint32_t h = graph.first[v]; h < graph.first[v + 1]; ++h)
      if (graph.neighbor[h] > v) sum += double(seamCost(model, labels[v], labels[graph.neighbor[h]], h));
  }
  return sum;
}

}  // namespace

TEST_CASE("label_expansion: the cost falls, held vertices stay, on any number of threads") {
  const OrientedMesh surface = orientedMesh(sphereMesh(40));
  const TexelImage image = makeTexelImage(blobImage(90, 90, 3, 14.0, 2), false, 4);
  const SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  const Labels labels = blockLabels(surface.view(), image, 8.0f, 1);
  std::vector<std::uint8_t> free;
  for (const Vec3f& x : surface.mesh.positions) free.push_back(x.z() > 0);
  const LabelTerms terms;
  Labels result[2] = {labels, labels};
  for (int i = 0; i < 2; ++i) {
    onThreads(i == 0 ? 1 : 4, [&] { CHECK(expandLabels(model, terms, free, 7, result[i]) > 0.05); });
  }
  CHECK(wholeCost(model, terms, result[0]) < 0.9 * wholeCost(model, terms, labels));
  for (std::size_t v = 0; v < labels.size(); ++v) {
    CHECK(result[0][v].texel == result[1][v].texel);
    if (!free[v]) CHECK(result[0][v].texel == labels[v].texel);
  }
}

TEST_CASE("label_expansion: a torn hole is closed by the picture around it") {
  const OrientedMesh surface = flatBox(64);
  const TexelImage image = makeTexelImage(blobImage(100, 100, 3, 9.0, 1), false, 4);
  const SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  Labels whole;
  std::vector<std::uint8_t> free;
  for (const Vec3f& x : surface.mesh.positions) {
    whole.push_back(unstretched(Vec2f(10 + x.x(), 80 - x.y()), {}));
    free.push_back(x.z() > 1.9f && x.x() > 8 && x.x() < 56 && x.y() > 8 && x.y() < 56);
  }
  Labels torn = whole;
  for (std::uint32_t v = 0; v < torn.size(); ++v) {
    const Vec3f way = surface.mesh.positions[v] - Vec3f(32, 32, 2);
    if (free[v] && way.length() < 9.0f)
      torn[v].texel = Vec2f(float(randomUnit(1, v)), float(randomUnit(2, v))) * 99.0f;
  }
  expandLabels(model, {}, free, 3, torn);
  for (std::size_t v = 0; v < torn.size(); ++v) CHECK((torn[v].texel - whole[v].texel).length() < kCoherent);
}

TEST_CASE(
    "label_expansion: labels that continue each other are left alone, and no label leaves the exemplar") {
  const OrientedMesh surface = flatBox(40);
  const TexelImage image = makeTexelImage(noiseImage(60, 60, 3, 1), false, 4);
  const SeamModel model = makeSeamModel(surface.view(), image, kAllChannels);
  Labels labels;
  std::vector<std::uint8_t> top;
  for (const Vec3f& x : surface.mesh.positions) {
    labels.push_back(unstretched(Vec2f(10 + x.x(), 50 - x.y()), {}));
    top.push_back(x.z() > 1.9f && x.x() > 2 && x.x() < 38 && x.y() > 2 && x.y() < 38);
  }
  const Labels before = labels;
  CHECK(expandLabels(model, {}, top, 1, labels) == 0.0);
  for (std::size_t v = 0; v < labels.size(); ++v) CHECK(labels[v].texel == before[v].texel);

  // Two pictures near the exemplar's edge: neither can be continued over the whole.
  for (std::uint32_t v = 0; v < labels.size(); ++v) {
    const Vec3f& x = surface.mesh.positions[v];
    labels[v].texel = x.x() < 20 ? Vec2f(35 + x.x(), 50 - x.y()) : Vec2f(x.x() - 18, 45 - x.y());
    labels[v].texel = image.brought(labels[v].texel);
  }
  expandLabels(model, {}, top, 1, labels);
  for (const Label& label : labels) CHECK(label.texel == image.brought(label.texel));
}
