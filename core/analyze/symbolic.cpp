#include "analyze/symbolic.h"

#include <algorithm>

namespace mlcp {

/// Row p has an entry in the first column of every run on the tree paths from K's entries in it up to p.
void Symbolic::fill_rows(const KktPattern& pattern, Poll poll) {
  const std::int32_t size = this->size();
  mark_.assign(size, -1);
  end_.resize(size);
  for (std::int32_t p = 0; p < size; ++p) {
    const std::int32_t run = run_start[p];
    if (run == p) {
      end_[p] = pointers[p];
      for (std::int32_t q = p + 1; q < run_end[p]; ++q) rows[end_[p]++] = q;
    }
    mark_[run] = p;
    for (std::int32_t t = pattern.upper_pointers[p]; t < pattern.upper_pointers[p + 1]; ++t)
      for (std::int32_t q = run_start[pattern.upper_rows[t]]; mark_[q] != p; q = run_start[parent[run_end[q] - 1]]) {
        mark_[q] = p;
        rows[end_[q]++] = p;
        poll.spend(1);
      }
  }
  for (std::int32_t p = 0; p < size; ++p)
    if (run_start[p] != p) std::copy(rows.begin() + pointers[p - 1] + 1, rows.begin() + pointers[p], rows.begin() + pointers[p]);
}

void Symbolic::build(const KktPattern& pattern, const EliminationTree& tree, const Crowding& crowding, Poll poll) {
  const std::int32_t size = pattern.size();
  parent.assign(tree.parent.span());
  counts_.find(pattern, tree);
  pointers.resize(size + 1);
  pointers[0] = 0;
  for (std::int32_t p = 0; p < size; ++p) pointers[p + 1] = pointers[p] + counts_.count[p];
  rows.resize(pointers[size]);

  // p + 1 is p's parent and has one row less: then it has the same ones
  run_end.resize(size);
  for (std::int32_t p = size - 1; p >= 0; --p) {
    const bool nests = p + 1 < size && parent[p] == p + 1 && counts_.count[p] == counts_.count[p + 1] + 1;
    run_end[p] = nests ? run_end[p + 1] : p + 1;
  }
  run_start.resize(size);
  for (std::int32_t p = 0; p < size; ++p) run_start[p] = p > 0 && run_end[p - 1] == run_end[p] ? run_start[p - 1] : p;
  fill_rows(pattern, poll);

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
