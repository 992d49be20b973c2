#include "analyze/symbolic.h"

namespace mlcp {

void Symbolic::build(const KktPattern& pattern, const EliminationTree& tree) {
  const std::int32_t size = pattern.size();
  parent.assign(tree.parent.span());
  const auto for_each_entry = [&](auto visit) {
    mark_.assign(size, -1);
    for (std::int32_t p = 0; p < size; ++p) {
      mark_[p] = p;
      for (std::int32_t t = pattern.upper_pointers[p]; t < pattern.upper_pointers[p + 1]; ++t)
        for (std::int32_t q = pattern.upper_rows[t]; mark_[q] != p; q = parent[q]) {
          mark_[q] = p;
          visit(q, p);
        }
    }
  };
  pointers.assign(size + 1, 0);
  for_each_entry([&](std::int32_t column, std::int32_t) { ++pointers[column + 1]; });
  for (std::int32_t p = 0; p < size; ++p) pointers[p + 1] += pointers[p];
  rows.resize(pointers[size]);
  end_.assign(pointers.span().first(size));
  for_each_entry([&](std::int32_t column, std::int32_t row) { rows[end_[column]++] = row; });

  islands.clear();
  std::int32_t first = 0, first_row = 0, row = 0;
  for (std::int32_t p = 0; p < size; ++p) {
    row += pattern.is_row(p);
    if (parent[p] >= 0) continue;
    islands.push_back({first, p + 1, first_row, row});
    first = p + 1;
    first_row = row;
  }
}

}  // namespace mlcp
