#include "caches/recorded/recorded_sight.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace fluidtex::caches {
namespace {

std::string nameOf(std::size_t substep) {
  return "sight." + std::to_string(substep);
}

std::string nameOf(int sight, int word) {
  return nameOf(std::size_t(sight)) + "." + std::to_string(word);
}

openvdb::Int64Grid::Ptr wordsOf(const sim::Visibility& visibility, int sight, int word) {
  auto grid = openvdb::Int64Grid::create(0);
  grid->setName(nameOf(sight, word));
  for (const sim::Coord& origin : visibility.origins()) {
    const sim::Visibility::Leaf& cells = *visibility.leaf(origin);
    auto* const leaf = grid->tree().touchLeaf(origin);
    for (std::size_t cell = 0; cell < cells.size(); ++cell)
      leaf->setValueOn(openvdb::Index(cell), std::int64_t(cells[cell].bits[std::size_t(word)]));
  }
  return grid;
}

openvdb::Int64Grid::Ptr readWords(openvdb::io::File& file, int sight, int word) {
  auto grid = openvdb::gridPtrCast<openvdb::Int64Grid>(file.readGrid(nameOf(sight, word)));
  if (!grid) throw openvdb::TypeError("grid " + nameOf(sight, word) + " is not of words");
  return grid;
}

std::shared_ptr<const sim::Visibility> readVisibility(openvdb::io::File& file, int sight) {
  const openvdb::Int64Grid::Ptr first = readWords(file, sight, 0), second = readWords(file, sight, 1);
  const auto visibility = std::make_shared<sim::Visibility>();
  for (auto low = first->tree().cbeginLeaf(); low; ++low) {
    const auto* const high = second->tree().probeConstLeaf(low->origin());
    if (high == nullptr) throw openvdb::ValueError("grid " + nameOf(sight, 1) + " is incomplete");
    auto cells = std::make_unique<sim::Visibility::Leaf>();
    for (std::size_t cell = 0; cell < cells->size(); ++cell)
      (*cells)[cell].bits = {std::uint64_t(low->getValue(openvdb::Index(cell))),
                             std::uint64_t(high->getValue(openvdb::Index(cell)))};
    visibility->add(low->origin(), std::move(cells));
  }
  return visibility;
}

}  // namespace

void addSight(const sim::Frame& frame, openvdb::GridCPtrVec& grids, openvdb::MetaMap& metadata) {
  // Substeps share one while walls rest.
  std::map<const sim::Visibility*, int> numbers;
  for (std::size_t n = 0; n < frame.substeps.size(); ++n) {
    const sim::Visibility* const visibility = frame.substeps[n].visibility.get();
    if (visibility == nullptr) continue;
    const auto [sight, isNew] = numbers.emplace(visibility, int(numbers.size()));
    if (isNew)
      for (const int word : {0, 1}) grids.push_back(wordsOf(*visibility, sight->second, word));
    metadata.insertMeta(nameOf(n), openvdb::Int32Metadata(sight->second));
  }
}

void readSight(openvdb::io::File& file, std::vector<sim::Substep>& substeps) {
  const openvdb::MetaMap::Ptr metadata = file.getMetadata();
  std::map<int, std::shared_ptr<const sim::Visibility>> sights;
  for (std::size_t n = 0; n < substeps.size(); ++n) {
    const auto number = metadata->getMetadata<openvdb::Int32Metadata>(nameOf(n));
    if (!number) continue;
    auto& sight = sights[number->value()];
    if (!sight) sight = readVisibility(file, number->value());
    substeps[n].visibility = sight;
  }
}

}  // namespace fluidtex::caches
