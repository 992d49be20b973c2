#pragma once
#include "analyze/elimination_tree.h"
#include "analyze/kkt_pattern.h"
#include "analyze/mass_parts.h"
#include "analyze/ordering.h"
#include "analyze/selection.h"
#include "analyze/symbolic.h"
#include "assemble/pattern_copy.h"

namespace mlcp {

/// Everything that depends on the pattern alone: which nodes, their order, the elimination tree, the symbolic factor, the islands.
class Analysis {
 public:
  explicit Analysis(const Memory& m)
      : selection(m), crowding(m), ordering(m), pattern(m), tree(m), symbolic(m), parts(m), sequence_(m), remembered_(m) {}

  Selection selection;
  Crowding crowding;
  Ordering ordering;
  KktPattern pattern;
  EliminationTree tree;
  Symbolic symbolic;
  MassParts parts;

  /// true if what is there fits the problem: the same patterns and bodies, and no row enabled that was not.
  bool covers(const Problem& problem, const Mask* enabled, bool exact) const;
  /// exact: rows after their velocities everywhere. imposed: elimination order to use if it fits; empty: compute one.
  /// throws: Stopped; then the analysis is that of nothing.
  void run(const Problem& problem, const Mask* enabled, bool exact, std::span<const std::int32_t> imposed, const Poll& poll = {});
  /// The same for the next step of a scene, where bodies stayed and rows came and went: from the order of the last analysis, as long as that fills in
  /// hardly more than a new one did.
  void run_again(const Problem& problem, const Mask* enabled, bool exact, const Poll& poll = {});

 private:
  template <class Order>
  void run_with(const Problem& problem, const Mask* enabled, bool exact, Order order);
  void build(const Problem& problem, const Poll& poll);
  std::int64_t allowed_entries() const;

  bool done_ = false, exact_ = false;
  std::int64_t fresh_entries_ = 0;            // of the last order that was not carried over
  std::int32_t fresh_rows_ = 0;
  std::int32_t pause_ = 0, next_pause_ = 1;   // analyses until a carried order is tried again, now and after the next failure
  Array<std::int32_t> sequence_;
  PatternCopy remembered_;  // the caller's patterns at the last run
};

}  // namespace mlcp
