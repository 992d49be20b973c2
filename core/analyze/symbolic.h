#pragma once
#include "analyze/column_counts.h"
#include "analyze/crowding.h"
#include "analyze/elimination_tree.h"
#include "analyze/kkt_pattern.h"
#include "threads/poll.h"

namespace mlcp {

/// Columns first .. last − 1 of the elimination order: one connected component, one tree.
struct Island {
  std::int32_t first, last;          ///< positions
  std::int32_t first_row, last_row;  ///< ordinals of its constraint rows
  bool crowded;                      ///< factored with ε, rows and velocities in any order
};

/// Pattern of L with every selected row in: the factor of any active set fits. Row indices ascend within a column; the first is the
/// parent in the elimination tree.
struct Symbolic {
  Array<std::int32_t> parent;
  Array<std::int64_t> pointers;
  Array<std::int32_t> rows;
  Array<std::int32_t> run_end;  ///< columns p .. run_end[p] − 1 nest: each has the rows of the one before without its own (a supernode)
  Array<std::int32_t> run_start;
  /// Columns batch_start[p] .. p act on the same rows when p is the last of them: a run, or single columns with equal rows, as those of the contacts
  /// between two bodies are where rows come first. −1: p is not the last.
  Array<std::int32_t> batch_start, batch_end;
  Array<std::int64_t> path_entries;  ///< of the columns on the path p → root, p's own included: what a toggle of p may touch
  Array<Island> islands;
  explicit Symbolic(const Memory& m) : parent(m), pointers(m), rows(m), run_end(m), run_start(m), batch_start(m), batch_end(m), path_entries(m), islands(m), counts_(m), mark_(m), end_(m) {}

  std::int32_t size() const { return static_cast<std::int32_t>(parent.size()); }
  std::int64_t entries() const { return pointers.empty() ? 0 : pointers.back(); }

  /// before: the order is a postorder of the tree.
  /// cost: O(entries of L), to copy them: each row's subtree is walked run by run (after Davis 2006, ch. 4).  throws: Stopped.
  void build(const KktPattern& pattern, const EliminationTree& tree, const Crowding& crowding, Poll poll = {});

 private:
  void fill_rows(const KktPattern& pattern, Poll poll);
  ColumnCounts counts_;
  Array<std::int32_t> mark_;
  Array<std::int64_t> end_;
};

}  // namespace mlcp
