// Blocks of a sparse grid by where they lie: a hash table with open addressing.
#pragma once

#include <openvdb/math/Coord.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <vector>

namespace fluidtex {

// For tables with a power of two of slots: each bit of the low half depends on all three coordinates.
inline std::size_t hashOfPlace(std::int32_t x, std::int32_t y, std::int32_t z) {
  const auto wide = [](std::int32_t v) { return std::uint64_t(std::uint32_t(v)); };
  const std::uint64_t h =
      wide(x) * 0x9e3779b97f4a7c15u ^ wide(y) * 0xc2b2ae3d27d4eb4fu ^ wide(z) * 0x165667b19e3779f9u;
  return std::size_t((h * 0xbf58476d1ce4e5b9u) >> 32);
}

// Numbers the blocks that are entered, from 0 in the order of their entry. A block's place is any coordinate
// that stands for it alone, such as its lowest cell. Look-ups may run in parallel with each other.
class BlockTable {
 public:
  static constexpr std::uint32_t kNone = ~std::uint32_t{0};

  // expected: how many blocks are to be entered; more are possible.
  explicit BlockTable(std::size_t expected = 0) : m_slots(slotsFor(expected)) {}

  std::size_t size() const { return m_size; }

  // A block's number; kNone where it was not entered.
  std::uint32_t find(const openvdb::math::Coord& place) const { return m_slots[slotOf(place)].number; }

  // A block's number, the next one where it is new. Throws std::length_error beyond 2^32 - 1 blocks.
  std::uint32_t enter(const openvdb::math::Coord& place) {
    if (slotsFor(m_size + 1) > m_slots.size()) grow();
    Slot& slot = m_slots[slotOf(place)];
    if (slot.number == kNone) {
      if (m_size == kNone) throw std::length_error("more than 2^32 - 1 blocks");
      slot = {place, m_size++};
    }
    return slot.number;
  }

 private:
  struct Slot {
    openvdb::math::Coord place;
    std::uint32_t number = kNone;
  };

  // At most half are taken: chains stay short, and a search always ends.
  static std::size_t slotsFor(std::size_t blocks) {
    return std::bit_ceil(std::max<std::size_t>(2 * blocks, 16));
  }

  // The block's slot, or the free one where it would be.
  std::size_t slotOf(const openvdb::math::Coord& place) const {
    const std::size_t mask = m_slots.size() - 1;
    std::size_t at = hashOfPlace(place[0], place[1], place[2]) & mask;
    while (m_slots[at].number != kNone && m_slots[at].place != place) at = (at + 1) & mask;
    return at;
  }

  void grow() {
    std::vector<Slot> before(2 * m_slots.size());
    before.swap(m_slots);
    for (const Slot& slot : before)
      if (slot.number != kNone) m_slots[slotOf(slot.place)] = slot;
  }

  std::vector<Slot> m_slots;
  std::uint32_t m_size = 0;
};

}  // namespace fluidtex
