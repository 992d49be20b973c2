#include "analyze/symbolic.h"

#include <algorithm>

namespace mlcp {

void Symbolic::build(const KktPattern& pattern, const EliminationTree& tree, const Crowding& crowding, Poll poll) {
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
          poll.spend(1);
        }
    }
  };
  pointers.assign(size + 1, 0);
  for_each_entry([&](std::int32_t column, std::int32_t) { ++pointers[column + 1]; });
  for (std::int32_t p = 0; p < size; ++p) pointers[p + 1] += pointers[p];
  rows.resize(pointers[size]);
  end_.assign(pointers.span().first(size));
  for_each_entry([&](std::int32_t column, std::int32_t row) { rows[end_[column]++] = row; });

  // p + 1 is p's parent and has one row less: then it has the same ones
  run_end.resize(size);
  for (std::int32_t p = size - 1; p >= 0; --p) {
    const bool nests = p + 1 < size && parent[p] == p + 1 && pointers[p + 1] - pointers[p] == pointers[p + 2] - pointers[p + 1] + 1;
    run_end[p] = nests ? run_end[p + 1] : p + 1;
  }

  run_start.resize(size);
  for (std::int32_t p = 0; p < size; ++p) run_start[p] = p > 0 && run_end[p - 1] == run_end[p] ? run_start[p - 1] : p;

  const auto single = [&](std::int32_t p) { return run_start[p] == p && run_end[p] == p + 1; };
  const auto equal = [&](std::int32_t p, std::int32_t q) {
    return pointers[p + 1] - pointers[p] == pointers[q + 1] - pointers[q] && std::equal(rows.begin() + pointers[p], rows.begin() + pointers[p + 1], rows.begin() + pointers[q]);
  };
  batch_start.resize(size);
  for (std::int32_t p = 0; p < size; ++p) {
    batch_start[p] = run_end[p] == p + 1 ? run_start[p] : -1;
    if (p == 0 || !single(p) || !single(p - 1) || parent[p] < 0 || parent[p] != parent[p - 1] || !equal(p - 1, p)) continue;
    batch_start[p] = batch_start[p - 1];
    batch_start[p - 1] = -1;
  }
  batch_end.resize(size);
  for (std::int32_t p = size - 1; p >= 0; --p) batch_end[p] = batch_start[p] >= 0 ? p + 1 : batch_end[p + 1];

  path_entries.resize(size);
  for (std::int32_t p = size - 1; p >= 0; --p)
    path_entries[p] = pointers[p + 1] - pointers[p] + (parent[p] >= 0 ? path_entries[parent[p]] : 0);

  islands.clear();
  std::int32_t first = 0, first_row = 0, row = 0;
  for (std::int32_t p = 0; p < size; ++p) {
    row += pattern.is_row(p);
    if (parent[p] >= 0) continue;
    islands.push_back({first, p + 1, first_row, row, crowding.crowded[pattern.node[p]] != 0});
    first = p + 1;
    first_row = row;
  }
}

}  // namespace mlcp
