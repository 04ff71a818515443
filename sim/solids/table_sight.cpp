#include "sim/solids/table_sight.h"

namespace fluidtex::sim {

TableSight::TableSight(const LeafTable& table, const Visibility* visibility)
    : m_table(table), m_leaves(table.size(), nullptr) {
  if (visibility == nullptr) return;
  for (std::size_t n = 0; n < table.size(); ++n) m_leaves[n] = visibility->leaf(table.origins[n]);
}

}  // namespace fluidtex::sim
