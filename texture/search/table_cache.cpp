#include "texture/search/table_cache.h"

namespace fluidtex::texture {
namespace {

// Visits every part of a table, in one order for reading and writing. `padded` is left out, and so are coarse
// codes, which are the upper bits of the fine ones.
template <typename Table, typename Visit>
void eachPart(Table& table, const Visit& visit) {
  visit(table.window), visit(table.channels), visit(table.toroidal);
  visit(table.width), visit(table.height), visit(table.margin);
  visit(table.falloff);
  visit(table.basis.size), visit(table.basis.component), visit(table.basis.offset), visit(table.basis.mean);
  visit(table.tree.firstBlock), visit(table.tree.index);
  visit(table.tree.codes.low), visit(table.tree.codes.step), visit(table.tree.codes.fine);
  visit(table.tree.leafMean);
  visit(table.stride), visit(table.similarCount), visit(table.similar);
}

}  // namespace

SearchTable cachedSearchTable(const Image& match, bool toroidal, int window, std::uint64_t seed, int similar,
                              const CacheFolder& folder) {
  SearchTable table;
  std::string name;
  if (!folder.path.empty()) {
    const std::int64_t settings[] = {match.width, match.height, match.channels,  toroidal,
                                     window,      similar,      kDescriptorSize, std::int64_t(seed)};
    const std::span<const float> pixels[] = {match.data};
    name = keptName(".table", settings, pixels);
    if (const auto kept = readKept(folder, name)) {
      const char* at = kept->data.get();
      eachPart(table, ByteReader{at});
      makeCoarse(table.tree.codes);
      return table;
    }
  }
  table = buildSearchTable(match, toroidal, window, seed, similar);
  table.padded = {};
  std::vector<char> bytes;
  if (!folder.path.empty()) eachPart(table, ByteWriter{bytes});
  writeKept(folder, name, std::move(bytes));
  return table;
}

}  // namespace fluidtex::texture
