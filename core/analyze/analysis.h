#pragma once
#include "analyze/elimination_tree.h"
#include "analyze/kkt_pattern.h"
#include "analyze/mass_parts.h"
#include "analyze/ordering.h"
#include "analyze/selection.h"
#include "analyze/symbolic.h"

namespace mlcp {

/// Everything that depends on the pattern alone: which nodes, their order, the elimination tree, the symbolic factor, the islands.
class Analysis {
 public:
  explicit Analysis(const Memory& m)
      : selection(m), crowding(m), ordering(m), pattern(m), tree(m), symbolic(m), parts(m), sequence_(m), mass_pointers_(m),
        mass_indices_(m), jacobian_pointers_(m), jacobian_indices_(m), sigma_pointers_(m), sigma_indices_(m) {}

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

 private:
  void remember(const Problem& problem);
  void build(const Problem& problem, const Poll& poll);

  bool done_ = false, exact_ = false;
  Array<std::int32_t> sequence_;
  // the caller's patterns at the last run
  Array<std::int32_t> mass_pointers_, mass_indices_, jacobian_pointers_, jacobian_indices_, sigma_pointers_, sigma_indices_;
};

}  // namespace mlcp
