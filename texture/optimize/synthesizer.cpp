#include "texture/optimize/synthesizer.h"

#include "texture/exemplar/texel_image.h"
#include "texture/optimize/histogram.h"
#include "texture/optimize/passes.h"
#include "texture/shown/shown_color.h"

#include <algorithm>
#include <stdexcept>

namespace fluidtex::texture {

Synthesizer makeSynthesizer(Exemplar exemplar, const SynthesisOptions& options, CacheFolder cache) {
  Synthesizer synthesizer{
      std::move(exemplar), options, std::make_shared<SearchTables>(), std::move(cache), {}};
  synthesizer.around = lightnessAround(synthesizer.exemplar.color, synthesizer.exemplar.toroidal);
  const int colors = synthesizer.exemplar.colorChannels;
  // kwatra07 has no feature channels: it matches by colour and guidance alone.
  if (options.method == Method::kwatra07) {
    for (Image& image : synthesizer.exemplar.match) {
      const int channels = colors + (synthesizer.exemplar.guided ? 1 : 0);
      Image reduced{image.width, image.height, channels, {}};
      for (std::size_t i = 0; i < image.data.size(); ++i)
        if (int(i % std::size_t(image.channels)) < channels) reduced.data.push_back(image.data[i]);
      image = std::move(reduced);
    }
  }
  int largest = 3;
  for (const int window : options.windows) largest = std::max(largest, window);
  for (const Image& image : synthesizer.exemplar.match) {
    TexelImage texels = makeTexelImage(image, synthesizer.exemplar.toroidal, largest / 2 + 3);
    texels.ways = options.ways;
    texels.guide = synthesizer.exemplar.guided ? colors : -1;
    texels.guidanceWeight = synthesizer.exemplar.guidanceWeight;
    texels.firstMap = colors + (synthesizer.exemplar.guided ? 1 : 0);
    texels.maps = synthesizer.exemplar.mapChannels;
    synthesizer.tables->histogram.push_back(makeHistogramTarget(texels));
    synthesizer.tables->seamUnit.push_back(seamUnit(texels, seamChannels(synthesizer)));
    synthesizer.tables->image.push_back(std::move(texels));
  }
  if (windowsOf(synthesizer, 0).empty())
    throw std::invalid_argument("makeSynthesizer: no window fits the exemplar");
  return synthesizer;
}

}  // namespace fluidtex::texture
