#include "analyze/check_analysis.h"

namespace mlcp {
namespace {

bool check_order(const KktPattern& pattern, const Crowding& crowding) {
  for (std::int32_t p = 0; p < pattern.size(); ++p)
    if (pattern.position[pattern.node[p]] != p) return false;
  for (std::int32_t o = 0; o < pattern.rows(); ++o) {
    if (crowding.crowded[pattern.node[pattern.row_position[o]]]) continue;
    for (std::int32_t t = pattern.row_pointers[o]; t < pattern.row_pointers[o + 1]; ++t)
      if (!pattern.is_row(pattern.row_columns[t]) && pattern.row_columns[t] > pattern.row_position[o]) return false;
  }
  return true;
}

bool check_entries(const KktPattern& pattern) {
  for (std::int32_t p = 0; p < pattern.size(); ++p)
    for (std::int32_t t = pattern.lower_pointers[p]; t < pattern.lower_pointers[p + 1]; ++t)
      if (pattern.lower_rows[t] <= (t > pattern.lower_pointers[p] ? pattern.lower_rows[t - 1] : p)) return false;
  return true;
}

bool check_columns(const Symbolic& symbolic) {
  for (std::int32_t p = 0; p < symbolic.size(); ++p) {
    const std::int64_t first = symbolic.pointers[p], last = symbolic.pointers[p + 1];
    if (symbolic.parent[p] != (first < last ? symbolic.rows[first] : -1)) return false;
    for (std::int64_t t = first; t < last; ++t)
      if (symbolic.rows[t] <= (t > first ? symbolic.rows[t - 1] : p)) return false;
  }
  return true;
}

bool check_runs(const Symbolic& symbolic) {
  for (std::int32_t p = 0; p + 1 < symbolic.size(); ++p) {
    if (symbolic.run_end[p] == p + 1) continue;
    const std::int64_t first = symbolic.pointers[p], next = symbolic.pointers[p + 1];
    if (symbolic.run_end[p] != symbolic.run_end[p + 1] ||
        !std::equal(symbolic.rows.begin() + first + 1, symbolic.rows.begin() + next, symbolic.rows.begin() + next,
                    symbolic.rows.begin() + symbolic.pointers[p + 2]))
      return false;
  }
  return true;
}

/// A batch is a run, or single columns with equal rows.
bool check_batches(const Symbolic& symbolic) {
  for (std::int32_t first = 0; first < symbolic.size();) {
    const std::int32_t end = symbolic.batch_end[first];
    if (end <= first || end > symbolic.size() || symbolic.batch_start[end - 1] != first) return false;
    for (std::int32_t p = first + 1; p < end && symbolic.run_end[first] != end; ++p)
      if (symbolic.run_end[p - 1] != p || symbolic.run_end[p] != p + 1 ||
          !std::equal(symbolic.rows.begin() + symbolic.pointers[first], symbolic.rows.begin() + symbolic.pointers[first + 1],
                      symbolic.rows.begin() + symbolic.pointers[p], symbolic.rows.begin() + symbolic.pointers[p + 1]))
        return false;
    first = end;
  }
  return true;
}

bool check_islands(const Symbolic& symbolic) {
  std::int32_t next = 0;
  for (const Island& island : symbolic.islands) {
    if (island.first != next || island.last <= island.first || symbolic.parent[island.last - 1] != -1) return false;
    for (std::int32_t p = island.first; p + 1 < island.last; ++p)
      if (symbolic.parent[p] <= p || symbolic.parent[p] >= island.last) return false;
    next = island.last;
  }
  return next == symbolic.size();
}

}  // namespace

bool check_analysis(const Analysis& analysis) {
  return check_order(analysis.pattern, analysis.crowding) && check_entries(analysis.pattern) && check_columns(analysis.symbolic) && check_runs(analysis.symbolic) &&
         check_batches(analysis.symbolic) && check_islands(analysis.symbolic);
}

}  // namespace mlcp
