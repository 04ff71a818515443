#include "texture/optimize/synthesizer.h"

#include "tests/scratch.h"
#include "tests/texture/exemplar/test_images.h"
#include "texture/optimize/passes.h"
#include "texture/shown/shown_color.h"

#include <catch2/catch.hpp>

using namespace fluidtex::texture;
using namespace fluidtex::testing;

namespace {

SynthesisOptions smallWindows(Method method = Method::coordinates) {
  SynthesisOptions options;
  options.method = method;
  options.windows = {13, 7};
  return options;
}

// With a guidance map and one map that is matched.
Exemplar exemplarOf(const SynthesisOptions& options, bool guided) {
  return makeExemplar(blobImage(48, 40, 4, 9.0, 1), true, options, 2,
                      guided ? blobImage(48, 40, 1, 9.0, 2) : Image{}, {},
                      {{"height", {blobImage(48, 40, 1, 9.0, 3), MapHolds::values, 1.0f}}});
}

}  // namespace

TEST_CASE("synthesizer: each level of the exemplar is made ready, and knows what its channels are") {
  const bool guided = GENERATE(false, true);
  SynthesisOptions options = smallWindows();
  options.ways = {2, true};
  options.guidanceWeight = 2.5;
  const Exemplar exemplar = exemplarOf(options, guided);
  const Synthesizer synthesizer = makeSynthesizer(exemplar, options);
  const SearchTables& tables = *synthesizer.tables;
  REQUIRE(tables.image.size() == 2);
  REQUIRE(tables.histogram.size() == 2);
  REQUIRE(tables.seamUnit.size() == 2);
  CHECK(tables.table.empty());  // made on first use
  for (std::size_t level = 0; level < 2; ++level) {
    const TexelImage& image = tables.image[level];
    CHECK(image.width == (level == 0 ? 48 : 24));
    CHECK(image.height == (level == 0 ? 40 : 20));
    // Colours, guidance, the map, the feature distance and the gradient energy.
    CHECK(image.channels == 3 + (guided ? 1 : 0) + 1 + 2);
    CHECK(image.toroidal);
    CHECK((image.ways.turns == 2 && image.ways.mirrored));
    CHECK(image.guide == (guided ? 3 : -1));
    CHECK(image.firstMap == (guided ? 4 : 3));
    CHECK(image.maps == 1);
    if (guided) CHECK(image.guidanceWeight == 2.5f);
    CHECK(image.margin >= 13 / 2 + 1);
    CHECK(tables.seamUnit[level] == Approx(seamUnit(image, seamChannels(synthesizer))));
    CHECK(tables.seamUnit[level] > 0.0f);
  }
  CHECK(synthesizer.around.data == lightnessAround(exemplar.color, true).data);
}

TEST_CASE("synthesizer: of Kwatra's method it keeps colour and guidance alone") {
  const bool guided = GENERATE(false, true);
  const SynthesisOptions options = smallWindows(Method::kwatra07);
  const Exemplar exemplar = exemplarOf(options, guided);
  const Synthesizer synthesizer = makeSynthesizer(exemplar, options);
  const int kept = guided ? 4 : 3;
  for (std::size_t level = 0; level < 2; ++level) {
    const Image &full = exemplar.match[level], &reduced = synthesizer.exemplar.match[level];
    REQUIRE(full.channels > kept);
    REQUIRE(reduced.channels == kept);
    REQUIRE((reduced.width == full.width && reduced.height == full.height));
    for (int y = 0; y < full.height; ++y)
      for (int x = 0; x < full.width; ++x)
        for (int c = 0; c < kept; ++c) REQUIRE(reduced.at(x, y)[c] == full.at(x, y)[c]);
    CHECK(synthesizer.tables->image[level].channels == kept);
  }
}

TEST_CASE("synthesizer: without windows, or where none fits, it is refused") {
  SynthesisOptions options = smallWindows();
  Exemplar exemplar = exemplarOf(options, false);
  options.windows.clear();
  CHECK_THROWS_AS(makeSynthesizer(exemplar, options), std::invalid_argument);
  options.windows = {13};
  exemplar.toroidal = false;
  exemplar.match[0] = noiseImage(4, 4, 3, 1);
  CHECK_THROWS_AS(makeSynthesizer(exemplar, options), std::invalid_argument);
  exemplar.match[0] = noiseImage(5, 5, 3, 1);
  CHECK_NOTHROW(makeSynthesizer(exemplar, options));
}

TEST_CASE("synthesizer: tables of all levels and windows are made at once, and kept in the folder") {
  const Scratch scratch;
  const SynthesisOptions options = smallWindows();
  Synthesizer synthesizer = makeSynthesizer(exemplarOf(options, false), options, scratch.path);
  prepareTables(synthesizer);
  std::vector<std::pair<int, int>> keys;
  for (const auto& [key, table] : synthesizer.tables->table) {
    keys.push_back(key);
    CHECK(table.window == key.second);
    CHECK(table.channels == synthesizer.exemplar.match[0].channels);
    CHECK(table.toroidal);
    CHECK(table.width == (key.first == 0 ? 48 : 24));
    // Similar windows are looked for at the finest level alone.
    CHECK(table.similar.empty() == (key.first > 0));
  }
  CHECK(keys == std::vector<std::pair<int, int>>{{0, 7}, {0, 13}, {1, 7}, {1, 13}});
  CHECK(filesIn(scratch.path).size() == 4);
}
