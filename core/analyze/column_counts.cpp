#include "analyze/column_counts.h"

namespace mlcp {

/// The root of p's set, with the path halved on the way.
std::int32_t ColumnCounts::meet(std::int32_t p) {
  while (ancestor_[p] != p) p = ancestor_[p] = ancestor_[ancestor_[p]];
  return p;
}

void ColumnCounts::find(const KktPattern& pattern, const EliminationTree& tree) {
  const std::int32_t size = pattern.size();
  first_.resize(size);
  ancestor_.resize(size);
  for (std::int32_t p = 0; p < size; ++p) first_[p] = ancestor_[p] = p;
  for (std::int32_t p = 0; p < size; ++p)
    if (const std::int32_t above = tree.parent[p]; above >= 0) first_[above] = std::min(first_[above], first_[p]);

  // count[p]: what subtrees of rows begin or end at p; then summed up the tree
  count.resize(size);
  latest_.assign(size, -1);
  reached_.assign(size, -1);
  for (std::int32_t p = 0; p < size; ++p) count[p] = first_[p] == p;  // of row p itself, whose subtree has the leaf p or goes on below
  for (std::int32_t p = 0; p < size; ++p) {
    const std::int32_t above = tree.parent[p];
    if (above >= 0) --count[above];  // the path of row `above` from p ends there
    for (std::int32_t t = pattern.lower_pointers[p]; t < pattern.lower_pointers[p + 1]; ++t) {
      const std::int32_t i = pattern.lower_rows[t];
      if (first_[p] <= reached_[i]) continue;
      reached_[i] = first_[p];
      ++count[p];
      if (latest_[i] >= 0) --count[meet(latest_[i])];
      latest_[i] = p;
    }
    if (above >= 0) ancestor_[p] = above;
  }
  for (std::int32_t p = 0; p < size; ++p)
    if (const std::int32_t above = tree.parent[p]; above >= 0) count[above] += count[p];
  for (std::int32_t p = 0; p < size; ++p) --count[p];  // the diagonal
}

}  // namespace mlcp
